//! Questions to the mesh that lives whose answers are lists: what is near, within, along a line, and around a point.
#![allow(unsafe_code)] // functions that C calls

use std::ffi::c_void;

use crate::border::{give, shared};
use crate::living::incircle_triangulation;
use crate::status::guarded;

/// The indices of the `number` places nearest to `place`, the nearest first; of places at the same distance, the one
/// with the smaller x, then y, comes first. Fewer if there are not so many; none if a coordinate is NaN or infinite. A
/// call costs O(k log k) for `k` places, beside the search for the first.
///
/// # Safety
/// `triangulation` is one that is not freed, and `place` points to two coordinates of its type; the rest is as for
/// `incircle_mesh_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_k_nearest(
    triangulation: *const incircle_triangulation,
    place: *const c_void,
    number: usize,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe {
        give(&shared(triangulation, "triangulation")?.0.k_nearest(place, number)?, buffer, room, count)
    })
}

/// The indices of the places at most `radius` from `center`, in rising order. No distance is rounded. None if the
/// radius is negative or NaN, or if a coordinate is NaN or infinite.
///
/// # Safety
/// As for `incircle_triangulation_k_nearest`.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_within_circle(
    triangulation: *const incircle_triangulation,
    center: *const c_void,
    radius: f64,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe {
        give(&shared(triangulation, "triangulation")?.0.within_circle(center, radius)?, buffer, room, count)
    })
}

/// The indices of the places in a rectangle or on its border, in rising order. Any two opposite corners name the
/// rectangle. None if a coordinate is NaN or infinite.
///
/// # Safety
/// As for `incircle_triangulation_k_nearest`; each corner is two coordinates.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_within_rectangle(
    triangulation: *const incircle_triangulation,
    corner: *const c_void,
    opposite: *const c_void,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe {
        give(&shared(triangulation, "triangulation")?.0.within_rectangle(corner, opposite)?, buffer, room, count)
    })
}

/// The triangles whose inside the straight line between two places crosses, in that order; three indices each,
/// counter-clockwise, the smallest first. A line along an edge crosses neither triangle beside it. None if a coordinate
/// is NaN or infinite.
///
/// # Safety
/// As for `incircle_triangulation_k_nearest`; both ends are two coordinates.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_segment(
    triangulation: *const incircle_triangulation,
    from: *const c_void,
    to: *const c_void,
    buffer: *mut [u32; 3],
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(triangulation, "triangulation")?.0.segment(from, to)?, buffer, room, count) })
}

/// The triangles around the place of a point, counter-clockwise, each with the lowest index of that place first.
///
/// # Safety
/// `triangulation` is one that is not freed; the rest is as for `incircle_mesh_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_star(
    triangulation: *const incircle_triangulation,
    index: u32,
    buffer: *mut [u32; 3],
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(triangulation, "triangulation")?.0.star(index)?, buffer, room, count) })
}
