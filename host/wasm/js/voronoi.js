// Voronoi cells with the interface of d3-delaunay: a rectangle, cut by the half planes of the neighbours in the mesh.
import {coordinate, index} from './engine.js';

/** The rectangle of d3-delaunay. */
const BOUNDS = [0, 0, 960, 500];
/** Stands for a side of the rectangle where the neighbours of a cell are listed. */
const SIDE = -1;

/** The path of an SVG, drawn with the calls of a canvas. */
class Path {
    #text = '';

    moveTo(x, y) { this.#text += `M${x},${y}`; }
    lineTo(x, y) { this.#text += `L${x},${y}`; }
    closePath() { this.#text += 'Z'; }
    rect(x, y, width, height) { this.#text += `M${x},${y}h${width}v${height}h${-width}Z`; }

    /** The path, or `null` if nothing was drawn. */
    value() { return this.#text || null; }
}

/** Draws on a pen; without one, returns what was drawn as a path. */
function drawn(pen, draw) {
    if (pen !== undefined && pen !== null) return draw(pen);
    const path = new Path();
    draw(path);
    return path.value();
}

/**
 * Cuts a convex polygon: keeps what lies no farther along `(dx, dy)` than half the square of that vector. `corners` has
 * x, y and the neighbour behind the edge that begins there; the new edge gets `neighbor`.
 */
function cut(corners, dx, dy, neighbor) {
    const limit = (dx * dx + dy * dy) / 2;
    const excess = corners.map(([x, y]) => x * dx + y * dy - limit);
    const kept = [];
    for (let k = 0; k < corners.length; k++) {
        const next = (k + 1) % corners.length;
        const [x, y, behind] = corners[k];
        if (excess[k] <= 0) kept.push(corners[k]);
        if (excess[k] <= 0 === excess[next] <= 0) continue;
        const share = excess[k] / (excess[k] - excess[next]);
        const [toX, toY] = corners[next];
        // Where the border goes out of the half plane, the new edge begins; where it comes back, the old one goes on.
        kept.push([x + share * (toX - x), y + share * (toY - y), excess[k] <= 0 ? neighbor : behind]);
    }
    return kept;
}

/** The Voronoi cells of a set. */
export class Voronoi {
    #neighbors;
    #cells;

    constructor(delaunay, bounds = BOUNDS) {
        if (typeof delaunay?.update !== 'function' || !delaunay.halfedges) {
            throw new TypeError('cells need a triangulation: give an Incircle');
        }
        const [xmin, ymin, xmax, ymax] = Array.from(bounds, (value, k) => coordinate(`side ${k} of the bounds`, value));
        if (!(xmax >= xmin && ymax >= ymin)) {
            throw new RangeError(`the bounds from (${xmin}, ${ymin}) to (${xmax}, ${ymax}) are no rectangle: give the least sides first`);
        }
        this.delaunay = delaunay;
        Object.assign(this, {xmin, ymin, xmax, ymax});
        this.update();
    }

    update() {
        const {coords, triangles, hull, duplicates} = this.delaunay;
        this.#cells = new Map();
        this.#neighbors = Array.from({length: coords.length / 2}, () => new Set());
        const join = (one, other) => {
            this.#neighbors[one].add(other);
            this.#neighbors[other].add(one);
        };
        this.circumcenters = new Float64Array(triangles.length / 3 * 2);
        for (let t = 0; t < triangles.length; t += 3) {
            const [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]];
            join(a, b);
            join(b, c);
            join(c, a);
            this.circumcenters.set(this.#circumcenter(a, b, c), t / 3 * 2);
        }
        // Points on one line have no triangle, and the hull lists them along the line.
        for (let k = 1; triangles.length === 0 && k < hull.length; k++) join(hull[k - 1], hull[k]);
        for (let k = 0; k < duplicates.length; k += 2) this.#neighbors[duplicates[k]] = null;
        return this;
    }

    #place(point) {
        return [this.delaunay.coords[2 * point], this.delaunay.coords[2 * point + 1]];
    }

    #circumcenter(a, b, c) {
        const [ax, ay] = this.#place(a);
        const [ux, uy, vx, vy] = [b, c].flatMap((corner) => this.#place(corner)).map((value, k) => value - (k % 2 ? ay : ax));
        const [u, v, twice] = [ux * ux + uy * uy, vx * vx + vy * vy, 2 * (ux * vy - uy * vx)];
        return [ax + (vy * u - uy * v) / twice, ay + (ux * v - vx * u) / twice];
    }

    /** The corners of a cell relative to its point, each with the neighbour behind the edge that begins there. */
    #cell(point) {
        const around = this.#neighbors[index(point)];
        if (around === undefined) throw new RangeError(`there is no point ${point}: the set has ${this.#neighbors.length}`);
        if (around === null) return [];
        const known = this.#cells.get(point);
        if (known) return known;
        const [x, y] = this.#place(point);
        const [left, low, right, high] = [this.xmin - x, this.ymin - y, this.xmax - x, this.ymax - y];
        let corners = [[left, low, SIDE], [right, low, SIDE], [right, high, SIDE], [left, high, SIDE]];
        for (const other of around) {
            const [ox, oy] = this.#place(other);
            corners = cut(corners, ox - x, oy - y, other);
        }
        // Neighbours at one corner leave edges without a length.
        corners = corners.filter(([cx, cy], k) => {
            const [nx, ny] = corners[(k + 1) % corners.length];
            return cx !== nx || cy !== ny;
        });
        if (corners.length < 3) corners = [];
        this.#cells.set(point, corners);
        return corners;
    }

    cellPolygon(point) {
        const corners = this.#cell(point);
        if (corners.length === 0) return null;
        const [x, y] = this.#place(point);
        const polygon = corners.map(([cx, cy]) => [x + cx, y + cy]);
        polygon.push([...polygon[0]]);
        return polygon;
    }

    *cellPolygons() {
        for (let point = 0; point < this.#neighbors.length; point++) {
            const polygon = this.cellPolygon(point);
            if (polygon) yield Object.assign(polygon, {index: point});
        }
    }

    *neighbors(point) {
        for (const [, , behind] of this.#cell(point)) if (behind !== SIDE) yield behind;
    }

    contains(point, x, y) {
        this.#cell(point);
        const [px, py] = this.#place(point);
        const [dx, dy] = [coordinate('x', x) - px, coordinate('y', y) - py];
        for (const other of this.#neighbors[point] ?? []) {
            const [ox, oy] = this.#place(other);
            if ((ox - x) ** 2 + (oy - y) ** 2 < dx * dx + dy * dy) return false;
        }
        return this.#neighbors[point] !== null;
    }

    render(pen) {
        return drawn(pen, (path) => {
            for (let point = 0; point < this.#neighbors.length; point++) {
                const corners = this.#cell(point);
                const [x, y] = this.#place(point);
                corners.forEach(([cx, cy, behind], k) => {
                    // Each edge belongs to two cells. Sides of the rectangle are drawn by `renderBounds`.
                    if (behind <= point) return;
                    const [nx, ny] = corners[(k + 1) % corners.length];
                    path.moveTo(x + cx, y + cy);
                    path.lineTo(x + nx, y + ny);
                });
            }
        });
    }

    renderBounds(pen) {
        return drawn(pen, (path) => path.rect(this.xmin, this.ymin, this.xmax - this.xmin, this.ymax - this.ymin));
    }

    renderCell(point, pen) {
        return drawn(pen, (path) => {
            const polygon = this.cellPolygon(point);
            if (!polygon) return;
            path.moveTo(...polygon[0]);
            for (const corner of polygon.slice(1, -1)) path.lineTo(...corner);
            path.closePath();
        });
    }
}
