//! The serial link: frames with check sums through a UART, nothing lost, nothing believed.
//!
//! `protocol/SERIAL.md` says what host and device tell each other. [`SerialProtocol`](super::parts::SerialProtocol) is
//! the host's half of it without a port and without a clock: bytes and times go in, bytes and times come out, so it
//! runs in virtual time as well as on a line. [`SerialTransport`] drives it over a port of the operating system, and is
//! what `Device::open("serial:/dev/ttyUSB0")` makes. [`greet`] asks who is at a port, and [`ports`] lists them.
//!
//! What it holds is bounded by the command under way and its answer, each once, and 16 frames; what a device sends
//! cannot make it hold more.

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
