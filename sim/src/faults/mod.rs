//! Faults of a line, and devices that lie: what a host must survive, to be put between it and a board.
//!
//! [`FaultSpec`] says which, in the grammar of its [`FromStr`](std::str::FromStr); a [`FaultyLine`] for each direction does it. Everything follows from
//! the seed, the bytes and the times, so a run can be repeated. [`Proxy`] has both directions and what they have in common.

mod liar;
mod line;
mod proxy;
mod random;
mod spec;

pub use liar::Lie;
pub use line::FaultyLine;
pub use proxy::Proxy;
pub(crate) use random::Random;
pub use spec::{FaultSpec, SpecError};

/// A way along the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From the host to the device.
    ToDevice,
    /// From the device to the host.
    ToHost,
}
