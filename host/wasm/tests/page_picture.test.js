// The picture of a large mesh, beside one that is drawn edge by edge from the list of triangles.
import assert from 'node:assert/strict';
import test from 'node:test';
import {triangulate} from '../js/index.js';
import {PlaneMesh} from '../page/mesh.js';
import {SETS, SIDE} from '../page/sets.js';

const [WIDTH, HEIGHT] = [320, 240];
const [LEFT, BOTTOM, SCALE] = [50, 230, 220 / SIDE];

/** The colour of a level of light, from 0 to 255. */
function color(level) {
    const place = 2 * Math.min(1, level / 255);
    const keys = [[12, 16, 23], [58, 140, 190], [225, 244, 255]];
    const [from, to] = place < 1 ? keys : keys.slice(1);
    return from.map((channel, k) => channel + (to[k] - channel) * (place % 1 || (place === 2 ? 1 : 0)));
}

/** The level of light of each pixel: every edge once, on the two pixels beside each of its places on a row or column. */
function levels(coords) {
    const {triangles} = triangulate(coords);
    const edges = new Set();
    triangles.forEach((from, k) => {
        const to = triangles[k % 3 === 2 ? k - 2 : k + 1];
        edges.add(from < to ? `${from} ${to}` : `${to} ${from}`);
    });
    const light = 120 / (0.4 + 5.4 * Math.sqrt(coords.length / 2) / Math.min(WIDTH, HEIGHT));
    const found = new Float64Array(WIDTH * HEIGHT);
    for (const edge of edges) {
        const [one, other] = edge.split(' ').map((point) => (
            [LEFT + SCALE * coords[2 * point], BOTTOM - SCALE * coords[2 * point + 1]]));
        const along = Math.abs(other[1] - one[1]) > Math.abs(other[0] - one[0]) ? 1 : 0;
        const [from, to] = one[along] < other[along] ? [one, other] : [other, one];
        for (let step = Math.round(from[along]); step < Math.round(to[along]); step++) {
            const part = (step + 0.5 - from[along]) / (to[along] - from[along]);
            const place = from[1 - along] + part * (to[1 - along] - from[1 - along]) - 0.5;
            const whole = Math.floor(place);
            for (const [beside, share] of [[whole, whole + 1 - place], [whole + 1, place - whole]]) {
                found[along ? step * WIDTH + beside : beside * WIDTH + step] += light * share;
            }
        }
    }
    return found;
}

/** Compares the picture of a mesh with its levels. A place that is rounded otherwise may move a few pixels of light. */
function check(mesh, what) {
    const pixels = mesh.draw(WIDTH, HEIGHT, LEFT, BOTTOM, SCALE);
    assert.equal(pixels.length, 4 * WIDTH * HEIGHT);
    const expected = levels(mesh.coords);
    let [lit, others] = [0, 0];
    expected.forEach((level, k) => {
        const [red, green, blue, opacity] = pixels.subarray(4 * k, 4 * k + 4);
        assert.equal(opacity, 255);
        lit += level > 0;
        others += color(level).some((channel, at) => Math.abs(channel - [red, green, blue][at]) > 3);
    });
    assert.ok(lit > 1000, `${what}: ${lit} pixels are lit`);
    assert.ok(others <= lit / 200, `${what}: ${others} of ${lit} pixels have another colour`);
}

for (const set of SETS) {
    test(`every edge of the set ${set} is drawn once, also after changes`, () => {
        const mesh = new PlaneMesh(set, 4000, 3);
        check(mesh, 'a new set');
        check(mesh, 'the same set again');
        for (let k = 0; k < 40; k++) mesh.drift(SIDE);
        check(mesh, 'after a drift');
        mesh.move(17, 30_000, 200);
        mesh.insert(1000, 65_000);
        check(mesh, 'after a move and an insertion');
        mesh.delete(5);
        check(mesh, 'after a deletion');
    });
}

test('pictures of any size: places outside are left out, and sizes that are too large are refused', () => {
    const mesh = new PlaneMesh('random', 4000, 1);
    for (const [left, bottom, scale] of [[-500, 9000, 1], [1e9, -1e9, 1], [0, 0, 0], [-40_000, 40_000, 2e4], [NaN, Infinity, 1]]) {
        assert.equal(mesh.draw(64, 48, left, bottom, scale).length, 4 * 64 * 48);
    }
    assert.equal(mesh.draw(0, 0, 0, 0, 1).length, 0);
    for (const [width, height] of [[20_000, 5], [5, 20_000], [2 ** 31, 2 ** 31]]) {
        assert.throws(() => mesh.draw(width, height, 0, 0, 1), {name: 'RangeError', message: /a picture of \d+ by \d+ pixels is too large/});
    }
    check(mesh, 'after all that');
});
