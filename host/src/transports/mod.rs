//! Ways to a device.
//!
//! Sessions choose them by address, so few callers need this module: whoever writes a way of their own, as for a simulator, implements
//! [`Transport`] and hands it to [`Device::from_transport`](crate::Device::from_transport); whoever tests or measures a link drives its parts,
//! such as [`serial::SerialProtocol`] in virtual time or [`pcie::PcieTransport`] over files in memory.

pub(crate) mod choices;
pub(crate) mod clock;
pub(crate) mod identity;
pub(crate) mod model;
pub mod pcie;
pub mod serial;
mod transport;

pub use clock::ClockTransport;
pub use model::ModelTransport;
pub use transport::{receive_in_pieces, AnswerHead, Capabilities, DeviceClocks, Pace, Transport};
