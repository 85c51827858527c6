// The mesh of a set of points in WebAssembly: it follows changes of the points, and draws itself as a web of light.
import {openEngine} from './engine.js';

/** The mesh of points on the grid. It and its memory go with the last reference to it. */
export class PlaneEngine {
    #module = openEngine();

    /** Triangulates points, given as x and y in turn. Returns the numbers of triangles and of duplicates. */
    triangulate(coords) {
        const {engine, checked, lists} = this.#module;
        const place = engine.room_for_points(coords.length / 2);
        if (place === 0) throw new RangeError(`there is no memory for ${coords.length / 2} points: choose fewer`);
        new Float64Array(engine.memory.buffer, place, coords.length).set(coords);
        const triangles = checked(engine.plane_triangulate());
        return {triangles, duplicates: lists(1)[0].length / 2};
    }

    /** Moves a point. Returns the number of triangles. */
    move(point, x, y) {
        return this.#module.checked(this.#module.engine.plane_move(point, x, y));
    }

    /** Inserts a point, whose name is the number of points before. Returns the number of triangles. */
    insert(x, y) {
        return this.#module.checked(this.#module.engine.plane_insert(x, y));
    }

    /** The triangles by the names of their points, in no order. */
    triangles() {
        this.#module.checked(this.#module.engine.plane_triangles());
        return this.#module.lists(1)[0];
    }

    /**
     * The pixels of a picture of the mesh, in the memory of the module: the next call may change them. The grid's origin
     * is at `left` and `bottom`, in pixels, and a step of the grid is `scale` pixels long.
     */
    draw(width, height, left, bottom, scale) {
        const {engine, checked} = this.#module;
        const place = checked(engine.plane_draw(width, height, left, bottom, scale));
        return new Uint8ClampedArray(engine.memory.buffer, place, 4 * width * height);
    }
}
