//! Ways to a device.

pub(crate) mod clock;
pub(crate) mod identity;
pub(crate) mod model;
pub mod pcie;
pub mod serial;
mod transport;

pub use clock::ClockTransport;
pub use model::ModelTransport;
pub use transport::{receive_in_pieces, AnswerHead, Capabilities, DeviceClocks, Pace, Transport};
