//! The form in which writers get cells.

use incircle::voronoi::{Clip, Voronoi};

use super::frame::Frame;

/// The cells that are written, and how their corners become coordinates.
#[derive(Clone, Copy)]
pub struct CellView<'a> {
    /// The diagram of the points.
    pub voronoi: &'a Voronoi<'a>,
    /// The polygon that the cells are clipped to; only JSON takes cells without one.
    pub clip: Option<&'a Clip>,
    /// From the grid to the coordinates of the file.
    pub frame: &'a Frame,
}
