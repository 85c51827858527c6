//! Ways to a device.
//!
//! Sessions choose them by address, so few callers need this module: whoever writes a way of their own, as for a
//! simulator, implements [`Transport`] and hands it to [`Device::from_transport`](crate::Device::from_transport);
//! whoever tests or measures a link drives its [`parts`].

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

/// The parts of the ways to boards and cards, for whoever tests or measures a link: the serial protocol without a port
/// and without a clock, so that it runs in virtual time, and the files of a card, so that it can be one in memory.
/// Sessions need none of them.
pub mod parts {
    pub use super::pcie::files::{CardFiles, RegisterFile};
    pub use super::pcie::left_behind::calls_left_behind;
    pub use super::serial::protocol::{Params, SerialProtocol, Statistics};
}
