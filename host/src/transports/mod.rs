//! Transports: the code that carries commands to a device and brings the answers.
//!
//! [`Device::open`](crate::Device::open) chooses the transport by the address, so most programs never need this module.
//! To connect a device in another way, as a simulator, implement [`Transport`] and hand it to
//! [`Device::from_transport`](crate::Device::from_transport). To test or measure a link, drive its [`parts`].

pub(crate) mod choices;
pub(crate) mod clock;
pub(crate) mod identity;
pub(crate) mod model;
pub mod pcie;
mod read_out;
mod round_trip;
mod sendable;
pub mod serial;
mod transport;
pub mod udp;
mod words;

pub use clock::ClockTransport;
pub use model::ModelTransport;
pub(crate) use transport::is_begun_as;
pub use transport::{
    receive_in_pieces, receive_next_in_pieces, AnswerHead, Capabilities, DeviceClocks, Pace, Transport,
};

/// Parts of the transports to boards and cards, for tests and measurements of a link. Sessions need none of them.
///
/// [`SerialProtocol`](parts::SerialProtocol) is the serial protocol without a port and without a clock, so that it can
/// run in virtual time; [`UdpProtocol`](parts::UdpProtocol) is that of a network. [`CardFiles`](parts::CardFiles) are
/// the files of a card, which may as well be in memory.
pub mod parts {
    pub use super::pcie::files::{CardFiles, RegisterFile};
    pub use super::pcie::left_behind::calls_left_behind;
    pub use super::serial::protocol::{Params, SerialProtocol, Statistics};
    pub use super::udp::loss::is_lost_on_the_way;
    pub use super::udp::protocol::{UdpParams, UdpProtocol, UdpStatistics};
}
