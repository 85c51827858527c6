//! What the tests and the measurements of all crates share. The kit uses no other crate of the workspace, so every
//! crate may use the kit in its tests, and nothing here can share code with what is under test.
//!
//! - [`SplitMix64`]: the random generator. The same seed gives the same numbers on every machine.
//! - [`generate`]: point sets by name, those of `incircle generate`.
//! - [`delaunay`]: the canonical Delaunay triangulation by its definition, slow and plain.
//!
//! A point is a pair of coordinates, `[u32; 2]`, or a type that turns into one.
#![warn(missing_docs)]

mod oracle;
mod random;
mod sets;

pub use oracle::{conflicts, delaunay, orient2d};
pub use random::SplitMix64;
pub use sets::{generate, Distribution, GenerateError, UnknownName, BITS};
