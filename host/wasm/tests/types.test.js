// The declarations for TypeScript: its compiler takes every public call, and they name what the package exports.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import {fileURLToPath} from 'node:url';
import * as incircle from '../js/index.js';

const path = (name) => fileURLToPath(new URL(name, import.meta.url));

test('the compiler of TypeScript takes every public call', () => {
    const options = ['--noEmit', '--strict', '--target', 'es2022', '--lib', 'es2022,dom', '--module', 'nodenext'];
    try {
        execFileSync(path('../node_modules/.bin/tsc'), [...options, '--types', '', path('use.ts')], {encoding: 'utf8'});
    } catch (error) {
        assert.fail(error.stdout);
    }
});

test('the declarations have every export, with every method', () => {
    const text = readFileSync(path('../js/index.d.ts'), 'utf8');
    const named = [...text.matchAll(/^export (?:default )?(?:class|function) (\w+)/gm)].map(([, name]) => name);
    const exported = Object.keys(incircle).map((name) => (name === 'default' ? 'Incircle' : name));
    assert.deepEqual([...new Set(named)].sort(), [...new Set(exported)].sort());
    for (const name of ['Incircle', 'Triangulation', 'Voronoi']) {
        const body = text.slice(text.search(new RegExp(`^export (default )?class ${name}\\b`, 'm'))).split('\n}\n')[0];
        const declared = new Set([...body.matchAll(/^ {4}(?:readonly )?(\w+)[<(:]/gm)].map(([, method]) => method));
        const methods = Object.getOwnPropertyNames(incircle[name].prototype);
        assert.deepEqual(methods.filter((method) => !declared.has(method)), [], `methods of ${name} without a declaration`);
    }
});
