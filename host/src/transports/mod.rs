//! Ways to a device.

pub(crate) mod clock;
pub(crate) mod model;
pub mod pcie;
pub mod serial;
mod transport;

pub use clock::ClockTransport;
pub use model::ModelTransport;
pub use transport::{Pace, Transport, TransportError};
