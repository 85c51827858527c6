// Too little memory: the module refuses with a sentence, and goes on working.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import test from 'node:test';

/** Runs in a process whose modules get at most 64 MB. */
const PROGRAM = `
import assert from 'node:assert/strict';
import Incircle, {Triangulation, triangulate} from '${new URL('../js/index.js', import.meta.url)}';
import {random} from '${new URL('random.js', import.meta.url)}';
const refused = {name: 'RangeError', message: /bytes|memory/};
const coords = random(1_000_000, 1);
assert.throws(() => triangulate(coords), refused);
assert.throws(() => new Incircle(coords), refused);
assert.throws(() => new Triangulation(coords), refused);
const mesh = new Triangulation();
let count = 0;
assert.throws(() => { for (;; count++) mesh.insert(coords[2 * count], coords[2 * count + 1]); }, refused);
assert.ok(count > 10_000 && count < 1_000_000, String(count));
assert.equal(mesh.size, count);
assert.equal(mesh.nearest(coords[0], coords[1]), 0);
mesh.free();
assert.equal(triangulate(random(1000, 2)).duplicates.length, 0);
console.log(count);
`;

test('without memory for a job the module throws a RangeError, and goes on working', (context) => {
    const options = ['--wasm-max-mem-pages=1024', '--input-type=module', '--eval', PROGRAM];
    const count = execFileSync(process.execPath, options, {encoding: 'utf8'});
    context.diagnostic(`64 MB hold ${count.trim()} points that were inserted one by one`);
});
