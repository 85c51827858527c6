// The mesh of the page after what a mouse or a key does to it.
import assert from 'node:assert/strict';
import test from 'node:test';
import {ties, triangulate} from '../js/index.js';
import {PROMPT_TIES, PlaneMesh} from '../page/mesh.js';
import {SETS, SIDE, make} from '../page/sets.js';

const sorted = (triangles) => [...triangles].reduce((list, corner, k) => {
    if (k % 3 === 0) list.push([]);
    list.at(-1).push(corner);
    return list;
}, []).map((corners) => corners.join(' ')).sort();

function check(mesh) {
    assert.deepEqual(sorted(mesh.triangles), sorted(triangulate(mesh.coords).triangles));
    assert.deepEqual(mesh.ties, ties(mesh.coords));
}

for (const set of SETS) {
    test(`the mesh follows every change of the set ${set}`, () => {
        const mesh = new PlaneMesh(set, 200, 2);
        check(mesh);
        for (let k = 0; k < 20; k++) {
            mesh.move(k * 7, (k * 9901) % SIDE, (k * 7919) % SIDE);
            check(mesh);
            if (k % 5 === 0) mesh.delete(k);
            if (k % 3 === 0) assert.equal(mesh.insert(k * 1000 + 0.4, -5), mesh.count - 1);
            check(mesh);
        }
        mesh.drift(SIDE);
        check(mesh);
        assert.ok(mesh.coords.every((at) => Number.isInteger(at) && at >= 0 && at < SIDE));
    });
}

test('a set may be deleted point by point, and grows again', () => {
    const mesh = new PlaneMesh('grid', 10, 1);
    while (mesh.count > 0) mesh.delete(0);
    assert.equal(mesh.triangles.length, 0);
    assert.equal(mesh.nearest(3, 4), -1);
    for (const place of [[0, 0], [100, 0], [0, 100], [100, 100]]) mesh.insert(...place);
    check(mesh);
    assert.equal(mesh.nearest(90, 20), 1);
});

test('ties: one edge for each square of a grid, and the circle of each tie at a point', () => {
    const grid = new PlaneMesh('grid', 100, 1);
    assert.equal(grid.ties.length / 2, 81);
    const [x, y] = grid.at(0);
    const step = grid.at(1)[0] - x;
    assert.deepEqual(grid.circlesAt(0).map((circle) => circle.map(Math.round)),
        [[x + step / 2, y + step / 2, step * Math.SQRT1_2].map(Math.round)]);
    assert.deepEqual(new PlaneMesh('random', 30, 1).circlesAt(4), []);
    assert.equal(new PlaneMesh('circles', 36, 1).ties.length / 2, 33);
});

test('ties of large sets are looked for when they rest', () => {
    const large = new PlaneMesh('random', PROMPT_TIES + 1, 1);
    assert.equal(large.ties, null);
    large.settle();
    assert.deepEqual(large.ties, ties(large.coords));
});

test('sets lie on the grid, and a seed gives one set', () => {
    for (const set of SETS) {
        for (const count of [1, 10, 20_000]) {
            const coords = make(set, count, 9);
            assert.equal(coords.length, 2 * count);
            assert.ok(coords.every((at) => Number.isInteger(at) && at >= 0 && at < SIDE), set);
            assert.deepEqual(coords, make(set, count, 9));
        }
    }
});
