// The canonical mesh, the mesh that lives, constraints, and refused input.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import test from 'node:test';
import earcutOfMapbox from 'earcut';
import Incircle, {Voronoi, Triangulation, constrain, earcut, ties, triangulate, usedBytes, verify} from '../js/index.js';
import {random} from './random.js';

test('the triangles are those of the command, byte for byte', () => {
    const command = process.env.INCIRCLE_COMMAND;
    assert.ok(command, 'INCIRCLE_COMMAND must name the command incircle');
    const folder = mkdtempSync(join(tmpdir(), 'incircle-'));
    try {
        const grid = Float64Array.from({length: 800}, (_, k) => (k % 2 ? Math.floor(k / 40) : (k / 2) % 20));
        for (const coords of [random(5000, 1), grid]) {
            const lines = [];
            for (let k = 0; k < coords.length; k += 2) lines.push(`${coords[k]},${coords[k + 1]}\n`);
            writeFileSync(join(folder, 'points.csv'), lines.join(''));
            execFileSync(command, ['triangulate', join(folder, 'points.csv'), '-o', join(folder, 'mesh.csv'), '--quiet']);
            const printed = execFileSync('cat', [join(folder, 'mesh.csv')], {encoding: 'utf8', maxBuffer: 1 << 26});
            const wanted = printed.match(/^\d+,\d+,\d+$/gm).map((line) => line.split(',').map(Number)).flat();
            assert.deepEqual([...triangulate(coords).triangles], wanted);
            verify(coords);
        }
    } finally {
        rmSync(folder, {recursive: true});
    }
});

test('a mesh that lives is the canonical one of its points after every kind of change', () => {
    const coords = random(300, 6);
    const mesh = new Triangulation(coords.subarray(0, 400));
    for (let k = 200; k < 300; k++) assert.equal(mesh.insert(coords[2 * k], coords[2 * k + 1]), k);
    mesh.move(7, 2, 3);
    mesh.delete(11);
    assert.equal(mesh.size, 299);
    const kept = [...coords];
    kept.splice(14, 2, 2, 3);
    kept.splice(22, 2);
    const {indices, ...lists} = mesh.mesh();
    assert.deepEqual(lists, triangulate(kept));
    assert.deepEqual([...indices], [...Array(300).keys()].filter((k) => k !== 11));
    assert.equal(mesh.triangles().length, lists.triangles.length);
    const moved = random(299, 8);
    mesh.moveAll(moved);
    assert.deepEqual(mesh.mesh().triangles, triangulate(moved).triangles);
    mesh.free();
    assert.throws(() => mesh.size, /was freed/);
});

test('places are located', () => {
    const mesh = Triangulation.from([[0, 0], [1, 0], [0, 1]]);
    const at = (x, y) => { const {kind, vertices} = mesh.locate(x, y); return [kind, ...vertices]; };
    assert.deepEqual(at(0.2, 0.2), ['triangle', 0, 1, 2]);
    assert.deepEqual(at(0, 0.5), ['edge', 0, 2]);
    assert.deepEqual(at(0.5, -1), ['outside', 0, 1]);
    assert.deepEqual(at(1, 0), ['vertex', 1]);
    assert.equal(mesh.nearest(0.9, 0.2), 1);
    assert.deepEqual([...mesh.neighbors(0)].sort(), [1, 2]);
    mesh.free();
    const empty = new Triangulation();
    assert.equal(empty.nearest(0, 0), -1);
    assert.equal(empty.locate(0, 0).kind, 'none');
    empty.free();
});

test('a polygon with a hole is triangulated as by earcut, in area', () => {
    const vertices = [0, 0, 10, 0, 10, 10, 0, 10, 3, 3, 3, 6, 6, 6, 6, 3];
    const [ours, theirs] = [earcut(vertices, [4]), earcutOfMapbox(vertices, [4])];
    assert.equal(ours.length, theirs.length);
    const area = (triangles) => {
        let twice = 0;
        for (let t = 0; t < triangles.length; t += 3) {
            const [a, b, c] = [0, 1, 2].map((k) => [vertices[2 * triangles[t + k]], vertices[2 * triangles[t + k] + 1]]);
            twice += Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        }
        return twice / 2;
    };
    assert.equal(area(ours), 91);
    assert.equal(area(theirs), 91);
    assert.deepEqual([...constrain([0, 0, 4, -1, 8, 0, 4, 1], [0, 2]).triangles], [0, 1, 2, 0, 2, 3]);
    assert.throws(() => constrain([0, 0, 4, 0, 4, 4, 0, 4], [0, 2, 1, 3]), /cross/);
});

