//! Exact canonical Delaunay triangulation of integer points, in hardware or software.
//!
//! For a set of distinct grid points there is exactly one answer, and every device gives it: the fast engine in this
//! process, the software model, the simulated core, a board. Where four or more points lie on one empty circle, the
//! diagonal takes the lexicographically smallest of them.
//!
//! ```
//! let mesh = incircle::triangulate(&[(0, 0), (4, 0), (4, 4), (0, 4), (4, 0)])?;
//! assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
//! assert_eq!(mesh.hull, [0, 1, 2, 3]);
//! assert_eq!(mesh.duplicates[0].of, 1);
//! mesh.verify()?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! With a device that stays open, and choices for the job:
//!
//! ```
//! use incircle::{Device, Options, Order, Point, Solution};
//!
//! let points: Vec<Point> = (0..100).map(|k| Point::new(k * k % 83, k * 7 % 89)).collect();
//! let mut device = Device::open("model?coord-bits=12")?;
//! let mut session = device.session()?;
//! assert_eq!(session.identity().coord_bits, 12);
//! let options = Options::default().order(Order::Hilbert);
//! let Solution { mesh, report, .. } = session.triangulate_with(&points, &options)?;
//! assert_eq!(mesh.triangles.len(), 2 * report.distinct - 2 - mesh.hull.len());
//! assert_eq!(mesh, incircle::triangulate(&points)?);
//! # Ok::<(), incircle::Error>(())
//! ```
//!
//! Floating-point values pass [`quantize()`] first, which reports what it did.
#![warn(missing_docs)]

mod commands;
mod device;
mod error;
mod job;
mod limit;
pub mod quantize;
pub mod transports;

pub use device::{Device, DeviceAddress, Session};
pub use error::{DeviceFault, Error, ErrorKind, Shown, TransportError};
pub use incircle_geometry::verify::{self, verify, VerifyError, VerifySummary};
pub use incircle_geometry::{orient2d, predicate, Duplicate, Mesh, Order, Point, UnknownOrder, EMPTY, MAX_POINTS};
pub use incircle_protocol::{Config, Identity};
pub use job::{Counters, Latencies, Options, Progress, ProgressListener, Report, Solution, Stage};
pub use quantize::{quantize, Quantization, Quantize};
pub use transports::{pcie, serial, Transport};

/// Orders of insertion: the same set always gives the same order, whatever the order of the input. The orders by name
/// are [`Order`].
pub mod order {
    pub use crate::job::deal::{brio_hilbert_dealt, deal};
    pub use incircle_geometry::order::{brio_hilbert, hilbert, random, Order, Rounds, UnknownOrder};
}

/// Triangulates in this process with the fast engine: coordinates up to 31 bits, default [`Options`], all processors
/// for large sets.
///
/// # Errors
/// A coordinate of more than 31 bits, more than [`MAX_POINTS`] points, or a job that takes longer than
/// [`Options::default_timeout`].
pub fn triangulate<P: Into<Point> + Copy>(points: &(impl AsRef<[P]> + ?Sized)) -> Result<Mesh, Error> {
    Device::cpu(None).session()?.triangulate(points).map(|solution| solution.mesh)
}
