// The page in a real browser without a window: pictures, keyboard, mouse, and the core.
// INCIRCLE_BROWSER names the browser. INCIRCLE_SCREENSHOTS may name a folder for pictures.
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {after, before, beforeEach, test} from 'node:test';
import puppeteer from 'puppeteer-core';
import {serve} from '../page/serve.js';

let [browser, page, site] = [];
let complaints = [];

before(async () => {
    assert.ok(process.env.INCIRCLE_BROWSER, 'INCIRCLE_BROWSER must name a Chromium');
    site = await serve(0);
    browser = await puppeteer.launch({executablePath: process.env.INCIRCLE_BROWSER, args: ['--no-sandbox']});
});
after(async () => {
    await browser?.close();
    site?.server.close();
});
beforeEach(async () => {
    await page?.close();
    complaints = [];
    page = await browser.newPage();
    page.on('console', (message) => { if (message.type() === 'error') complaints.push(message.text()); });
    page.on('pageerror', (error) => complaints.push(error.stack));
    page.on('response', (response) => { if (response.status() >= 400) complaints.push(`${response.status()} ${response.url()}`); });
    await page.setViewport({width: 1280, height: 860});
    await page.goto(site.address);
    await page.waitForFunction(() => document.querySelector('#plane-points').textContent !== '');
});

const text = (id) => page.$eval(`#${id}`, (element) => element.textContent);
const number = async (id) => Number((await text(id)).replaceAll(',', '').split(' ')[0]);
/** Waits for two frames of the screen. */
const frames = () => page.evaluate(() => new Promise((done) => {
    requestAnimationFrame(() => requestAnimationFrame(done));
}));

