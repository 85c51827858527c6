// Runs d3-delaunay's own tests with Incircle in delaunator's place, after `./build`:
//     git clone https://github.com/d3/d3-delaunay
//     node d3_tests.js d3-delaunay
// Fails if a test fails that is not listed here, or if a listed one passes.
import {execFileSync} from 'node:child_process';
import {cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

/** Tests that cannot pass. The README has the reasons. */
const OTHERWISE = [
    'Delaunay.from(array)', 'Delaunay.from(iterable)', 'Delaunay.from(iterable, fx, fy)', 'Delaunay.from({length}, fx, fy)',
    'delaunay.find(x, y) returns -1 for half a point', 'delaunay.update() allows fast updates', 'a degenerate triangle is avoided',
];

const folder = process.argv[2];
if (!folder || !existsSync(join(folder, 'test'))) {
    console.error('d3_tests: name the folder of a copy of https://github.com/d3/d3-delaunay');
    process.exit(2);
}
const copy = mkdtempSync(join(tmpdir(), 'incircle-'));
try {
    for (const part of ['src', 'test', 'package.json']) cpSync(join(folder, part), join(copy, part), {recursive: true});
    const place = join(copy, 'node_modules', 'delaunator');
    mkdirSync(place, {recursive: true});
    writeFileSync(join(place, 'package.json'), '{"type": "module", "main": "index.js"}');
    writeFileSync(join(place, 'index.js'), `export {default} from '${new URL('js/index.js', import.meta.url)}';\n`);
    const files = readdirSync(join(copy, 'test')).filter((name) => name.endsWith('-test.js')).map((name) => join(copy, 'test', name));
    // The tests are written for Mocha, whose function `it` Node.js has as well.
    for (const file of files) writeFileSync(file, `import {it} from 'node:test';\n${readFileSync(file, 'utf8')}`);
    let told;
    try {
        told = execFileSync(process.execPath, ['--test', '--test-reporter=tap', ...files], {encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit']});
    } catch (error) {
        told = error.stdout;
    }
    const results = [...told.matchAll(/^ *(not )?ok \d+ - (.*)$/gm)].filter(([, , name]) => !name.endsWith('.js'));
    const failed = results.filter(([, not]) => not).map(([, , name]) => name);
    const wrong = [...failed.filter((name) => !OTHERWISE.includes(name)), ...OTHERWISE.filter((name) => !failed.includes(name))];
    console.log(`${results.length - failed.length} of ${results.length} tests of d3-delaunay pass`);
    if (results.length < 45 || wrong.length > 0) {
        console.error(`d3_tests: other results than the listed ones: ${wrong.join('; ') || 'there are fewer tests'}`);
        process.exitCode = 1;
    }
} finally {
    rmSync(copy, {recursive: true});
}
