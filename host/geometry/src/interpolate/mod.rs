//! Values between points: linear on the triangles, or by natural neighbours.
//!
//! Use a [`Surface`] if the points of a set have a value each, such as a height, and you want values elsewhere.
//!
//! | method | value at a place | cost |
//! |---|---|---|
//! | [`Method::Linear`] | that of the plane through the corners of the triangle around the place | 0.1 to 0.2 µs |
//! | [`Method::Laplace`] | mean of the natural neighbours, weighted by edge length over distance | 0.2 to 0.5 µs |
//! | [`Method::Sibson`] | mean of the natural neighbours, weighted by areas of a new cell | 0.2 to 0.5 µs |
//!
//! The natural neighbours of a place are the neighbours that it would have as a further point of the set. All three
//! methods give the values of the set at its points, and linear functions between them (to rounding, see [`Method`]).
//!
//! **What is exact.** Places are found, and natural neighbours are chosen, by predicates that are never rounded, so a
//! place is in the triangle that contains it, and walks end. The values themselves are worked out in doubles by a fixed
//! sequence of operations, which depends on the place alone: neither on the number of threads, nor on the order of the
//! places. On an edge the value is that of the line between its two ends, whichever triangle found it. If
//! coordinates are below 1e75, a value between finite values is finite: if a sum leaves the range of doubles, the work
//! is done again with values that are divided by a power of two.
//!
//! ```
//! use incircle_geometry::interpolate::{Method, Outside, Surface};
//!
//! let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
//! let surface = Surface::new(&points, &[[0, 1, 2], [0, 2, 3]], &[0.0, 4.0, 8.0, 4.0])?;
//! assert_eq!(surface.value(Method::Linear, Outside::Nan, [3.0, 1.0]), 4.0);
//! assert!((surface.value(Method::Sibson, Outside::Nan, [3.0, 0.5]) - 3.5).abs() < 1e-12);
//! assert!(surface.value(Method::Linear, Outside::Nan, [9.0, 9.0]).is_nan());
//! assert_eq!(surface.value(Method::Linear, Outside::Nearest, [9.0, 9.0]), 8.0);
//! # Ok::<(), incircle_geometry::interpolate::Error>(())
//! ```

mod buckets;
mod contours;
mod error;
mod large;
mod linear;
mod locate;
mod natural;
mod nearest;
mod record;
mod surface;
#[cfg(test)]
mod tests;

pub use contours::{Contour, Crossing};
pub use error::Error;
pub use linear::{edge_value, plane_value};
pub use surface::{Method, Outside, Surface};
