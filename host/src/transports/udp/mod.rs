//! The transport to a device on a network: one frame in each datagram of UDP.
//!
//! Programs open a device with `Device::open("udp:192.168.1.50")`. This module is for those that look for devices on
//! the network ([`discover`]) or tell faults apart ([`UdpFault`]).
//!
//! The page `protocol/UDP.md` defines the link. [`UdpProtocol`](super::parts::UdpProtocol) is the host's half of it
//! without a socket and without a clock, so that it runs in virtual time as well as on a network. [`UdpTransport`]
//! drives it over a socket of the operating system.
//!
//! Commands of a job are kept until all its answers are there, since a device keeps no answers: if one is lost and the
//! next job was sent ahead, the job is sent again. Memory is bounded by the jobs under way and their answers, each held
//! once, and the device's FIFO.

mod address;
mod awaited;
mod codec;
mod discover;
mod fault;
mod greeting;
pub(super) mod loss;
pub(super) mod protocol;
mod readable;
mod reader;
mod sender;
mod transport;
mod unit;

pub use address::UdpAddress;
pub use discover::{discover, Discovered};
pub use fault::UdpFault;
pub use transport::UdpTransport;
