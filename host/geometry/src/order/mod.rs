//! Orders of insertion.
//!
//! The mesh does not depend on the order, but the time does. A point whose predecessor lies near is found in a few
//! steps. In random rounds, the expected number of triangles that do not last is O(n) for every set (Amenta, Choi, Rote
//! 2003), if the set was not made to defeat the hash that chooses the rounds. [`Order`] has the orders by name. The
//! file `hilbert` has the curve, `brio` cuts the curve into random rounds (the default order), and `z_curve`
//! serves the CPU triangulator.
//!
//! Indices are 32 bits wide: points past the 2^32nd are left out.

mod brio;
mod distinct;
mod hilbert;
mod keys;
mod kind;
mod random;
#[cfg(test)]
mod tests;
pub mod z_curve;

pub use brio::{brio_hilbert, rounds, rounds_of_share, Rounds};
pub use distinct::distinct;
pub use hilbert::{along_curve, hilbert, Hilbert};
pub use keys::{by_key, mix};
pub use kind::{Order, UnknownOrder};
pub use random::random;