/** The picture on a canvas: a number made of all pixels, and how many colours there are. */
async function picture(id) {
    await frames();
    return page.$eval(`#${id}`, (canvas) => {
        const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
        copy.drawImage(canvas, 0, 0);
        const pixels = new Uint32Array(copy.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
        return {sum: pixels.reduce((sum, pixel) => (Math.imul(sum, 31) + pixel) | 0, 0), colors: new Set(pixels).size};
    });
}

async function shoot(name) {
    const folder = process.env.INCIRCLE_SCREENSHOTS;
    if (folder) await page.screenshot({path: join(folder, `${name}.png`)});
}

/**
 * The milliseconds of processor time that the page's thread takes for each redraw of the mesh while `work` runs. Unlike
 * the frames a second, they do not depend on what else the machine does.
 */
async function costOfRedraws(work) {
    const session = await page.createCDPSession();
    await session.send('Performance.enable', {timeDomain: 'threadTicks'});
    const seconds = async () => {
        const {metrics} = await session.send('Performance.getMetrics');
        return metrics.find(({name}) => name === 'TaskDuration').value;
    };
    await page.evaluate(() => {
        window.redraws = 0;
        new MutationObserver(() => { window.redraws++; }).observe(document.querySelector('#plane-points'), {childList: true});
    });
    const before = await seconds();
    await work();
    const spent = await seconds() - before;
    const redraws = await page.evaluate(() => window.redraws);
    assert.ok(redraws > 5, `${redraws} redraws`);
    return 1000 * spent / redraws;
}

/** A test at whose end the page must not have complained. */
function pageTest(name, work) {
    test(name, async (context) => {
        await work(context);
        assert.deepEqual(complaints, []);
    });
}

pageTest('the page shows a mesh', async () => {
    assert.equal(await number('plane-points'), 100);
    const triangles = await number('plane-triangles');
    assert.ok(triangles > 150 && triangles < 200, `${triangles}`);
    assert.ok((await picture('plane-mesh')).colors > 20);
    await shoot('mesh');
    await page.select('#plane-set', 'circles');
    await page.focus('#plane-marks');
    await page.keyboard.press('n');
    await frames();
    assert.equal(await number('plane-ties'), 88);
    assert.ok((await picture('plane-marks')).colors > 2, 'ties and their circles are drawn');
    await shoot('ties');
});

pageTest('the keyboard reaches every control, and moves, inserts and deletes points', async () => {
    const reached = new Set();
    for (let k = 0; k < 8; k++) {
        await page.keyboard.press('Tab');
        reached.add(await page.evaluate(() => document.activeElement.id));
    }
    for (const id of ['tab-plane', 'plane-marks', 'plane-set', 'plane-count', 'plane-snap', 'plane-drift', 'plane-again']) {
        assert.ok(reached.has(id), `${id} is not reached by Tab`);
    }
    await page.focus('#plane-marks');
    await page.keyboard.press('n');
    const told = await text('plane-status');
    assert.match(told, /^point 0 at/);
    const was = await picture('plane-mesh');
    await page.keyboard.press('ArrowRight');
    assert.notEqual(await text('plane-status'), told);
    assert.notEqual((await picture('plane-mesh')).sum, was.sum);
    await page.keyboard.press('ArrowLeft');
    assert.equal(await text('plane-status'), told);
    await page.keyboard.press('Enter');
    await frames();
    assert.equal(await number('plane-points'), 101);
    await page.keyboard.press('Delete');
    await frames();
    assert.equal(await number('plane-points'), 100);
    assert.equal((await picture('plane-mesh')).sum, was.sum, 'the mesh is the same as before');
    await page.keyboard.press('p');
    assert.match(await text('plane-status'), /^point 99 at/);
    await page.keyboard.press('s');
    assert.ok(await page.$eval('#plane-snap', (box) => box.checked));
});

pageTest('a drag moves a point and changes the mesh', async () => {
    await page.select('#plane-set', 'grid');
    await frames();
    assert.equal(await number('plane-ties'), 81);
    const was = await picture('plane-mesh');
    const box = await (await page.$('#plane-marks')).boundingBox();
    // Places on the grid as `fit` lays them out.
    const side = Math.min(box.width, box.height) - 52;
    const at = (x, y) => [box.x + (box.width - side) / 2 + x * side, box.y + (box.height + side) / 2 - y * side];
    await page.mouse.move(...at(0.45, 0.45));
    await page.mouse.down();
    assert.match(await text('plane-status'), /^point 44 at/);
    await page.mouse.move(...at(0.52, 0.49), {steps: 5});
    await page.mouse.up();
    const [, x, y] = (await text('plane-status')).match(/at \((\d+), (\d+)\)/);
    assert.ok(Math.abs(x / 65536 - 0.52) < 0.01 && Math.abs(y / 65536 - 0.49) < 0.01, `${x} ${y}`);
    assert.notEqual((await picture('plane-mesh')).sum, was.sum);
    assert.ok(await number('plane-ties') < 81, 'the squares around the point are no ties any more');
    await page.mouse.click(...at(0.2, 0.73), {count: 2});
    await frames();
    assert.equal(await number('plane-points'), 101);
});

pageTest('100,000 points drift', async (context) => {
    await page.select('#plane-count', '100000');
    await page.focus('#plane-marks');
    const was = await picture('plane-mesh');
    assert.ok(was.colors > 100);
    await page.keyboard.press('Space');
    const rates = [];
    const cost = await costOfRedraws(async () => {
        for (let k = 0; k < 8; k++) {
            await new Promise((done) => setTimeout(done, 600));
            rates.push(await text('plane-rate'));
        }
    });
    context.diagnostic(`100,000 points are redrawn ${rates.slice(2).join(', ')} times a second, at ${cost.toFixed(0)} ms each`);
    assert.ok(cost < 100, `a redraw takes ${cost} ms of the processor, too long for ten a second`);
    await shoot('many');
    await page.keyboard.press('Space');
    assert.notEqual((await picture('plane-mesh')).sum, was.sum);
    await page.waitForFunction(() => document.querySelector('#plane-ties').textContent !== '…');
});

pageTest('a drag moves one of 100,000 points', async (context) => {
    await page.select('#plane-count', '100000');
    const was = await picture('plane-mesh');
    const box = await (await page.$('#plane-marks')).boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    assert.match(await text('plane-status'), /^point \d+ at/);
    const rates = new Set();
    const cost = await costOfRedraws(async () => {
        const until = Date.now() + 4000;
        for (let k = 1; k < 20 || Date.now() < until; k++) {
            await page.mouse.move(x + 2 * k % 200, y + k % 150);
            await frames();
            rates.add(await text('plane-rate'));
        }
    });
    await page.mouse.up();
    context.diagnostic(`with one of 100,000 points dragged, frames a second are ${[...rates].join(', ')}, at ${cost.toFixed(0)} ms each`);
    assert.ok(cost < 100, `a redraw takes ${cost} ms of the processor, too long for ten a second`);
    assert.equal(await number('plane-points'), 100_000);
    assert.notEqual((await picture('plane-mesh')).sum, was.sum);
    await page.waitForFunction(() => document.querySelector('#plane-rate').textContent === '–');
});

pageTest('the core works clock by clock, and its mesh is the canonical one', async () => {
    await page.focus('#tab-plane');
    await page.keyboard.press('ArrowRight');
    assert.equal(await page.evaluate(() => document.activeElement.id), 'tab-core');
    await frames();
    assert.equal(await number('core-clock'), 0);
    await page.focus('#core-mesh');
    for (let k = 0; k < 5; k++) await page.keyboard.press('ArrowRight');
    await page.click('#core-step');
    await frames();
    assert.equal(await number('core-clock'), 6);
    await page.focus('#core-mesh');
    for (let k = 0; k < 5; k++) await page.keyboard.press('+');
    assert.equal(await text('core-speed-told'), '1,778 clocks a second');
    await page.keyboard.press('Space');
    await page.waitForFunction(() => Number(document.querySelector('#core-work').textContent) === 16 &&
        Number(document.querySelector('#core-finished').textContent.split(' ')[0]) > 120 &&
        Number(document.querySelector('#core-locks').textContent) > 20, {timeout: 60_000});
    await page.keyboard.press('Space');
    await frames();
    const clock = await number('core-clock');
    const was = await picture('core-mesh');
    assert.ok(was.colors > 20);
    assert.ok((await picture('core-time')).colors > 20);
    assert.equal(await page.$$eval('#core-list li', (items) => items.length), 16);
    await shoot('core');
    assert.equal((await picture('core-mesh')).sum, was.sum, 'a pause stops the picture');
    assert.equal(await number('core-clock'), clock);
    await page.$eval('#core-speed', (speed) => { speed.value = 5; });
    await page.keyboard.press('Space');
    await page.waitForFunction(() => document.querySelector('#core-status').textContent.startsWith('Done'), {timeout: 60_000});
    assert.match(await text('core-status'), /^Done in [\d,]+ clocks, .* The triangles are those of the triangulator\.$/);
    assert.equal(await text('core-finished'), '500 of 500');
    await page.focus('#core-mesh');
    await page.keyboard.press('r');
    await frames();
    assert.equal(await number('core-clock'), 0);
});
