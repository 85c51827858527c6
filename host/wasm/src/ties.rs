//! Ties: edges that the tie rule alone decided.
#![allow(unsafe_code)] // names of functions that JavaScript calls

use incircle_geometry::{double, Mesh, EMPTY};

use crate::batch::mesh_of;
use crate::border::{give, points, told};

/// The edges between two triangles whose four corners lie on one circle, each once, as two indices. O(n).
fn tied_edges(mesh: &Mesh<[f64; 2]>) -> Vec<u32> {
    let corners = mesh.triangles.as_flattened();
    let at = |edge: usize| mesh.points[corners[edge] as usize];
    // The half-edges of a triangle, in turn.
    let next = |edge: usize| edge / 3 * 3 + (edge + 1) % 3;
    let twins = mesh.halfedges();
    let mut found = Vec::new();
    for (edge, twin) in twins.iter().map(|&twin| twin as usize).enumerate().filter(|&(edge, twin)| edge < twin) {
        if twin == EMPTY as usize {
            continue;
        }
        let (to, apex, opposite) = (next(edge), next(next(edge)), next(next(twin)));
        if double::incircle(at(edge), at(to), at(apex), at(opposite)).is_eq() {
            found.extend([corners[edge], corners[to]]);
        }
    }
    found
}

/// Lists the ends of the edges of the canonical mesh of the points in the buffer that the tie rule alone decided.
#[no_mangle]
pub extern "C" fn ties() -> f64 {
    told(mesh_of(points()).map(|mesh| {
        give(vec![tied_edges(&mesh)]);
        0.0
    }))
}