test('holes are cut out of a domain by places in them', () => {
    const vertices = [0, 0, 10, 0, 10, 10, 0, 10, 3, 3, 6, 3, 6, 6, 3, 6];
    const rings = [0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4];
    const whole = constrain(vertices, rings, 'holes');
    const cut = constrain(vertices, rings, 'holes', [4, 5]);
    assert.equal(whole.triangles.length / 3, 10);
    assert.equal(cut.triangles.length / 3, 8);
    assert.deepEqual(cut.triangles, earcut(vertices, [4]));
    assert.throws(() => constrain(vertices, rings, 'holes', Float64Array.of(4, 5, 1, 1)), /domain is empty/);
    assert.throws(() => constrain(vertices, rings, 'holes', [40, 5]), /hole 0/);
    assert.throws(() => constrain(vertices, rings, 'holes', [4, 3]), /hole 0/);
    assert.throws(() => constrain(vertices, rings, 'holes', [4, NaN]), /coordinate 1 of the holes is NaN/);
    assert.throws(() => constrain(vertices, rings, 'holes', [4]), /1 coordinates/);
    assert.throws(() => constrain(vertices, rings, 'even-odd', [4, 5]), /takes no holes/);
});

test('ties are the edges whose other diagonal would be Delaunay, too', () => {
    assert.deepEqual([...ties([0, 0, 1, 0, 1, 1, 0, 1, 9, 3])], [2, 0]);
    assert.equal(ties(random(1000, 2)).length, 0);
    assert.deepEqual([...ties([0, 0, 1, 0, 1, 1, 0, 1 + 2 ** -52])], []);
    // The diagonals of the regular lattice of the command's mesh: one for each square.
    const grid = Float64Array.from({length: 242}, (_, k) => (k % 2 ? Math.floor(k / 22) : (k / 2) % 11));
    assert.equal(ties(grid).length / 2, 100);
});

test('bad input is refused with its numbers, and nothing leaks', () => {
    const living = new Triangulation([0, 0, 1, 0, 0, 1]);
    const refused = [
        [() => new Incircle([0, 0, 1]), /3 coordinates/],
        [() => new Incircle([0, 0, NaN, 1]), /coordinate 2 is NaN/],
        [() => new Incircle(Float64Array.of(0, 0, Infinity, 1)), /point 1/],
        [() => new Incircle(['a', 'b']), /of type string/],
        [() => new Incircle(5), TypeError],
        [() => new Incircle(null), TypeError],
        [() => new Incircle(new BigInt64Array(4)), TypeError],
        [() => new Incircle({length: 4}), TypeError],
        [() => Incircle.from([[1, 2], [3]]), /y of point 1/],
        [() => Incircle.from(5), /points must be a list/],
        [() => Incircle.from(null), /points must be a list/],
        [() => Triangulation.from({length: -1}), /points must be a list/],
        [() => Incircle.from([[1, 2], null]), /point 1 is null/],
        [() => new Incircle(Object.defineProperty(new Float64Array(0), 'length', {value: 2 ** 40})), /points are more/],
        [() => living.insert(NaN, 0), /x is NaN/],
        [() => living.insert('1', 0), TypeError],
        [() => living.delete(9), /no point 9/],
        [() => living.delete(-1), /-1 is no index/],
        [() => living.delete(1.5), /1.5 is no index/],
        [() => living.move(0, 0, Infinity), /Infinity/],
        [() => living.moveAll([0, 0]), /1 new places for 3/],
        [() => constrain([0, 0, 1, 1], [0, 7]), RangeError],
        [() => constrain([0, 0, 1, 1], [0]), /1 indices/],
        [() => constrain([0, 0, 1], [0, 1]), /3 coordinates/],
        [() => constrain([0, 0, 1, 1], [0, 1], 'inside'), /no domain/],
        [() => constrain([0, 0, 1, 1], [0, 1], 'holes', null), /holes must be/],
        [() => earcut([0, 0, 1, 0, 1, 1], [7]), /ring 0|behind/],
        [() => earcut(null), /coordinates must be/],
        [() => earcut([0, 0, 1]), /3 coordinates are an odd number/],
        [() => earcut([0, 0, 1, 0, 1, 1], 'x'), /holes must be/],
        [() => new Voronoi(null), /give an Incircle/],
    ];
    const before = usedBytes();
    for (let round = 0; round < 20; round++) {
        for (const [call, reason] of refused) assert.throws(call, reason);
        new Incircle(random(100, round));
        triangulate(random(100, round));
        new Triangulation(random(100, round)).free();
    }
    assert.equal(usedBytes(), before);
    assert.equal(living.size, 3);
    living.free();
    assert.throws(() => living.insert(0, 0), /was freed/);
});
