//! Exact geometry of points in the plane: predicates, the canonical Delaunay triangulation in software, orders of
//! insertion, and a validator.
//!
//! Use this crate if you have points of integers or doubles and want their triangulation without a device, a link or a
//! file. The library `incircle` is built on it, adds devices and the rounding of values onto a grid, and re-exports
//! what its users need under the same paths.
//!
//! | you want | call | cost |
//! |---|---|---|
//! | the triangulation of a set | [`cpu::triangulate`] | O(n) on even sets, 0.2 to 0.3 µs a point on one thread |
//! | the same of many small sets | [`cpu::Triangulator`] | about 0.11 µs a point, without any allocation |
//! | the mesh of a set that is too large for one memory | [`tiles`] | about 0.2 µs a point on one thread |
//! | a mesh that can be asked and changed | [`Triangulation`] | 0.1 to 0.3 µs near the last place, some µs elsewhere |
//! | a mesh with edges that must be there | [`constraints::triangulate`] | O(n) beside the triangulation |
//! | the triangles beside a triangle | [`Mesh::neighbors`], [`Mesh::halfedges`] | O(n) for the whole mesh |
//! | the Voronoi cells of a set, whole or clipped | [`voronoi`] | O(n), less than 2 µs a point |
//! | points spread evenly over a region | [`lloyd::relax`] | about 1 µs a point and step |
//! | values between points, such as heights | [`interpolate`] | 0.1 to 2 µs a place |
//! | proof that a mesh is right | [`verify()`], [`Mesh::verify`] | O(n log n) |
//! | the side of a line that a point is on | [`orient2d`] | two multiplications |
//! | whether a point is inside a circle | [`incircle`] | ten multiplications |
//! | a good order of insertion | [`Order::order`] | O(n), about 20 ns a point |
//!
//! No point is rounded, and every predicate is exact. [`orient2d`] and [`incircle`] take grid points with coordinates
//! below 2^31, and the functions of the same names in [`double`] take all finite doubles. [`cpu::triangulate`] takes
//! points of any type that is a [`PlanePoint`].
//!
//! ```
//! use core::num::NonZeroUsize;
//! use core::ops::ControlFlow;
//! use incircle_geometry::{cpu, Point};
//!
//! let points = [(0, 0), (4, 0), (4, 4), (0, 4), (4, 0)].map(|(x, y)| Point::new(x, y)).to_vec();
//! let mesh = cpu::triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?;
//! assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
//! mesh.verify()?;
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! # Features
//! - `std`, on by default: threads, and large pages on Linux. Without this feature the crate needs only `alloc`, and
//!   the CPU triangulator works on one thread.
//! - `glam`: conversions between [`Point`] and `glam::UVec2`, and vectors of `glam` as points.
//! - `geo-types`: points and coordinates of `geo-types` 0.7 as points.
#![cfg_attr(not(any(feature = "std", test)), no_std)]
#![warn(missing_docs)]

extern crate alloc;

pub mod constraints;
pub mod cpu;
pub mod double;
mod edges;
pub mod interpolate;
pub mod lattice;
pub mod living;
pub mod lloyd;
mod mesh;
pub mod order;
pub mod pages;
mod plan;
mod plane_point;
mod point;
pub mod predicate;
mod site;
pub mod sort;
mod tie;
pub mod tiles;
pub mod verify;
pub mod voronoi;

pub use living::Triangulation;
pub use mesh::{Mesh, EMPTY};
pub use order::{Order, UnknownOrder};
pub use plane_point::PlanePoint;
pub use point::{Duplicate, Point, MAX_COORD_BITS, MAX_POINTS};
pub use predicate::{incircle, orient2d};
pub use verify::{verify, VerifyError, VerifySummary};
