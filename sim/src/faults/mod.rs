//! Faults of a serial line, and devices that lie: everything a host must survive, to be put between the
//! host and a board.
//!
//! [`FaultSpec`] names the faults, in the grammar that its [`FromStr`](std::str::FromStr) reads, and a [`FaultyLine`]
//! for each direction applies them. The faults follow from the seed, the bytes and the times alone, so a run can be
//! repeated. [`Proxy`] holds both directions, the liar and the cable.

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

/// A direction of the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From the host to the device.
    ToDevice,
    /// From the device to the host.
    ToHost,
}
