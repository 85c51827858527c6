// Every public call beside delaunator's, and d3-delaunay over it.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import Delaunator from 'delaunator';
import * as d3 from 'd3-delaunay';
import Incircle from '../js/index.js';
import {random} from './random.js';

/** Triangles with the smallest index first, in order: sets of triangles that can be compared. */
function canonical(triangles) {
    const list = [];
    for (let t = 0; t < triangles.length; t += 3) {
        const corners = [...triangles.subarray(t, t + 3)];
        const least = corners.indexOf(Math.min(...corners));
        list.push([...corners.slice(least), ...corners.slice(0, least)].join(' '));
    }
    return list.sort();
}

/** A ring from its smallest index on. */
function ring(hull) {
    const least = hull.indexOf(Math.min(...hull));
    return [...hull.slice(least), ...hull.slice(0, least)];
}

for (const count of [3, 4, 10, 1000, 20000]) {
    test(`${count} random points: triangles and hull are those of delaunator`, () => {
        const coords = random(count, count);
        const [ours, theirs] = [new Incircle(coords), new Delaunator(coords)];
        assert.deepEqual(canonical(ours.triangles), canonical(theirs.triangles));
        assert.deepEqual(ring(ours.hull), ring(theirs.hull));
        assert.equal(ours.triangles.constructor, Uint32Array);
        assert.equal(ours.hull.constructor, Uint32Array);
        assert.equal(ours.halfedges.constructor, Int32Array);
        assert.equal(ours.coords, coords);
    });
}

test('half-edges pair the two sides of each edge', () => {
    const {triangles, halfedges, hull} = new Incircle(random(3000, 9));
    const next = (edge) => edge - edge % 3 + (edge + 1) % 3;
    let outer = 0;
    for (const [edge, twin] of halfedges.entries()) {
        if (twin === -1) { outer++; continue; }
        assert.equal(halfedges[twin], edge);
        assert.equal(triangles[edge], triangles[next(twin)]);
        assert.equal(triangles[twin], triangles[next(edge)]);
    }
    assert.equal(outer, hull.length);
});

test('from takes accessors, and update takes changed coordinates', () => {
    const coords = random(500, 4);
    const points = Array.from({length: 500}, (_, k) => ({a: coords[2 * k], b: coords[2 * k + 1]}));
    const made = Incircle.from(points, (point) => point.a, (point) => point.b);
    assert.deepEqual(made.triangles, new Incircle(coords).triangles);
    assert.deepEqual(canonical(made.triangles),
        canonical(Delaunator.from(points, (point) => point.a, (point) => point.b).triangles));
    made.coords.set(random(500, 5));
    made.update();
    assert.deepEqual(canonical(made.triangles), canonical(new Delaunator(random(500, 5)).triangles));
});

test('sets without triangles have none in both', () => {
    for (const coords of [[], [1, 2], [0, 0, 1, 1], [0, 0, 1, 1, 2, 2, 3, 3], [5, 5, 5, 5, 5, 5]]) {
        const [ours, theirs] = [new Incircle(coords), new Delaunator(coords)];
        assert.equal(ours.triangles.length, 0);
        assert.equal(theirs.triangles.length, 0);
        assert.deepEqual([...ours.hull].sort(), [...theirs.hull].sort());
    }
});

/** The module of d3-delaunay with Incircle in the place of the copy of delaunator that it contains. */
async function over() {
    const source = readFileSync(new URL(import.meta.resolve('d3-delaunay')), 'utf8');
    const calls = source.split('new Delaunator(points)').length - 1;
    assert.equal(calls, 2, 'd3-delaunay makes its delaunators in two places');
    globalThis.Incircle = Incircle;
    const changed = source.replaceAll('new Delaunator(points)', 'new globalThis.Incircle(points)');
    return import(`data:text/javascript;base64,${Buffer.from(changed).toString('base64')}`);
}

test('d3-delaunay gives the same diagrams over Incircle', async () => {
    const changed = await over();
    for (const count of [1, 2, 3, 10, 2000]) {
        const coords = random(count, 70 + count);
        const [ours, theirs] = [new changed.Delaunay(coords), new d3.Delaunay(coords)];
        assert.equal(ours._delaunator.constructor, Incircle);
        const bounds = [0, 0, 1, 1];
        const [cells, wanted] = [ours.voronoi(bounds), theirs.voronoi(bounds)];
        for (let k = 0; k < count; k++) {
            assert.deepEqual(new Set(ours.neighbors(k)), new Set(theirs.neighbors(k)));
            const [one, other] = [cells.cellPolygon(k), wanted.cellPolygon(k)].map(area);
            assert.ok(Math.abs(one - other) < 1e-9, `cell ${k} of ${count}: ${one} and ${other}`);
            assert.equal(ours.find(coords[2 * k], coords[2 * k + 1]), k);
        }
    }
});

test('d3-delaunay finds a line of points over Incircle', async () => {
    const changed = await over();
    const line = new changed.Delaunay([0, 0, 1, 0, 2, 0, 3, 0]);
    assert.deepEqual([...line.neighbors(1)].sort(), [0, 2]);
});

function area(polygon) {
    let twice = 0;
    for (let k = 0; k + 1 < polygon.length; k++) {
        twice += polygon[k][0] * polygon[k + 1][1] - polygon[k + 1][0] * polygon[k][1];
    }
    return Math.abs(twice) / 2;
}
