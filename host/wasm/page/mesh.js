// The points of the page and their mesh, which follows every change.
import {ties} from '../js/index.js';
import {PlaneEngine} from './plane_engine.js';
import {onGrid, make} from './sets.js';

/** Most points whose ties are looked for after every change; those of larger sets are looked for when they rest. */
export const PROMPT_TIES = 5000;

/** A set of points with its mesh. Points are named by their places in the list of coordinates. */
export class PlaneMesh {
    #engine = new PlaneEngine();
    #speeds = null;
    /** The list of triangles, if it was asked for since the last change. */
    #listed = null;

    constructor(set, count, seed) {
        this.coords = make(set, count, seed);
        this.#triangulate();
    }

    get count() {
        return this.coords.length / 2;
    }

    /** The place of a point. */
    at(point) {
        return [this.coords[2 * point], this.coords[2 * point + 1]];
    }

    /** The triangles by the names of their points, in no order. */
    get triangles() {
        return this.#listed ??= this.#engine.triangles();
    }

    /** Triangulates all points anew. */
    #triangulate() {
        this.#change(() => {
            const {triangles, duplicates} = this.#engine.triangulate(this.coords);
            this.duplicates = duplicates;
            return triangles;
        });
    }

    /** Changes the mesh, notes the time that it takes, and looks for ties. */
    #change(change) {
        const start = performance.now();
        this.triangleCount = change();
        this.time = performance.now() - start;
        this.#listed = null;
        this.ties = this.count <= PROMPT_TIES ? ties(this.coords) : null;
    }

    /** Looks for the ties of a large set, now that it rests. */
    settle() {
        this.ties ??= ties(this.coords);
    }

    /** The pixels of a picture of the mesh; see `PlaneEngine.draw`. */
    draw(...picture) {
        return this.#engine.draw(...picture);
    }

    /** Moves a point to the nearest place on the grid. */
    move(point, x, y) {
        const place = [onGrid(x), onGrid(y)];
        this.coords.set(place, 2 * point);
        this.#change(() => this.#engine.move(point, ...place));
    }

    /** Inserts a point and returns its name. */
    insert(x, y) {
        const place = [onGrid(x), onGrid(y)];
        const point = this.count;
        const grown = new Float64Array(this.coords.length + 2);
        grown.set(this.coords);
        grown.set(place, this.coords.length);
        this.coords = grown;
        this.#change(() => this.#engine.insert(...place));
        return point;
    }

    /** Deletes a point. The points after it move up by one name. */
    delete(point) {
        const kept = new Float64Array(this.coords.length - 2);
        kept.set(this.coords.subarray(0, 2 * point));
        kept.set(this.coords.subarray(2 * point + 2), 2 * point);
        this.coords = kept;
        this.#speeds = null;
        this.#triangulate();
    }

    /** Lets every point drift for a frame, and triangulates anew. Points turn round at the border. */
    drift(side) {
        const coords = this.coords;
        if (this.#speeds?.length !== coords.length) {
            this.#speeds = Float64Array.from(coords, () => (Math.random() - 0.5) * side / 300);
        }
        for (let k = 0; k < coords.length; k++) {
            const next = coords[k] + this.#speeds[k];
            if (next < 0 || next > side - 1) this.#speeds[k] = -this.#speeds[k];
            coords[k] = onGrid(next);
        }
        this.#triangulate();
    }

    /** The point nearest to a place. */
    nearest(x, y) {
        let [best, least] = [-1, Infinity];
        for (let k = 0; k < this.coords.length; k += 2) {
            const distance = (this.coords[k] - x) ** 2 + (this.coords[k + 1] - y) ** 2;
            if (distance < least) [best, least] = [k / 2, distance];
        }
        return best;
    }

    /** The circles of the ties at a point: middle and radius of each. */
    circlesAt(point) {
        if (!this.ties?.length) return [];
        const tied = new Set();
        for (let k = 0; k < this.ties.length; k += 2) tied.add(`${this.ties[k]} ${this.ties[k + 1]}`);
        const circles = new Map();
        const list = this.triangles;
        for (let t = 0; t < list.length; t += 3) {
            if (list[t] !== point && list[t + 1] !== point && list[t + 2] !== point) continue;
            const corners = [list[t], list[t + 1], list[t + 2]];
            const isTied = corners.some((from, k) => {
                const to = corners[(k + 1) % 3];
                return tied.has(`${from} ${to}`) || tied.has(`${to} ${from}`);
            });
            if (!isTied) continue;
            const circle = circleThrough(...corners.map((corner) => this.at(corner)));
            circles.set(circle.map((value) => value.toPrecision(9)).join(' '), circle);
        }
        return [...circles.values()];
    }
}

/** Middle and radius of the circle through three points. */
function circleThrough([ax, ay], [bx, by], [cx, cy]) {
    const [ux, uy, vx, vy] = [bx - ax, by - ay, cx - ax, cy - ay];
    const [u, v, twice] = [ux * ux + uy * uy, vx * vx + vy * vy, 2 * (ux * vy - uy * vx)];
    const [x, y] = [(vy * u - uy * v) / twice, (ux * v - vx * u) / twice];
    return [ax + x, ay + y, Math.hypot(x, y)];
}
