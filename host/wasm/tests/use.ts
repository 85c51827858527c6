// Every public call with its types: the compiler of TypeScript checks this file, and nothing runs it.
import Incircle, {
    Incircle as Named, Triangulation, Voronoi, constrain, earcut, ties, triangulate, usedBytes, verify,
} from '../js/index.js';
import type {Bounds, Coordinates, Domain, Kind, Mesh, Pen} from '../js/index.js';

const coords: Coordinates = new Float64Array([0, 0, 4, 0, 0, 4]);
const made: Incircle<Float64Array> = Incircle.from([{a: 1, b: 2}], (point) => point.a, (point) => point.b);
const doubles: Float64Array = new Named(new Float64Array(6)).coords;
const halfedges: Int32Array = made.halfedges;
const lists: Uint32Array[] = [made.triangles, made.hull, made.duplicates, ties(coords), earcut([0, 0, 1, 0, 1, 1], [])];
made.update();

const bounds: Bounds = [0, 0, 1, 1];
const cells: Voronoi = made.voronoi(bounds);
const polygon: [number, number][] | null = cells.cellPolygon(0);
for (const cell of cells.cellPolygons()) console.log(cell.index, cell[0][0]);
const pen: Pen = null as unknown as CanvasRenderingContext2D;
const path: string | null = cells.render();
const drawn: void = cells.renderCell(0, pen);
console.log(new Voronoi(made).update().contains(0, 1, 2), [...cells.neighbors(0)], cells.circumcenters[0], cells.xmin);

const mesh: Mesh = triangulate([0, 0, 1, 1]);
const domain: Domain = 'even-odd';
const {triangles, regions}: {triangles: Uint32Array, regions: Uint32Array} = constrain(coords, [0, 1], domain);
constrain(coords, new Uint32Array(2), 'holes', [1, 1]);
verify(coords);

const living = Triangulation.from([[0, 0]]);
const point: number = living.insert(1, 2);
living.move(point, 3, 4);
living.moveAll(new Float64Array(4));
living.delete(point);
const {kind, vertices}: {kind: Kind, vertices: Uint32Array} = living.locate(0, 0);
const indices: Uint32Array = living.mesh().indices;
console.log(living.size, living.nearest(0, 0), living.neighbors(0), living.triangles(), usedBytes());
living.free();
console.log(doubles, halfedges, lists, polygon, path, drawn, mesh, triangles, regions, kind, vertices, indices);

// @ts-expect-error: coordinates are numbers
new Incircle(['a', 'b']);
// @ts-expect-error: integers of 64 bits are not taken
triangulate(new BigInt64Array(4));
// @ts-expect-error: there is no such domain
constrain(coords, [0, 1], 'inside');
// @ts-expect-error: the number of points cannot be set
living.size = 3;
// @ts-expect-error: a point has two coordinates
living.insert(1);
