//! The Voronoi diagram of a set of points: exact corners, one cell for each distinct point, and cells clipped to a
//! polygon.
//!
//! Use a [`Voronoi`] if you ask which region lies nearest to each point. The diagram is made of the mesh of the set,
//! and [`Cells`] clips its cells to a [`Clip`]: a rectangle or any simple polygon, perhaps with holes.
//!
//! | you want | call | cost |
//! |---|---|---|
//! | the diagram of a mesh | [`Voronoi::of`] | O(n), about 1 µs a point |
//! | a cell, its neighbours and its corners | [`Voronoi::cell`], [`Voronoi::cells`] | O(1), no allocation |
//! | a corner exactly, or rounded once | [`Voronoi::vertex`], [`Corner::nearest`] | 20 to 60 ns |
//! | a cell inside a clip, with its area | [`Cells::cell`] | O(k + log m), more near the border of the clip |
//!
//! Here `k` is the number of edges of the cell, and `m` that of corners of the clip. Near the border a cell takes
//! O(k log m), and O(log m) more for each time that the line of an edge crosses the border.
//!
//! **Why the diagram is canonical.** A Voronoi vertex is the centre of an empty circle through three or more points.
//! Two triangles have the same centre only if they have the same empty circle, for the radius is the distance from the
//! centre to the nearest point. All triangles of one circle together cover the convex polygon of its points, so a chain
//! of triangles that share edges leads from each to each, and `incircle` is zero along it. Merging triangles along such
//! edges therefore makes one vertex of each centre, whichever diagonals the polygon has. The edges between them would
//! have length zero, and are left out. What is left are the edges of positive length, which depend on the points alone.
//! A bounded cell begins with the neighbour of the lowest index, and an unbounded one with the edge that comes from
//! infinity, so the lists of a cell depend on the points alone as well.
//!
//! **Why it is exact.** Coordinates are grid points below 2^31. Every corner is a fraction of integers
//! ([`Corner`]), and every decision is the sign of an integer of at most 130 bits, which is never rounded.
//!
//! ```
//! use core::num::NonZeroUsize;
//! use core::ops::ControlFlow;
//! use incircle_geometry::voronoi::{Clip, Cells, Corner, Voronoi};
//! use incircle_geometry::{cpu, Point};
//!
//! let points = [(0, 0), (4, 0), (4, 4), (0, 4), (2, 2)].map(Point::from).to_vec();
//! let mesh = cpu::triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?;
//! let voronoi = Voronoi::of(&mesh)?;
//! let middle = voronoi.cell(4).expect("point 4 is no duplicate");
//! assert_eq!(middle.neighbors(), [0, 1, 2, 3]);
//! let corners: Vec<[f64; 2]> = middle.vertices().map(|vertex| voronoi.vertex(vertex).nearest()).collect();
//! assert_eq!(corners, [[0.0, 2.0], [2.0, 0.0], [4.0, 2.0], [2.0, 4.0]]);
//!
//! let clip = Clip::rectangle(Point::new(0, 0), Point::new(4, 4))?;
//! let mut cells = Cells::new(&voronoi, &clip);
//! let areas: Vec<f64> = (0..5).map(|point| cells.cell(point).area()).collect();
//! assert_eq!(areas, [2.0, 2.0, 2.0, 2.0, 8.0]);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod border;
mod build;
mod cells;
mod clip;
mod clipped;
mod clipper;
mod corner;
mod cut;
mod diagram;
mod error;
mod place;
mod ring_list;
mod rings;
#[cfg(test)]
mod tests;
mod view;
mod wide;

pub use cells::Cells;
pub use clip::Clip;
pub use clipped::{ClippedCell, Piece, Ring};
pub(crate) use clipper::Clipper;
pub(crate) use corner::center_seen;
pub use corner::{nearest_quotient, Corner};
pub use diagram::{Cell, Edge, Voronoi};
pub use error::Error;
pub use view::Side;
