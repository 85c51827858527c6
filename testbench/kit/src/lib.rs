//! Everything that the tests and the measurements of all crates share. The kit uses no other crate of the workspace, so
//! every crate may use the kit in its tests, and nothing here can share code with the tested code.
//!
//! - [`SplitMix64`]: the random generator. The same seed gives the same numbers on every machine.
//! - [`generate`]: point sets by name, those of `incircle generate`.
//! - [`delaunay`]: the canonical Delaunay triangulation by its definition, slow and plain.
//! - [`delaunay_of_doubles`]: the same of points of doubles, in integers of any size.
//! - [`clipped_cell`], [`cell_neighbors`], [`twice_area_inside`]: Voronoi cells by their definition, in fractions.
//! - [`disc_is_between`]: whether the circumscribed disc of a triangle lies between lines, in the same integers.
//! - [`words`] and [`Batch`]: point sets as a device takes them, with [`Random32`], whose seeds tests know.
//! - [`canonical`]: the check of a mesh from a device, and its form without ids.
//! - [`exchange_steps`] and [`exchange_datagrams`]: the exchanges that the pages of the serial and the UDP link show.
//! - [`Network`]: one direction of a network with faults, in virtual or real time.
//!
//! A point is a pair of coordinates, `[u32; 2]`, or a type that turns into one.
#![warn(missing_docs)]

mod batch;
mod canonical;
mod compiled;
mod exchange;
mod network;
mod oracle;
mod oracle_of_cells;
mod oracle_of_doubles;
mod random;
mod random32;
mod sets;
pub mod words;

pub use batch::Batch;
pub use canonical::{canonical, Canonical, StoredRecord};
pub use compiled::Compiled;
pub use exchange::{exchange_datagrams, exchange_steps, Datagram};
pub use network::{Network, NetworkFaults};
pub use oracle::{conflicts, delaunay, orient2d};
pub use oracle_of_cells::{cell_neighbors, clipped_cell, twice_area_inside, Area, Fraction};
pub use oracle_of_doubles::{
    delaunay_of_doubles, disc_is_between, hull_of_doubles, incircle_of_doubles, orient2d_of_doubles,
};
pub use random::SplitMix64;
pub use random32::Random32;
pub use sets::{generate, stream, Distribution, GenerateError, SetPoints, UnknownName, BITS};
