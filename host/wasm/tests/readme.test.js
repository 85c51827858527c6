// The examples of the README run.
import {readFileSync} from 'node:fs';
import assert from 'node:assert/strict';
import test from 'node:test';

test('the example of the README runs', async () => {
    const readme = readFileSync(new URL('../README.md', import.meta.url), 'utf8');
    const [, ...examples] = readme.split('```js\n');
    assert.equal(examples.length, 1);
    const code = examples[0].split('```')[0].replace("'incircle'", `'${new URL('../js/index.js', import.meta.url)}'`);
    await import(`data:text/javascript;base64,${Buffer.from(code).toString('base64')}`);
});
