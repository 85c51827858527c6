// Times in a browser beside those of the command on one thread: the same points, in turn, the best of seven rounds.
// INCIRCLE_BROWSER names the browser, INCIRCLE_COMMAND the command. The argument is the number of points.
import {execFileSync} from 'node:child_process';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import puppeteer from 'puppeteer-core';
import {best, points} from './bench.js';
import {serve} from './page/serve.js';

const ROUNDS = 7;
const NATIVE = 'the command, one thread';
/** Steps of the command between the points in memory and the mesh in memory. */
const STEPS = ['quantise', 'order', 'insert', 'assemble'];

/** An array of NumPy of points. */
function npy(coords) {
    const head = `{'descr': '<f8', 'fortran_order': False, 'shape': (${coords.length / 2}, 2), }`.padEnd(117);
    return Buffer.concat([Buffer.from('\x93NUMPY\x01\x00\x76\x00', 'latin1'), Buffer.from(`${head}\n`), Buffer.from(coords.buffer)]);
}

const count = Number(process.argv[2] ?? 1e6);
const folder = mkdtempSync(join(tmpdir(), 'incircle-'));
const site = await serve(0);
const browser = await puppeteer.launch({executablePath: process.env.INCIRCLE_BROWSER, args: ['--no-sandbox']});
try {
    const file = join(folder, 'points.npy');
    writeFileSync(file, npy(points(count)));
    const options = ['triangulate', file, '-o', join(folder, 'mesh.npy'), '--threads', '1', '--json', '--quiet'];
    const native = () => {
        const {seconds} = JSON.parse(execFileSync(process.env.INCIRCLE_COMMAND, options, {encoding: 'utf8'}));
        return 1000 * STEPS.reduce((sum, step) => sum + seconds[step], 0);
    };
    const page = await browser.newPage();
    await page.goto(`${site.address}bench.html`);
    await page.waitForFunction(() => window.round);
    await page.evaluate((number) => window.take(number), count);
    let times = {};
    for (let k = 0; k < ROUNDS; k++) {
        times = best(times, {[NATIVE]: native(), ...await page.evaluate(() => window.round())});
    }
    console.log(`${count.toLocaleString('en')} points in ${await browser.version()}, best of ${ROUNDS}:`);
    for (const [name, time] of Object.entries(times)) {
        console.log(`${name}: ${time.toFixed(0)} ms, ${(time / times[NATIVE]).toFixed(2)} of the command`);
    }
} finally {
    await browser.close();
    site.server.close();
    rmSync(folder, {recursive: true});
}
