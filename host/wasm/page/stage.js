// The place of the grid on a canvas, and the loop that draws frames.
import {SIDE} from './sets.js';

/** Pixels between the grid and the border of a canvas. */
const MARGIN = 26;

/** Fits a canvas to its place on the page, and returns how the grid lies on it, in pixels of the page. */
export function fit(canvas) {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    const [wide, high] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== wide || canvas.height !== high) [canvas.width, canvas.height] = [wide, high];
    const scale = Math.max(1, Math.min(width, height) - 2 * MARGIN) / SIDE;
    const [left, top] = [(width - scale * SIDE) / 2, (height - scale * SIDE) / 2];
    return {
        ratio, width, height, scale,
        /** The place on the canvas of a place on the grid, whose y grows upwards. */
        toCanvas: (x, y) => [left + x * scale, height - top - y * scale],
        /** The place on the grid of a place on the canvas. */
        toGrid: (x, y) => [(x - left) / scale, (height - top - y) / scale],
    };
}

/** A drawing context in pixels of the page, on a cleared canvas. */
export function cleared(canvas, ratio) {
    const pen = canvas.getContext('2d');
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, canvas.width, canvas.height);
    return pen;
}

/** Calls `frame` with the time in milliseconds once for each frame of the screen, while it is started. */
export function loop(frame) {
    let request = 0;
    const next = (time) => {
        request = requestAnimationFrame(next);
        frame(time);
    };
    return {
        start: () => { if (!request) request = requestAnimationFrame(next); },
        stop: () => { cancelAnimationFrame(request); request = 0; },
    };
}

/** Fills a list of choices. */
export function choices(select, names, chosen) {
    select.replaceChildren(...names.map((name) => new Option(name.toLocaleString('en'), name, false, name === chosen)));
}
