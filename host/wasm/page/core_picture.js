// Draws the mesh of the core with its locks, cavities, walks and points.
import {decode, NONE} from './core_engine.js';
import {COLORS} from './core_colors.js';
import {cleared} from './stage.js';

const EDGE = 'rgb(120 150 190 / .42)';
const WAITING = 'rgb(147 160 184 / .45)';
const INSERTED = '#cdd8ea';
/** Words of a record: three vertices, the context that holds its lock, whether it is in the cavity. */
const RECORD_WORDS = 5;

/** Stripes of a colour, for locks whose attempt ends. */
function stripes(pen, color) {
    const tile = new OffscreenCanvas(6, 6);
    const brush = tile.getContext('2d');
    brush.strokeStyle = color;
    brush.lineWidth = 1.6;
    brush.beginPath();
    for (const from of [-6, 0, 6]) {
        brush.moveTo(from, 6);
        brush.lineTo(from + 6, 0);
    }
    brush.stroke();
    return pen.createPattern(tile, 'repeat');
}

/** Stripes of each context, made when they are first needed. */
const PATTERNS = [];

/** Draws the records, those with locks filled. */
function drawRecords(pen, at, state) {
    const {records, contexts} = state;
    const edges = new Path2D();
    for (let k = 0; k < records.length; k += RECORD_WORDS) {
        const vertices = [records[k], records[k + 1], records[k + 2]];
        const finite = vertices.filter((vertex) => vertex !== NONE);
        const path = new Path2D();
        finite.forEach((vertex, place) => (place ? path.lineTo(...at(vertex)) : path.moveTo(...at(vertex))));
        if (finite.length === 3) path.closePath();
        edges.addPath(path);
        const holder = records[k + 3];
        if (holder === NONE) continue;
        const color = COLORS[holder];
        const {isEnding} = decode(contexts[2 * holder]);
        const isCavity = records[k + 4] === 1;
        pen.globalAlpha = isEnding ? 0.7 : isCavity ? 0.78 : 0.24;
        if (finite.length === 3) {
            pen.fillStyle = isEnding ? PATTERNS[holder] ??= stripes(pen, color) : color;
            pen.fill(path);
        } else {
            pen.strokeStyle = color;
            pen.lineWidth = 4;
            pen.stroke(path);
        }
    }
    pen.globalAlpha = 1;
    pen.strokeStyle = EDGE;
    pen.lineWidth = 1;
    pen.stroke(edges);
}

/** Draws a line from each visited record to the point for which a context visits it. */
function drawVisits(pen, at, state) {
    const {visits, records, contexts} = state;
    pen.lineWidth = 1.4;
    for (let k = 0; k < visits.length; k += 2) {
        const [context, record] = [visits[k], visits[k + 1]];
        const point = contexts[2 * context + 1];
        const first = record * RECORD_WORDS;
        if (point === NONE || first >= records.length) continue;
        const corners = [...records.subarray(first, first + 3)].filter((vertex) => vertex !== NONE).map(at);
        const middle = [0, 1].map((axis) => corners.reduce((sum, corner) => sum + corner[axis], 0) / corners.length);
        pen.strokeStyle = COLORS[context];
        pen.setLineDash([4, 4]);
        pen.beginPath();
        pen.moveTo(...middle);
        pen.lineTo(...at(point));
        pen.stroke();
        pen.setLineDash([]);
        pen.fillStyle = COLORS[context];
        pen.fillRect(middle[0] - 2, middle[1] - 2, 4, 4);
    }
}

/** Draws the points: those that wait, those in the mesh, and those that contexts insert. */
function drawPoints(pen, at, state, count) {
    const inMesh = new Uint8Array(count);
    for (let k = 0; k < state.records.length; k += RECORD_WORDS) {
        for (let slot = 0; slot < 3; slot++) if (state.records[k + slot] !== NONE) inMesh[state.records[k + slot]] = 1;
    }
    for (let point = 0; point < count; point++) {
        const [x, y] = at(point);
        const radius = inMesh[point] ? 1.7 : 1.2;
        pen.fillStyle = inMesh[point] ? INSERTED : WAITING;
        pen.fillRect(x - radius, y - radius, 2 * radius, 2 * radius);
    }
    pen.font = '600 11px system-ui, sans-serif';
    pen.textAlign = 'center';
    pen.textBaseline = 'middle';
    for (let context = 0; 2 * context < state.contexts.length; context++) {
        const point = state.contexts[2 * context + 1];
        if (point === NONE) continue;
        const [x, y] = at(point);
        pen.fillStyle = COLORS[context];
        pen.strokeStyle = '#0c1017';
        pen.lineWidth = 2;
        pen.beginPath();
        pen.arc(x, y, 9, 0, 2 * Math.PI);
        pen.fill();
        pen.stroke();
        pen.fillStyle = '#0c1017';
        pen.fillText(context, x, y + 0.5);
    }
}

/** Draws the core. */
export function drawCore(canvas, stage, {coords, state}) {
    const pen = cleared(canvas, stage.ratio);
    const at = (point) => stage.toCanvas(coords[2 * point], coords[2 * point + 1]);
    drawRecords(pen, at, state);
    drawPoints(pen, at, state, coords.length / 2);
    drawVisits(pen, at, state);
}
