//! Looking for memory before a job. The library takes memory without a way to refuse, and running out of it would end
//! the program of the caller.

use incircle_geometry::pages::has_room;
use pyo3::prelude::*;

use crate::error::exception;

/// The most bytes a point that a triangulation needs beyond its points.
pub const BYTES_OF_A_JOB: usize = 200;
/// The most bytes a triangle that its half-edges or neighbours need.
pub const BYTES_OF_A_TRIANGLE: usize = 120;
/// The most bytes a point that a mesh that lives needs while it is made, moved or listed.
pub const BYTES_OF_A_LIVING_POINT: usize = 400;
/// The most bytes a point that the longest list of a mesh that lives needs while it grows.
pub const BYTES_OF_A_LISTED_POINT: usize = 100;
/// The most bytes a place that the search for the nearest ones needs.
pub const BYTES_OF_A_FOUND_PLACE: usize = 200;
/// The most bytes a point or constraint that a constrained mesh needs.
pub const BYTES_OF_A_CONSTRAINT: usize = 600;
/// The most bytes a point that cells, a relaxation or a surface need.
pub const BYTES_OF_A_CELL: usize = 700;
/// The bytes that a pixel of a density takes, with the copy that it is made of.
pub const BYTES_OF_A_PIXEL: usize = 20;
/// The most bytes a place that an answer needs.
pub const BYTES_OF_A_PLACE: usize = 60;

/// Raises `OutOfMemoryError` if there is no memory for `count` items of `bytes_of_one` bytes.
pub fn look_for_memory(py: Python<'_>, count: usize, bytes_of_one: usize) -> PyResult<()> {
    let bytes = count.saturating_mul(bytes_of_one);
    if has_room(bytes) {
        return Ok(());
    }
    let sentence = format!("there is no memory for {bytes} bytes: use fewer points, or free some");
    Err(exception(py, "OutOfMemoryError", &sentence))
}
