import {checked, coordinate, countOf, engine, givePairs, givePlaces, givePoints, index, isList, lists} from './engine.js';
import {Voronoi} from './voronoi.js';

const first = (point) => point[0];
const second = (point) => point[1];

/** The coordinates of points, x and y in turn. */
function coordinates(points, getX = first, getY = second) {
    if (!Number.isInteger(points?.length) || points.length < 0) {
        throw new TypeError('points must be a list, such as an array of arrays [x, y]: it has no length');
    }
    if (getX === first || getY === second) {
        for (let k = 0; k < points.length; k++) {
            if (points[k] === null || points[k] === undefined) throw new TypeError(`point ${k} is ${points[k]}: give [x, y]`);
        }
    }
    const coords = new Float64Array(2 * points.length);
    for (let k = 0; k < points.length; k++) {
        coords[2 * k] = coordinate(`x of point ${k}`, getX(points[k]));
        coords[2 * k + 1] = coordinate(`y of point ${k}`, getY(points[k]));
    }
    return coords;
}

/** The triangulation of a set of points in the shape of delaunator. */
export default class Incircle {
    static from(points, getX, getY) {
        return new Incircle(coordinates(points, getX, getY));
    }

    constructor(coords) {
        this.coords = coords;
        this.update();
    }

    update() {
        givePoints(this.coords);
        checked(engine.triangulate(1));
        const [triangles, hull, duplicates, halfedges] = lists(4);
        this.triangles = triangles;
        this.hull = hull;
        this.duplicates = duplicates;
        this.halfedges = new Int32Array(halfedges.buffer);
    }

    /** The Voronoi cells of the points, clipped to a rectangle. */
    voronoi(bounds) {
        return new Voronoi(this, bounds);
    }
}

export {Incircle, Voronoi};

/** The canonical mesh: counter-clockwise where y grows upwards, sorted, the same as that of every other back end. */
export function triangulate(coords) {
    givePoints(coords);
    checked(engine.triangulate(0));
    const [triangles, hull, duplicates] = lists(3);
    return {triangles, hull, duplicates};
}

/** Proves with the independent validator that the mesh of the points is the canonical one; throws if it is not. */
export function verify(coords) {
    givePoints(coords);
    checked(engine.verify());
    engine.forget();
}

/** The edges of the canonical mesh that the tie rule alone decided, as pairs of indices. */
export function ties(coords) {
    givePoints(coords);
    checked(engine.ties());
    return lists(1)[0];
}

const DOMAINS = ['all', 'holes', 'even-odd', 'non-zero'];

/** The canonical mesh with pairs of indices forced in as edges, cut to a domain. `holes` has a place in each hole. */
export function constrain(coords, pairs, domain = 'all', holes = []) {
    const number = DOMAINS.indexOf(domain);
    if (number < 0) throw new RangeError(`${String(domain)} is no domain: give ${DOMAINS.join(', ')}`);
    if (!isList(holes)) throw new TypeError('holes must be an Array or a typed array, x and y of each place in turn');
    if (holes.length > 0 && domain !== 'holes') {
        throw new RangeError(`the domain ${domain} takes no holes, and ${holes.length / 2} are given: give the domain 'holes'`);
    }
    try {
        givePairs(pairs);
        givePlaces(holes);
        givePoints(coords);
        checked(engine.constrained(number));
        const [triangles, regions] = lists(2);
        return {triangles, regions};
    } finally {
        engine.forget();
    }
}

/** The triangles of a polygon with holes, in the shape of earcut: `holes` has the first vertex of each hole. */
export function earcut(vertices, holes = []) {
    const count = countOf(vertices);
    if (!isList(holes)) throw new TypeError('holes must be an Array or a typed array of indices of vertices');
    const starts = [0, ...holes, count].map(index);
    const pairs = [];
    for (let ring = 0; ring + 1 < starts.length; ring++) {
        const [from, to] = [starts[ring], starts[ring + 1]];
        if (from > to) throw new RangeError(`ring ${ring} begins at vertex ${from}, behind its end ${to}`);
        for (let k = from; k < to; k++) pairs.push(k, k + 1 < to ? k + 1 : from);
    }
    return constrain(vertices, pairs, 'even-odd').triangles;
}

const KINDS = ['none', 'vertex', 'edge', 'triangle', 'outside'];
const forgotten = new FinalizationRegistry((handle) => engine.living_free(handle));

/** A mesh that lives: points come, go and move. */
export class Triangulation {
    #handle;

    constructor(coords = []) {
        givePoints(coords);
        this.#handle = checked(engine.living_new());
        forgotten.register(this, this.#handle, this);
    }

    static from(points, getX, getY) {
        return new Triangulation(coordinates(points, getX, getY));
    }

    /** Frees the mesh. Without this call the mesh is freed some time after the last reference to it is gone. */
    free() {
        if (this.#handle === -1) return;
        forgotten.unregister(this);
        engine.living_free(this.#handle);
        this.#handle = -1;
    }

    get size() {
        return checked(engine.living_size(this.#handle));
    }

    insert(x, y) {
        return checked(engine.living_insert(this.#handle, coordinate('x', x), coordinate('y', y)));
    }

    delete(point) {
        checked(engine.living_delete(this.#handle, index(point)));
    }

    move(point, x, y) {
        checked(engine.living_move(this.#handle, index(point), coordinate('x', x), coordinate('y', y)));
    }

    moveAll(coords) {
        givePoints(coords);
        checked(engine.living_move_all(this.#handle));
        engine.forget();
    }

    locate(x, y) {
        const kind = checked(engine.living_locate(this.#handle, coordinate('x', x), coordinate('y', y)));
        return {kind: KINDS[kind], vertices: lists(1)[0]};
    }

    nearest(x, y) {
        return checked(engine.living_nearest(this.#handle, coordinate('x', x), coordinate('y', y)));
    }

    neighbors(point) {
        checked(engine.living_neighbors(this.#handle, index(point)));
        return lists(1)[0];
    }

    /** The triangles by the indices of their points, in no order. */
    triangles() {
        checked(engine.living_triangles(this.#handle));
        return lists(1)[0];
    }

    /** The canonical mesh; its numbers are positions in `indices`. */
    mesh() {
        checked(engine.living_mesh(this.#handle));
        const [triangles, hull, duplicates, indices] = lists(4);
        return {triangles, hull, duplicates, indices};
    }
}

/** The bytes that the module uses now, for tests of leaks. */
export function usedBytes() {
    return engine.used_bytes();
}
