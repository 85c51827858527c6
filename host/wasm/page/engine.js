// The module of WebAssembly that the page uses. Each mesh and the core have an instance of their own.
import {compile, open} from '../js/border.js';
import encoded from './module.js';

const MODULE = compile(encoded);

/** An instance of the module: its functions, the check of what they return, and the copies of their lists. */
export function openEngine() {
    return open(MODULE);
}
