// Comparing the mesh of the core with that of the triangulator.
import {triangulate} from '../js/index.js';
import {NONE} from './core_engine.js';

/** Whether the triangles of the core's records are those of the canonical mesh of the points. */
export function isCanonical(records, coords) {
    const found = [];
    for (let k = 0; k < records.length; k += 5) {
        const corners = [records[k], records[k + 1], records[k + 2]];
        if (corners.includes(NONE)) continue;
        const least = corners.indexOf(Math.min(...corners));
        found.push([0, 1, 2].map((turn) => corners[(least + turn) % 3]));
    }
    found.sort((one, other) => one[0] - other[0] || one[1] - other[1] || one[2] - other[2]);
    const {triangles} = triangulate(coords);
    return found.length === triangles.length / 3 && found.flat().every((corner, k) => corner === triangles[k]);
}
