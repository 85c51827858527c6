// Draws a mesh on a canvas: small meshes with tinted triangles and round points, large ones as a web of light.

/** Most points of a mesh whose triangles are filled. */
export const MOST_FILLED = 3000;
/** Triangles in one path: one path of all edges would take much longer. */
const BATCH = 400;
/** Levels of light that have a colour of their own. */
const LEVELS = 256;

/** Tints of triangles. */
const TINTS = Array.from({length: 16}, (_, k) => `hsl(${205 + k} ${42 + k}% ${12 + 0.75 * k}%)`);
const EDGE = 'rgb(104 170 214 / .55)';
const POINT = '#eef5ff';

/** Colours of the levels of light, as words of an image: from the ground over blue to white. */
const COLORS = Uint32Array.from({length: LEVELS}, (_, level) => {
    const light = level / (LEVELS - 1);
    const mixed = [[12, 58, 225], [16, 140, 244], [23, 190, 255]].map(([dark, middle, bright]) => (
        light < 0.5 ? dark + (middle - dark) * 2 * light : middle + (bright - middle) * (2 * light - 1)));
    const [red, green, blue] = mixed.map(Math.round);
    return (255 << 24 | blue << 16 | green << 8 | red) >>> 0;
});

/** Draws a small mesh. */
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

let [heat, image] = [new Float32Array(0), null];

/** Adds the light of the line between two places, in pixels, without its last pixel. */
function addLine(light, width, x0, y0, x1, y1) {
    // The line has one place on each row or column of pixels, and gives its light to the two pixels around it.
    const isSteep = Math.abs(y1 - y0) > Math.abs(x1 - x0);
    const isBackwards = isSteep ? y0 > y1 : x0 > x1;
    const along = isSteep ? width : 1;
    const across = isSteep ? 1 : width;
    const slope = isSteep ? (x1 - x0) / (y1 - y0) : (y1 - y0) / (x1 - x0);
    const begin = isSteep ? y0 : x0;
    const first = isSteep ? x0 : y0;
    const end = isSteep ? y1 : x1;
    const last = Math.round(isBackwards ? begin : end);
    for (let a = Math.round(isBackwards ? end : begin); a < last; a++) {
        const b = first + slope * (a + 0.5 - begin) - 0.5;
        const whole = Math.floor(b);
        const rest = (b - whole) * light;
        const pixel = a * along + whole * across;
        heat[pixel] += light - rest;
        heat[pixel + across] += rest;
    }
}

/** The light of an edge on a pixel that it covers: the less, the more edges there are on each pixel. */
function lightOf(count, area) {
    const layers = 3 * Math.sqrt(count / area);
    return 120 / (0.4 + 1.8 * layers);
}

/** Adds the light of all edges: with the hull each once, without it from both sides with half the light. */
function addEdges(light, width, places, triangles, hull) {
    const half = hull ? light : light / 2;
    for (let t = 0; t < triangles.length; t += 3) {
        let from = triangles[t + 2];
        for (let k = t; k < t + 3; k++) {
            const to = triangles[k];
            if (!hull || from < to) {
                addLine(half, width, places[2 * from], places[2 * from + 1], places[2 * to], places[2 * to + 1]);
            }
            from = to;
        }
    }
    if (!hull) return;
    let from = hull[hull.length - 1];
    for (const to of hull) {
        if (from > to) addLine(half, width, places[2 * from], places[2 * from + 1], places[2 * to], places[2 * to + 1]);
        from = to;
    }
}

/** Draws a large mesh: every pixel by the light of all edges across it. Places are in pixels of the canvas. */
function glow(pen, places, {triangles, hull}) {
    const {width, height} = pen.canvas;
    if (image?.width !== width || image.height !== height) {
        image = pen.createImageData(width, height);
        heat = new Float32Array(width * height);
    }
    heat.fill(0);
    const light = lightOf(places.length / 2, Math.min(width, height) ** 2);
    addEdges(light, width, places, triangles, hull);
    const pixels = new Uint32Array(image.data.buffer);
    for (let k = 0; k < pixels.length; k++) pixels[k] = COLORS[Math.min(LEVELS - 1, heat[k] | 0)];
    pen.putImageData(image, 0, 0);
}

/** Draws a mesh on a canvas on which the grid lies as `stage` says. */
export function paint(canvas, stage, mesh) {
    const {coords, triangles} = mesh;
    const pen = canvas.getContext('2d', {willReadFrequently: true});
    const isSmall = coords.length <= 2 * MOST_FILLED;
    const unit = isSmall ? 1 : stage.ratio;
    const places = new Float64Array(coords.length);
    const [left, bottom] = stage.toCanvas(0, 0);
    for (let k = 0; k < coords.length; k += 2) {
        places[k] = unit * (left + coords[k] * stage.scale);
        places[k + 1] = unit * (bottom - coords[k + 1] * stage.scale);
    }
    if (!isSmall) return glow(pen, places, mesh);
    pen.setTransform(stage.ratio, 0, 0, stage.ratio, 0, 0);
    pen.fillStyle = '#0c1017';
    pen.fillRect(0, 0, stage.width, stage.height);
    fill(pen, places, triangles);
}
