// The model of the core in WebAssembly: start a job, run clocks, look at the state.
import {openEngine} from './engine.js';

const {engine, checked, lists} = openEngine();

/** Names of the activities, by their numbers. */
export const ACTIVITIES = ['idle', 'walk', 'root', 'cavity', 'drain', 'rest', 'solo'];
/** Stands for a vertex or a context that there is not. */
export const NONE = 0xffffffff;

/** An activity as the module lists it: the number of the activity, and two marks. */
export function decode(listed) {
    return {activity: listed & 7, isEnding: (listed & 8) !== 0, hasPriority: (listed & 16) !== 0};
}

/** Starts a job on a core: whole coordinates from 0 to 65535, x and y of each point in turn. */
export function start(coords, contexts) {
    const place = engine.room_for_points(coords.length / 2);
    new Float64Array(engine.memory.buffer, place, coords.length).set(coords);
    checked(engine.core_start(contexts));
    engine.forget();
}

/** Runs clocks. Returns the activities of all contexts at each of the last of them. */
export function run(clocks) {
    checked(engine.core_run(clocks));
    return lists(1)[0];
}

/** The state of the core. Vertices are indices of points; `NONE` is the infinite vertex. */
export function state() {
    checked(engine.core_state());
    const [figures, contexts, records, visits] = lists(4);
    const [clocks, finished, retries, locks, inFlight, isDone] = figures;
    return {clocks, finished, retries, locks, inFlight, isDone: isDone === 1, contexts, records, visits};
}
