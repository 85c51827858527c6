// Voronoi cells beside those of d3-delaunay, and on sets with ties, lines and duplicates.
import assert from 'node:assert/strict';
import test from 'node:test';
import * as d3 from 'd3-delaunay';
import Incircle, {Voronoi} from '../js/index.js';
import {random} from './random.js';

const area = (polygon) => polygon.slice(1).reduce((sum, [x, y], k) => sum + polygon[k][0] * y - x * polygon[k][1], 0) / 2;
const near = ([x, y], polygon) => polygon.some(([ox, oy]) => Math.hypot(ox - x, oy - y) < 1e-9);

for (const count of [1, 2, 3, 10, 500]) {
    test(`${count} random points have the cells of d3-delaunay`, () => {
        const coords = random(count, 30 + count);
        for (const bounds of [[0, 0, 1, 1], [0.2, 0.3, 0.7, 0.6], [-2, -3, 4, 5], [2, 2, 3, 3]]) {
            const [ours, theirs] = [new Incircle(coords).voronoi(bounds), new d3.Delaunay(coords).voronoi(bounds)];
            for (let k = 0; k < count; k++) {
                const [one, other] = [ours.cellPolygon(k), theirs.cellPolygon(k)];
                if (one === null || other === null) {
                    // A cell that has no part within the rectangle; d3-delaunay may leave one without an area.
                    assert.ok(Math.abs(area(one ?? other ?? [[0, 0]])) < 1e-12, `cell ${k} within ${bounds}`);
                    continue;
                }
                assert.ok(Math.abs(Math.abs(area(one)) - Math.abs(area(other))) < 1e-12);
                assert.ok(one.every((corner) => near(corner, other)), `cell ${k} of ours`);
                // Without a triangle d3-delaunay leaves corners in the middle of sides.
                if (count > 2) assert.ok(other.every((corner) => near(corner, one)), `cell ${k} of d3-delaunay`);
                assert.deepEqual(one.at(-1), one[0]);
                assert.deepEqual(new Set(ours.neighbors(k)), new Set(theirs.neighbors(k)));
                assert.equal(ours.contains(k, 0.4, 0.5), theirs.contains(k, 0.4, 0.5));
            }
        }
    });
}

test('cells fill the rectangle, whatever the set', () => {
    const grid = Float64Array.from({length: 200}, (_, k) => (k % 2 ? Math.floor(k / 20) : (k / 2) % 10));
    const ring = [0, 5, 3, 4, 4, 3, 5, 0, -3, 4, -4, 3, -5, 0, 0, -5, 3, -4, 4, -3, -3, -4, -4, -3];
    const sets = [random(300, 3), grid, ring, [0, 0, 3, 3, 1, 1, 1, 1, 2, 2], [2, 2, 2, 2], [1e6, 1e6, 1e6 + 1, 1e6 + 1, 1e6, 1e6 + 1]];
    for (const coords of sets) {
        const delaunay = new Incircle(coords);
        const cells = [...delaunay.voronoi([-3, -2, 11, 12]).cellPolygons()];
        const sum = cells.reduce((total, cell) => total + area(cell), 0);
        assert.ok(Math.abs(sum - 14 * 14) < 1e-6, `${sum}`);
        const repeated = new Set(delaunay.duplicates.filter((_, k) => k % 2 === 0));
        assert.ok(cells.every(({index}) => !repeated.has(index)));
    }
    assert.deepEqual([...new Incircle([]).voronoi().cellPolygons()], []);
});

test('cells of a square meet at one corner, and only neighbours with an edge are neighbours', () => {
    const cells = new Incircle([0, 0, 4, 0, 4, 4, 0, 4]).voronoi([0, 0, 4, 4]);
    assert.deepEqual(cells.cellPolygon(0), [[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]);
    assert.deepEqual(new Set(cells.neighbors(0)), new Set([1, 3]));
    assert.deepEqual([...cells.circumcenters], [2, 2, 2, 2]);
    assert.equal(cells.renderCell(0), 'M0,0L2,0L2,2L0,2Z');
    assert.equal(cells.renderBounds(), 'M0,0h4v4h-4Z');
    assert.equal(cells.render().split('M').length - 1, 4);
});

test('cells are drawn on a pen, and follow the points', () => {
    const delaunay = new Incircle(Float64Array.of(0, 0, 4, 0, 0, 4));
    const cells = new Voronoi(delaunay, [-9, -9, 9, 9]);
    const calls = [];
    const pen = Object.fromEntries(['moveTo', 'lineTo', 'closePath', 'rect'].map((name) => [name, (...at) => calls.push([name, ...at])]));
    cells.renderCell(1, pen);
    assert.equal(calls[0][0], 'moveTo');
    assert.equal(calls.at(-1)[0], 'closePath');
    cells.render(pen);
    cells.renderBounds(pen);
    assert.deepEqual(calls.at(-1), ['rect', -9, -9, 18, 18]);
    const was = cells.cellPolygon(0);
    delaunay.coords.set([8, 0], 2);
    delaunay.update();
    assert.equal(cells.update(), cells);
    assert.notDeepEqual(cells.cellPolygon(0), was);
});

test('wrong bounds and points are refused with the numbers', () => {
    const delaunay = new Incircle([0, 0, 4, 0, 0, 4]);
    assert.throws(() => delaunay.voronoi([4, 0, 0, 4]), /\(4, 0\) to \(0, 4\)/);
    assert.throws(() => delaunay.voronoi([0, 0, NaN, 4]), /side 2 of the bounds is NaN/);
    assert.throws(() => delaunay.voronoi([0, 0]), /rectangle/);
    assert.throws(() => delaunay.voronoi().cellPolygon(3), /no point 3/);
    assert.throws(() => delaunay.voronoi().cellPolygon(-1), /-1 is no index/);
});
