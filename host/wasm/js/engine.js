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

/** Checks a list of coordinates, x and y of each point in turn, and returns the number of points. */
export function countOf(coords) {
    if (!isList(coords)) throw new TypeError('coordinates must be an Array or a typed array of numbers, and not of bigint');
    if (coords.length % 2 !== 0) throw new RangeError(`${coords.length} coordinates are an odd number: give x and y of each point`);
    const count = coords.length / 2;
    if (count > MAX_POINTS) throw new RangeError(`${count} points are more than the ${MAX_POINTS} that half-edges allow`);
    if (Array.isArray(coords)) {
        for (let k = 0; k < coords.length; k++) coordinate(`coordinate ${k}`, coords[k]);
    }
    return count;
}

/** Checks a list of coordinates and writes it to the address that the module gives. */
function write(coords, room) {
    const count = countOf(coords);
    const place = room(count);
    if (place === 0) throw new RangeError(`there is no memory for ${count} points: give fewer at a time`);
    new Float64Array(engine.memory.buffer, place, coords.length).set(coords);
}

/** Checks the points of a set and writes them into the module. */
export function givePoints(coords) {
    write(coords, engine.room_for_points);
}

/** Checks places that are no points of the set and writes them into the module. */
export function givePlaces(coords) {
    for (let k = 0; isList(coords) && k < coords.length; k++) coordinate(`coordinate ${k} of the holes`, coords[k]);
    write(coords, engine.room_for_places);
}

/** Checks pairs of indices and writes them into the module. */
export function givePairs(pairs) {
    if (!isList(pairs)) throw new TypeError('constraints must be an Array or a typed array of indices');
    if (pairs.length % 2 !== 0) throw new RangeError(`${pairs.length} indices are an odd number: give two for each constraint`);
    for (let k = 0; k < pairs.length; k++) index(pairs[k]);
    const place = engine.room_for_indices(pairs.length);
    if (place === 0) throw new RangeError(`there is no memory for ${pairs.length} indices: give fewer at a time`);
    new Uint32Array(engine.memory.buffer, place, pairs.length).set(pairs);
}
