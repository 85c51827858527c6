// Times of Incircle and delaunator on the same Float64Array, best of five, in turn. The argument is the number of points.
import Delaunator from 'delaunator';
import Incircle, {triangulate} from './js/index.js';
import {random} from './tests/random.js';

const coords = random(Number(process.argv[2] ?? 1e6), 1);
const rivals = {
    'Incircle, with half-edges': () => new Incircle(coords),
    'triangulate, canonical': () => triangulate(coords),
    'delaunator': () => new Delaunator(coords),
};
const best = {};
for (let round = 0; round < 5; round++) {
    for (const [name, run] of Object.entries(rivals)) {
        const start = performance.now();
        run();
        best[name] = Math.min(best[name] ?? Infinity, performance.now() - start);
    }
}
for (const [name, time] of Object.entries(best)) console.log(`${name}: ${time.toFixed(0)} ms`);
