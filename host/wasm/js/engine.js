// The border to the module of WebAssembly: buffers in, lists and messages out.
// `module.js` is made by `build`: it holds the bytes of the module as base64, so that nothing is fetched at run time.
import {compile, open} from './border.js';
import encoded from './module.js';

/** The functions of the module, the check of what they return, and the copies of their lists. */
export const {engine, checked, lists} = open(compile(encoded));

/** The most points that fit into the indices of half-edges. */
export const MAX_POINTS = Math.floor((2 ** 31 - 1) / 6);

/** Checks a coordinate and returns it. */
export function coordinate(name, value) {
    if (typeof value !== 'number') throw new TypeError(`${name} is of type ${typeof value}: give a number`);
    if (!Number.isFinite(value)) throw new RangeError(`${name} is ${value}: give a finite number`);
    return value;
}

/** The same for many coordinates: the name, which takes time to put together, is asked for only if it is needed. */
export function finite(value, name) {
    return Number.isFinite(value) ? value : coordinate(name(), value);
}

/** Checks an index of a point and returns it. */
export function index(value) {
    if (!Number.isInteger(value) || value < 0 || value > 0xffffffff) {
        throw new RangeError(`${String(value)} is no index of a point: give a whole number from 0 to 4294967295`);
    }
    return value;
}

/** Whether a value is a typed array of numbers, or a list. */
export function isList(value) {
    if (Array.isArray(value)) return true;
    return ArrayBuffer.isView(value) && !(value instanceof DataView) && typeof value[0] !== 'bigint' &&
        !(value instanceof BigInt64Array) && !(value instanceof BigUint64Array);
}

/**
 * The number of items of a list. A typed array whose buffer was transferred to another thread has no length any more,
 * and would pass for an empty one.
 */
function lengthOf(list) {
    if (ArrayBuffer.isView(list) && list.length === 0) {
        try {
            new Uint8Array(list.buffer);
        } catch {
            throw new TypeError('the buffer of the array is detached: give an array whose buffer was not transferred');
        }
    }
    return list.length;
}

/** Checks a list of coordinates, x and y of each point in turn, and returns the number of points. */
export function countOf(coords) {
    if (!isList(coords)) throw new TypeError('coordinates must be an Array or a typed array of numbers, and not of bigint');
    const length = lengthOf(coords);
    if (length % 2 !== 0) throw new RangeError(`${length} coordinates are an odd number: give x and y of each point`);
    const count = length / 2;
    if (count > MAX_POINTS) throw new RangeError(`${count} points are more than the ${MAX_POINTS} that half-edges allow`);
    return count;
}

/** A list that no code of the caller can change: a typed array as it is, and an Array with each item read once. */
function steady(list, length, check) {
    if (!Array.isArray(list)) return list;
    const items = new Float64Array(length);
    for (let k = 0; k < length; k++) items[k] = check(k, list[k]);
    return items;
}

/** Checks a list of coordinates and writes it to the address that the module gives. */
function write(coords, room, name) {
    const count = countOf(coords);
    const items = steady(coords, 2 * count, (k, value) => finite(value, () => name(k)));
    const place = room(count);
    if (place === 0) throw new RangeError(`there is no memory for ${count} points: give fewer at a time`);
    new Float64Array(engine.memory.buffer, place, 2 * count).set(items);
}

/** Checks the points of a set and writes them into the module. */
export function givePoints(coords) {
    write(coords, engine.room_for_points, (k) => `coordinate ${k}`);
}

/** Checks places that are no points of the set and writes them into the module. */
export function givePlaces(coords) {
    const name = (k) => `coordinate ${k} of the holes`;
    for (let k = 0; ArrayBuffer.isView(coords) && k < coords.length; k++) finite(coords[k], () => name(k));
    write(coords, engine.room_for_places, name);
}

/** Checks pairs of indices and writes them into the module. */
export function givePairs(pairs) {
    if (!isList(pairs)) throw new TypeError('constraints must be an Array or a typed array of indices');
    const length = lengthOf(pairs);
    if (length % 2 !== 0) throw new RangeError(`${length} indices are an odd number: give two for each constraint`);
    const items = steady(pairs, length, (_, value) => index(value));
    for (let k = 0; k < length; k++) index(items[k]);
    const place = engine.room_for_indices(length);
    if (place === 0) throw new RangeError(`there is no memory for ${length} indices: give fewer at a time`);
    new Uint32Array(engine.memory.buffer, place, length).set(items);
}
