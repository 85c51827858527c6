//! The cells of a diagram inside its clip.
#![allow(unsafe_code)] // functions that C calls

use incircle::CellLists;

use crate::border::{give, shared};
use crate::diagram::incircle_diagram;
use crate::status::{guarded, Failure, Outcome, INCIRCLE_CHOICE};

/// A list of the cells inside the clip.
fn of_cells<T>(diagram: &incircle_diagram, list: impl Fn(&CellLists) -> &[T]) -> Outcome<&[T]> {
    match &diagram.lists.cells {
        Some(cells) => Ok(list(cells)),
        None => Err(Failure::new(INCIRCLE_CHOICE, "the diagram has no clip: give incircle_diagram_new one")),
    }
}

/// The corners of the rings of all cells inside the clip, one ring behind the other: counter-clockwise around a piece,
/// clockwise around a hole in it. A cell has no piece, one, or several if the clip is not convex, and only a clip with
/// holes has pieces with holes. The status is `INCIRCLE_CHOICE` if the diagram has no clip.
///
/// # Safety
/// As for `incircle_diagram_vertices`.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_cell_corners(
    diagram: *const incircle_diagram,
    buffer: *mut [f64; 2],
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(of_cells(shared(diagram, "diagram")?, |cells| &cells.corners)?, buffer, room, count) })
}

/// Where each ring begins in `incircle_diagram_cell_corners`. There is one item more than rings: the end of the last.
///
/// # Safety
/// As for `incircle_diagram_vertices`.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_piece_starts(
    diagram: *const incircle_diagram,
    buffer: *mut u64,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(of_cells(shared(diagram, "diagram")?, |cells| &cells.starts)?, buffer, room, count) })
}

/// The point to which each ring belongs, in rising order.
///
/// # Safety
/// As for `incircle_diagram_vertices`.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_piece_points(
    diagram: *const incircle_diagram,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(of_cells(shared(diagram, "diagram")?, |cells| &cells.points)?, buffer, room, count) })
}

/// Whether each ring bounds a hole of the last piece before it: 1, or 0 for the ring around a piece.
///
/// # Safety
/// As for `incircle_diagram_vertices`.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_ring_is_hole(
    diagram: *const incircle_diagram,
    buffer: *mut u8,
    room: usize,
    count: *mut usize,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        let flags = of_cells(unsafe { shared(diagram, "diagram") }?, |cells| &cells.is_hole)?;
        let flags: Vec<u8> = flags.iter().map(|&is_hole| is_hole.into()).collect();
        // SAFETY: the same.
        unsafe { give(&flags, buffer, room, count) }
    })
}

/// The area of the cell of each point inside the clip; 0 for a duplicate.
///
/// # Safety
/// As for `incircle_diagram_vertices`.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_areas(
    diagram: *const incircle_diagram,
    buffer: *mut f64,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(of_cells(shared(diagram, "diagram")?, |cells| &cells.areas)?, buffer, room, count) })
}

/// The points whose cells share an edge inside the clip, one cell behind the other, each in rising order.
///
/// # Safety
/// As for `incircle_diagram_vertices`.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_inside(
    diagram: *const incircle_diagram,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(of_cells(shared(diagram, "diagram")?, |cells| &cells.neighbors)?, buffer, room, count) })
}

/// Where the items of each point begin in `incircle_diagram_inside`. There is one item more than points: the end of the
/// last.
///
/// # Safety
/// As for `incircle_diagram_vertices`.
#[no_mangle]
pub unsafe extern "C" fn incircle_diagram_inside_starts(
    diagram: *const incircle_diagram,
    buffer: *mut u64,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe {
        give(of_cells(shared(diagram, "diagram")?, |cells| &cells.neighbor_starts)?, buffer, room, count)
    })
}
