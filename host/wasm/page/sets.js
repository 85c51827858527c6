// Sets of points on the grid of whole coordinates from 0 to 65535, x and y of each point in turn.

/** One more than the greatest coordinate. */
export const SIDE = 65536;

/** A source of random numbers from 0 to 1 (mulberry32). */
export function source(seed) {
    return () => {
        seed = (seed + 0x6d2b79f5) | 0;
        let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
        t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
        return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
    };
}

/** The nearest whole coordinate on the grid. */
export function onGrid(value) {
    return Math.min(SIDE - 1, Math.max(0, Math.round(value)));
}

const MIDDLE = SIDE / 2;

/** A point at an angle and a distance from the middle. */
function around(angle, distance) {
    return [MIDDLE + distance * Math.cos(angle), MIDDLE + distance * Math.sin(angle)];
}

/** A place from the normal distribution around a place. */
function normal(random, x, y, spread) {
    const distance = spread * Math.sqrt(-2 * Math.log(1 - random()));
    const angle = 2 * Math.PI * random();
    return [x + distance * Math.cos(angle), y + distance * Math.sin(angle)];
}

/** For each set by its name: a function that makes point `k` of `count`. */
const MAKERS = {
    random: (random) => () => [random() * SIDE, random() * SIDE],
    grid: (random, count) => {
        const columns = Math.ceil(Math.sqrt(count));
        const step = Math.floor(SIDE / columns);
        return (k) => [(k % columns + 0.5) * step, (Math.floor(k / columns) + 0.5) * step].map(Math.floor);
    },
    sunflower: (random, count) => (k) => around(k * Math.PI * (3 - Math.sqrt(5)), 0.49 * SIDE * Math.sqrt((k + 0.5) / count)),
    clusters: (random) => {
        const centres = Array.from({length: 7}, () => [0.15 + 0.7 * random(), 0.15 + 0.7 * random()].map((at) => at * SIDE));
        return (k) => normal(random, ...centres[k % 7], SIDE / 18);
    },
    circles: (random, count) => {
        // Whole points at whole distances, so that they lie on the circles exactly. What finds no circle is random.
        const ring = pointsOnCircle();
        const rings = Math.min(MOST_RINGS, Math.ceil(count / ring.length));
        return (k) => {
            const turn = Math.floor(k / ring.length);
            if (turn >= rings) return [random() * SIDE, random() * SIDE];
            const scale = Math.round(MOST_RINGS * (1 - turn / rings));
            return ring[k % ring.length].map((at) => MIDDLE + at * scale);
        };
    },
};

/** The most circles around the middle: one for each multiple of the smallest that fits. */
const MOST_RINGS = 400;

/** The 36 whole points at distance 65 from the origin, in the order of their angles. */
function pointsOnCircle() {
    const found = [];
    for (let x = -65; x <= 65; x++) {
        for (let y = -65; y <= 65; y++) if (x * x + y * y === 65 * 65) found.push([x, y]);
    }
    return found.sort((one, other) => Math.atan2(one[1], one[0]) - Math.atan2(other[1], other[0]));
}

/** Names of the sets. */
export const SETS = Object.keys(MAKERS);

/** The coordinates of a set of `count` points; the same `seed` gives the same set. */
export function make(set, count, seed) {
    const point = MAKERS[set](source(seed), count);
    const coords = new Float64Array(2 * count);
    for (let k = 0; k < count; k++) coords.set(point(k).map(onGrid), 2 * k);
    return coords;
}
