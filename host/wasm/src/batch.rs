//! Triangulating a set of points.
#![allow(unsafe_code)] // names of functions that JavaScript calls

use std::borrow::Cow;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use incircle_geometry::lattice::Numbers;
use incircle_geometry::pages::has_room;
use incircle_geometry::{cpu, Duplicate, Mesh, PlanePoint};

use crate::border::{give, points, told, Points};

/// The most bytes a point that a job needs beyond its points, with the half-edges.
const BYTES_OF_A_JOB: usize = 400;
/// Coordinates of more bits take products of 128 bits. WebAssembly has none, so doubles, of which most need no exact
/// product, are up to twice as quick. The mesh is the same.
const MOST_BITS_OF_INTEGERS: u32 = 16;

/// Checks that there is memory for the mesh of these points.
pub fn check_room(points: &Points) -> Result<(), String> {
    let bytes = points.len().saturating_mul(BYTES_OF_A_JOB);
    if !has_room(bytes) {
        return Err(format!(
            "{} points need up to {bytes} bytes, and the module cannot get them: triangulate fewer points at a time",
            points.len()
        ));
    }
    Ok(())
}

/// The canonical mesh of points.
pub fn mesh_of(points: Points) -> Result<Mesh<[f64; 2]>, String> {
    check_room(&points)?;
    let found = {
        let numbers = match PlanePoint::numbers(&points).on_lattice() {
            (_, Some(lattice)) if lattice.bits > MOST_BITS_OF_INTEGERS => Numbers::Doubles(Cow::Borrowed(&points)),
            (numbers, _) => numbers,
        };
        cpu::connect(&numbers, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))
    };
    let found = found.map_err(|error| error.to_string())?;
    Ok(Mesh::new(points, found.triangles, found.hull, found.duplicates))
}

/// All triangles, one index after the other.
pub fn flat(triangles: Vec<[u32; 3]>) -> Vec<u32> {
    triangles.into_flattened()
}

/// The pairs of each duplicate and the point that it repeats, one index after the other.
pub fn pairs(duplicates: &[Duplicate]) -> Vec<u32> {
    duplicates.iter().flat_map(|one| [one.index, one.of]).collect()
}

/// Triangulates the points in the buffer. The lists are the triangles, the hull, the duplicates, and for the interface
/// of delaunator (`clockwise` is not 0) also the half-edges.
///
/// Delaunator turns triangles and hull counter-clockwise on a screen, where y grows downwards. That is clockwise here.
#[no_mangle]
pub extern "C" fn triangulate(clockwise: u32) -> f64 {
    told(mesh_of(points()).map(|mut mesh| {
        let duplicates = pairs(&mesh.duplicates);
        if clockwise == 0 {
            give(vec![flat(mesh.triangles), mesh.hull, duplicates]);
            return 0.0;
        }
        mesh.points = Vec::new();
        for [_, b, c] in &mut mesh.triangles {
            std::mem::swap(b, c);
        }
        if !mesh.is_collinear() {
            mesh.hull.reverse();
        }
        let halfedges = mesh.halfedges();
        give(vec![flat(mesh.triangles), mesh.hull, duplicates, halfedges]);
        0.0
    }))
}

/// Proves with the independent validator that the mesh of the points in the buffer is the canonical one.
#[no_mangle]
pub extern "C" fn verify() -> f64 {
    let verified = mesh_of(points()).and_then(|mesh| mesh.verify().map_err(|error| error.to_string()));
    told(verified.map(|()| 0.0))
}
