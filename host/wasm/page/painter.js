// Draws a mesh on a canvas: small meshes with tinted triangles and round points, large ones as a web of light, whose
// pixels come from WebAssembly.

/** Most points of a mesh whose triangles are filled. */
export const MOST_FILLED = 3000;
/** Triangles in one path: one path of all edges would take much longer. */
const BATCH = 400;
/** Tints of triangles. */
const TINTS = Array.from({length: 16}, (_, k) => `hsl(${205 + k} ${42 + k}% ${12 + 0.75 * k}%)`);
const EDGE = 'rgb(104 170 214 / .55)';
const POINT = '#eef5ff';

/** Fills and outlines the triangles of a small mesh, and marks its points. */
function fill(pen, places, triangles) {
    const at = (corner) => [places[2 * corner], places[2 * corner + 1]];
    pen.lineWidth = 1;
    pen.strokeStyle = EDGE;
    for (let from = 0; from < triangles.length; from += 3 * BATCH) {
        const edges = new Path2D();
        const faces = new Map();
        for (let t = from; t < Math.min(triangles.length, from + 3 * BATCH); t += 3) {
            const tint = TINTS[(triangles[t] * 7 + triangles[t + 1] * 3 + triangles[t + 2]) % TINTS.length];
            if (!faces.has(tint)) faces.set(tint, new Path2D());
            for (const path of [edges, faces.get(tint)]) {
                path.moveTo(...at(triangles[t]));
                path.lineTo(...at(triangles[t + 1]));
                path.lineTo(...at(triangles[t + 2]));
                path.closePath();
            }
        }
        for (const [tint, path] of faces) {
            pen.fillStyle = tint;
            pen.fill(path);
        }
        pen.stroke(edges);
    }
    const radius = places.length > 600 ? 2.2 : 4;
    pen.fillStyle = POINT;
    for (let k = 0; k < places.length; k += 2) {
        pen.beginPath();
        pen.arc(places[k], places[k + 1], radius, 0, 2 * Math.PI);
        pen.fill();
    }
}

/** Draws a small mesh. */
function paintSmall(pen, stage, {coords, triangles}) {
    const places = new Float64Array(coords.length);
    for (let k = 0; k < coords.length; k += 2) places.set(stage.toCanvas(coords[k], coords[k + 1]), k);
    pen.setTransform(stage.ratio, 0, 0, stage.ratio, 0, 0);
    pen.fillStyle = '#0c1017';
    pen.fillRect(0, 0, stage.width, stage.height);
    fill(pen, places, triangles);
}

/** Draws a large mesh. */
function paintLarge(pen, stage, mesh) {
    const {width, height} = pen.canvas;
    if (width === 0 || height === 0) return;
    const [left, bottom] = stage.toCanvas(0, 0).map((at) => at * stage.ratio);
    const pixels = mesh.draw(width, height, left, bottom, stage.scale * stage.ratio);
    pen.putImageData(new ImageData(pixels, width, height), 0, 0);
}

/** Draws a mesh on a canvas on which the grid lies as `stage` says. */
export function paint(canvas, stage, mesh) {
    const pen = canvas.getContext('2d', {willReadFrequently: true});
    (mesh.count <= MOST_FILLED ? paintSmall : paintLarge)(pen, stage, mesh);
}
