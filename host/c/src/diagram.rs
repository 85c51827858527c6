//! Voronoi cells.
#![allow(unsafe_code)] // functions that C calls

use std::ffi::c_void;

use incircle::VoronoiLists;

use crate::border::{exclusive, give, shared};
use crate::grid::{laid, Border};
use crate::mesh::of_type;
use crate::status::{guarded, Failure, Outcome, INCIRCLE_INPUT};

/// The Voronoi diagram of a set of points. Several threads may read one at a time.
#[allow(non_camel_case_types)]
pub struct incircle_diagram {
    pub(crate) lists: VoronoiLists,
    largest_error: f64,
}

/// Makes the Voronoi diagram of `count` points, and the cells inside a clip of `corner_count` corners: none, two
/// opposite ones of a rectangle, or three or more of a simple polygon. `points` and `clip` have x and y of each, in the
/// type of numbers `number`, such as `INCIRCLE_F64`. `diagram` becomes a diagram that must be freed, or null if the
/// call fails.
///
/// Points and clip must lie on a lattice of up to 31 bits, as whole numbers of that size do. Most doubles do not:
/// `INCIRCLE_QUANTIZE` as `quantize` rounds them onto a grid, and `INCIRCLE_EXACT` refuses them. The status is
/// `INCIRCLE_INPUT` for these, for a coordinate that is NaN or infinite, and for a clip without area or that crosses
/// itself.
///
/// # Safety
/// `points` and `clip` point to as many pairs of numbers of that type, and `diagram` to a pointer that may be written.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_new(
    points: *const c_void,
    count: usize,
    clip: *const c_void,
    corner_count: usize,
    number: u32,
    quantize: u32,
    diagram: *mut *mut incircle_diagram,
) -> i32 {
    let border = Border::of_corners(clip, corner_count);
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { make((points, count), &border, number, quantize, diagram) })
}

/// As `incircle_diagram_new`, with a clip that may have holes. `clip` has the corners of all rings, one ring behind the
/// other: that around the polygon, then those of the holes, which lie side by side inside it. `ring_counts` says how
/// many corners each of the `ring_count` rings has, three or more. Rings may turn either way, and do not touch.
///
/// The status is also `INCIRCLE_INPUT` for a hole that lies outside the polygon or inside another hole, and for rings
/// that meet.
///
/// # Safety
/// `ring_counts` points to `ring_count` numbers, `clip` to as many pairs of numbers as they add up to; the rest is as
/// for `incircle_diagram_new`.
#[no_mangle]
#[allow(clippy::too_many_arguments)] // each list in C is a pointer and a count
pub unsafe extern "C" fn incircle_diagram_new_with_holes(
    points: *const c_void,
    count: usize,
    clip: *const c_void,
    ring_counts: *const usize,
    ring_count: usize,
    number: u32,
    quantize: u32,
    diagram: *mut *mut incircle_diagram,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        *unsafe { exclusive(diagram, "diagram") }? = std::ptr::null_mut();
        if ring_count == 0 {
            return Err(Failure::new(INCIRCLE_INPUT, "the clip has 0 rings: give one around the polygon, or more"));
        }
        // SAFETY: the same.
        unsafe { make((points, count), &Border::of_rings(clip, ring_counts, ring_count)?, number, quantize, diagram) }
    })
}

/// Makes a diagram for the caller.
///
/// # Safety
/// The pointers are as for `incircle_diagram_new`.
unsafe fn make(
    points: (*const c_void, usize),
    border: &Border,
    number: u32,
    quantize: u32,
    diagram: *mut *mut incircle_diagram,
) -> Outcome {
    // SAFETY: the caller promises the pointers.
    let out = unsafe { exclusive(diagram, "diagram") }?;
    *out = std::ptr::null_mut();
    // SAFETY: the same.
    let set = of_type!(number, P => unsafe { laid::<P>(points, border, 0, quantize) })?;
    let clip = (border.corner_count > 0).then(|| border.clip(&set)).transpose()?;
    let lists = VoronoiLists::of(&set, clip.as_ref())?;
    let largest_error = set.quantization().map_or(0.0, |quantization| quantization.largest_error);
    *out = Box::into_raw(Box::new(incircle_diagram { lists, largest_error }));
    Ok(())
}

/// The Voronoi vertices, all at different places: each coordinate is the double nearest to the exact one.
///
/// # Safety
/// `diagram` is one that is not freed; the rest is as for `incircle_mesh_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_vertices(
    diagram: *const incircle_diagram,
    buffer: *mut [f64; 2],
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(diagram, "diagram")?.lists.vertices, buffer, room, count) })
}

/// Where the edges of the cell of each point begin in `incircle_diagram_neighbors` and `incircle_diagram_corners`.
/// There is one item more than points: the end of the last. A duplicate has no edges.
///
/// # Safety
/// As for `incircle_diagram_vertices`.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_starts(
    diagram: *const incircle_diagram,
    buffer: *mut u64,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(diagram, "diagram")?.lists.starts, buffer, room, count) })
}

/// The point on the other side of each edge, counter-clockwise around each cell.
///
/// # Safety
/// As for `incircle_diagram_vertices`.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_neighbors(
    diagram: *const incircle_diagram,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(diagram, "diagram")?.lists.neighbors, buffer, room, count) })
}

/// The Voronoi vertex at which each edge begins; `INCIRCLE_EMPTY` if the edge comes from infinity.
///
/// # Safety
/// As for `incircle_diagram_vertices`.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_corners(
    diagram: *const incircle_diagram,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(diagram, "diagram")?.lists.corners, buffer, room, count) })
}

/// The points with the coordinates of an earlier one: the index of each, and the lowest index at its place.
///
/// # Safety
/// As for `incircle_diagram_vertices`.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_duplicates(
    diagram: *const incircle_diagram,
    buffer: *mut [u32; 2],
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(diagram, "diagram")?.lists.duplicates, buffer, room, count) })
}

/// The farthest that `INCIRCLE_QUANTIZE` moved a point along an axis; 0 if nothing was rounded.
///
/// # Safety
/// `diagram` is one that is not freed, and `error` may be written.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_largest_error(diagram: *const incircle_diagram, error: *mut f64) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        *unsafe { exclusive(error, "error") }? = unsafe { shared(diagram, "diagram") }?.largest_error;
        Ok(())
    })
}

/// Frees a diagram. A null pointer is allowed.
///
/// # Safety
/// `diagram` is null, or one that is not freed, and is not used again.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_free(diagram: *mut incircle_diagram) {
    if !diagram.is_null() {
        // SAFETY: it came from `incircle_diagram_new`, and nobody uses it any more.
        drop(unsafe { Box::from_raw(diagram) });
    }
}
