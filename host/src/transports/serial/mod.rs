//! The transport to a board at a serial port: frames with check sums through a UART.
//!
//! Programs open a board with `Device::open("serial:/dev/ttyUSB0")`. This module is for those that list [`ports`], ask
//! which device is at a port ([`greet`]), or tell faults apart ([`PortFault`], [`SerialFault`]).
//!
//! The page `protocol/SERIAL.md` defines the link. [`SerialProtocol`](super::parts::SerialProtocol) is the host's half
//! of it without a port and without a clock: bytes and times go in, bytes and times come out, so that it runs in
//! virtual time as well as on a line. [`SerialTransport`] drives it over a port of the operating system.
//!
//! Memory is bounded by the command under way and its answer, each held once, and 16 frames. Nothing that a device
//! sends can make the host hold more.

mod address;
mod cobs;
mod codec;
mod connect;
mod fault;
mod low_latency;
mod port;
pub(super) mod protocol;
mod reader;
mod sender;
mod timing;
mod transport;

pub use address::Address;
pub(crate) use connect::LONGEST;
pub use fault::SerialFault;
pub use port::{ports, PortFault, PortInfo};
pub use protocol::DEFAULT_RATE;
pub use transport::{greet, SerialTransport};
