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
 * The triangulation of a set of points with the interface of delaunator: triangles and hull are counter-clockwise on a
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
    /** The Voronoi cells, clipped to a rectangle; by default to that from (0, 0) to (960, 500). */
    voronoi(bounds?: Bounds): Voronoi;
}
export {Incircle};

/** A rectangle: least x, least y, greatest x, greatest y. */
export type Bounds = ArrayLike<number>;

/** What cells are drawn on: a canvas, or anything with these calls. */
export interface Pen {
    moveTo(x: number, y: number): void;
    lineTo(x: number, y: number): void;
    closePath(): void;
    rect(x: number, y: number, width: number, height: number): void;
}

/**
 * The Voronoi cells of a set with the interface of d3-delaunay. The neighbours of a cell are exact; its corners are
 * computed in doubles, each from its point, and so are right to some units in the last place of the size of the cell.
 */
export class Voronoi {
    constructor(delaunay: Incircle, bounds?: Bounds);
    readonly delaunay: Incircle;
    xmin: number;
    ymin: number;
    xmax: number;
    ymax: number;
    /** The centre of the circle of each triangle, x and y in turn. */
    circumcenters: Float64Array;
    /** The corners of a cell within the rectangle, the first once more at the end; `null` if no part lies within it. */
    cellPolygon(point: number): [number, number][] | null;
    /** All cells that have a part within the rectangle, each with the index of its point. */
    cellPolygons(): Generator<[number, number][] & {index: number}>;
    /** The points whose cells share an edge within the rectangle. O(neighbours). */
    neighbors(point: number): Generator<number>;
    /** Whether a place is no nearer to any other point than to this one. */
    contains(point: number, x: number, y: number): boolean;
    /** Computes everything again after `delaunay.update()`. */
    update(): this;
    /** Draws the edges of all cells, or returns them as the path of an SVG. */
    render(): string | null;
    render(pen: Pen): void;
    /** Draws the rectangle. */
    renderBounds(): string | null;
    renderBounds(pen: Pen): void;
    /** Draws the border of a cell. */
    renderCell(point: number): string | null;
    renderCell(point: number, pen: Pen): void;
}

/** The canonical mesh of a set of points, O(n) on even sets. */
export function triangulate(coords: Coordinates): Mesh;
/** Proves with the independent validator that the mesh of the points is canonical; throws if it is not. */
export function verify(coords: Coordinates): void;

/**
 * The edges of the canonical mesh whose two triangles have all four corners on one circle, as pairs of indices: a
 * triangulation with the other diagonal is Delaunay too, and the tie rule alone decided.
 */
export function ties(coords: Coordinates): Uint32Array;

/** The triangles that are wanted: all of the hull, or those inside the rings or outside the holes of constraints. */
export type Domain = 'all' | 'holes' | 'even-odd' | 'non-zero';
/**
 * The canonical mesh with pairs of indices as edges, cut to a domain. For the domain `holes`, `holes` has a place in
 * each hole, x and y in turn. Throws a `RangeError` if constraints cross, or if a place lies in no part of the hull.
 */
export function constrain(coords: Coordinates, pairs: number[] | Uint32Array, domain?: Domain, holes?: Coordinates):
    {triangles: Uint32Array; regions: Uint32Array};
/** The triangles of a polygon; `holes` has the first vertex of each hole. */
export function earcut(vertices: Coordinates, holes?: number[]): Uint32Array;

/** What a place can be; `none` if there are no triangles and the place lies on no edge. */
export type Kind = 'none' | 'vertex' | 'edge' | 'triangle' | 'outside';

/** A mesh that lives: points come, go and move, and the mesh stays canonical. */
export class Triangulation {
    constructor(coords?: Coordinates);
    static from<P>(points: ArrayLike<P>, getX?: (point: P) => number, getY?: (point: P) => number): Triangulation;
    /** The number of living points. */
    readonly size: number;
    /**
     * Inserts a point and returns its index, which is never used again.
     *
     * The mesh takes about 83 bytes a point, and its lists double when they are full. Every 1,024 insertions the mesh
     * checks that there is memory for that, and throws a `RangeError` if not. A module has at most 4 GiB: about 8
     * million points.
     */
    insert(x: number, y: number): number;
    /** Deletes the point of an index. Throws a `RangeError` if no living point has the index. */
    delete(point: number): void;
    /** Moves a point, which keeps its index. Throws a `RangeError` if no living point has the index. */
    move(point: number, x: number, y: number): void;
    /** Moves all living points: x and y of each new place in turn, in the order of the indices. */
    moveAll(coords: Coordinates): void;
    /**
     * Says what a place is, with the indices of the vertices there. Those of a triangle are counter-clockwise if y
     * grows upwards, the smallest first. Outside the hull they are the first hull edge that is visible from the place.
     */
    locate(x: number, y: number): {kind: Kind; vertices: Uint32Array};
    /** The index of the nearest point, or -1 if there is none. */
    nearest(x: number, y: number): number;
    /** The points that have an edge to a point. Throws a `RangeError` if no living point has the index. */
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
