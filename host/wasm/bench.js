// Times of Incircle and delaunator on the same Float64Array, in turn, in Node.js or in a browser. In Node.js the times
// are those of the processor, which other programs disturb less. The argument is the number of points.
import Delaunator from 'delaunator';
import Incircle, {triangulate} from './js/index.js';
import {random} from './tests/random.js';

const RIVALS = {
    'triangulate, canonical': (coords) => triangulate(coords),
    'Incircle, with half-edges': (coords) => new Incircle(coords),
    'delaunator': (coords) => new Delaunator(coords),
};

/** The time of the processor in milliseconds. */
function processor() {
    const {user, system} = process.cpuUsage();
    return (user + system) / 1000;
}

/** The time of each rival in milliseconds, in one round. */
export function round(coords, now = () => performance.now()) {
    return Object.fromEntries(Object.entries(RIVALS).map(([name, run]) => {
        const start = now();
        run(coords);
        return [name, now() - start];
    }));
}

/** The best times of two rounds. */
export function best(one, other) {
    return Object.fromEntries(Object.entries(other).map(([name, time]) => [name, Math.min(time, one[name] ?? Infinity)]));
}

/** The points of a comparison. */
export function points(count) {
    return random(count, 1);
}

if (globalThis.process?.argv[1]?.endsWith('bench.js')) {
    const coords = points(Number(process.argv[2] ?? 1e6));
    let times = {};
    for (let k = 0; k < 7; k++) times = best(times, round(coords, processor));
    for (const [name, time] of Object.entries(times)) console.log(`${name}: ${time.toFixed(0)} ms of processor time`);
}
