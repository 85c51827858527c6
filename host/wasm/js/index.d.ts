/** Coordinates, x and y of each point in turn. Every number is taken as the exact double that it is. */
export type Coordinates = number[] | Float64Array | Float32Array | Int32Array | Uint32Array | Int16Array | Uint16Array |
    Int8Array | Uint8Array;

/** The canonical mesh: one set of points has exactly one. */
export interface Mesh {
    /** Three indices a triangle, counter-clockwise if y grows upwards, the smallest first; triangles in order. */
    triangles: Uint32Array;
    /** The points of the hull, counter-clockwise, the lowest index first. */
    hull: Uint32Array;
    /** Pairs: a point with the coordinates of an earlier one, and that one. */
    duplicates: Uint32Array;
}

/**
 * The triangulation of a set of points in the shape of delaunator: triangles and hull are counter-clockwise on a
 * screen, where y grows downwards. Throws a `TypeError` or `RangeError` for input that is no set of finite points.
 */
export default class Incircle<T extends Coordinates = Coordinates> {
    static from<P>(points: ArrayLike<P>, getX?: (point: P) => number, getY?: (point: P) => number): Incircle<Float64Array>;
    constructor(coords: T);
    coords: T;
    triangles: Uint32Array;
    /** Half-edge `e` starts at point `triangles[e]`; its value is the other half of the edge, or -1 on the hull. */
    halfedges: Int32Array;
    hull: Uint32Array;
    duplicates: Uint32Array;
    /** Triangulates again after `coords` was changed. */
    update(): void;
}
export {Incircle};

/** The canonical mesh of a set of points, O(n) on even sets. */
export function triangulate(coords: Coordinates): Mesh;
/** Proves with the independent validator that the mesh of the points is canonical; throws if it is not. */
export function verify(coords: Coordinates): void;

/**
 * The edges of the canonical mesh whose two triangles have all four corners on one circle, as pairs of indices: a
 * triangulation with the other diagonal is Delaunay too, and the tie rule alone decided.
 */
export function ties(coords: Coordinates): Uint32Array;

export type Domain = 'all' | 'holes' | 'even-odd' | 'non-zero';
/** The canonical mesh with pairs of indices as edges. Throws a `RangeError` if constraints cross. */
export function constrain(coords: Coordinates, pairs: number[] | Uint32Array, domain?: Domain):
    {triangles: Uint32Array; regions: Uint32Array};
/** The triangles of a polygon; `holes` has the first vertex of each hole. */
export function earcut(vertices: Coordinates, holes?: number[]): Uint32Array;

export type Kind = 'none' | 'vertex' | 'edge' | 'triangle' | 'outside';

/** A mesh that lives: points come, go and move, and the mesh stays canonical. */
export class Triangulation {
    constructor(coords?: Coordinates);
    static from<P>(points: ArrayLike<P>, getX?: (point: P) => number, getY?: (point: P) => number): Triangulation;
    /** The number of living points. */
    readonly size: number;
    /** Inserts a point and returns its index, which is never used again. */
    insert(x: number, y: number): number;
    delete(point: number): void;
    move(point: number, x: number, y: number): void;
    /** Moves all living points, in the order of their indices. */
    moveAll(coords: Coordinates): void;
    locate(x: number, y: number): {kind: Kind; vertices: Uint32Array};
    /** The index of the nearest point, or -1 if there is none. */
    nearest(x: number, y: number): number;
    neighbors(point: number): Uint32Array;
    /** The triangles by the indices of their points, in no order. */
    triangles(): Uint32Array;
    /** The canonical mesh of the living points; its numbers are positions in `indices`. */
    mesh(): Mesh & {indices: Uint32Array};
    /** Frees the mesh now instead of when the object is collected. */
    free(): void;
}

/** The bytes that the engine uses now. */
export function usedBytes(): number;
