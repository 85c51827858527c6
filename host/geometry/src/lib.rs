//! Exact geometry of integer points: predicates, the canonical Delaunay triangulation on a processor, orders of
//! insertion, and a validator.
//!
//! For programs that want the triangulation without a device, a link or a file. The library `incircle` is built on this
//! crate and re-exports what its users need under the same paths.
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
//! - `std`, on by default: threads, and large pages on Linux. Without it the crate needs `alloc` alone, and the engine
//!   works on one thread.
//! - `glam`: conversions between [`Point`] and `glam::UVec2`.
#![cfg_attr(not(any(feature = "std", test)), no_std)]
#![warn(missing_docs)]

extern crate alloc;

pub mod cpu;
pub mod double;
mod edges;
mod mesh;
pub mod order;
pub mod pages;
mod point;
pub mod predicate;
pub mod sort;
pub mod verify;

pub use mesh::{Mesh, EMPTY};
pub use order::{Order, UnknownOrder};
pub use point::{Duplicate, Point, MAX_COORD_BITS, MAX_POINTS};
pub use predicate::{incircle, orient2d};
pub use verify::{verify, VerifyError, VerifySummary};
