/** Coordinates of random points between 0 and 1 (mulberry32). */
export function random(count, seed) {
    return Float64Array.from({length: 2 * count}, () => {
        seed = (seed + 0x6d2b79f5) | 0;
        let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
        t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
        return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
    });
}
