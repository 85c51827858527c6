//! The driver of a board with the incircle core, for a microcontroller that reaches the board through a serial port.
//!
//! The caller gives points and two buffers, and gets the canonical mesh: the same triangles in the same order as from
//! every other back end of incircle. The crate needs neither the standard library nor an allocator, and no input makes
//! it panic. `docs/microcontroller.md` has sizes, times and an example on an emulated Cortex-M.
//!
//! ```no_run
//! use incircle_embedded::{Buffers, Clock, Device, Error};
//! # use embedded_io::{Read, ReadReady, Write};
//! # fn show(_: u16, _: u16, _: u16) {}
//! # fn main_of<P: Read + ReadReady + Write>(uart: P, clock: impl Clock) -> Result<(), Error<P::Error>> {
//! let mut device = Device::new(uart, clock);
//! let points = [[0, 0], [4, 0], [4, 4], [0, 4]];
//! let (mut order, mut records) = ([0; 4], [[0; 3]; 6]); // n places, 2 n - 2 records
//! let buffers = Buffers { order: &mut order, records: &mut records };
//! let mesh = device.triangulate(&points, buffers, 10_000)?;
//! for &[a, b, c] in mesh.triangles() {
//!     show(a, b, c);
//! }
//! # Ok(())
//! # }
//! ```
//!
//! The crate has no features, and needs Rust 1.95 or newer.
//!
//! # Order of insertion and duplicates
//! The driver sorts the caller's buffer of indices, never the points: along the Hilbert curve, with duplicates taken
//! out, three points that span a triangle first, and a run of the curve for each context of the core. The mesh does not
//! depend on this order, but the time of the core does.
//!
//! # Ports and clocks
//! A port implements `Read`, `ReadReady` and `Write` of [`embedded_io`], as the serial ports of most libraries for
//! microcontrollers do, at 115,200 bits per second, 8 data bits, no parity, one stop bit. [`Device::with_rate`] makes
//! jobs run at a higher rate. The driver looks for received bytes before every byte that it writes. Where a call of
//! `write` or `flush` may block for longer than a byte takes, the port must keep the bytes received meanwhile, for
//! example by an interrupt. Lost bytes cost time, never the mesh.
#![no_std]
#![warn(missing_docs)]

mod clock;
mod crc;
mod device;
mod error;
mod frame;
mod greeting;
mod line;
mod load;
mod mesh;
mod order;
mod rate;
mod session;
mod sort;

pub use clock::Clock;
pub use device::{Buffers, Device};
pub use error::{Error, Fault};
pub use mesh::Mesh;

/// A point: x and y, on the grid of the core.
pub type Point = [u16; 2];

/// Number of [`Buffers::records`] for this many points: `2 n - 2`.
///
/// With ghost triangles the mesh of `n` distinct points, three or more, has exactly this many records.
pub const fn records_needed(points: usize) -> usize {
    points.saturating_sub(1).saturating_mul(2)
}
