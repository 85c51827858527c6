//! The Ethernet port: the blocks that carry datagrams of UDP between a PHY of gigabit Ethernet and the core's clock.
//!
//! ```text
//! in:  MacIn -> ByteRoles -> FrameMatch, DatagramCheck -> DatagramGate
//! out: DatagramQueue -> DatagramSender, and Responder for ARP and echo -> SendChoice -> MacOut
//! pins: RgmiiIn and RgmiiOut; registers of the PHY: MdioWriter
//! ```
//! All but the two crossings runs in the clock of the PHY, 125 MHz, a byte a clock.

mod byte_crc;
mod byte_roles;
mod datagram_check;
mod datagram_gate;
mod datagram_queue;
mod datagram_sender;
mod frame_match;
mod header_bytes;
mod mac_in;
mod mac_out;
mod mdio_writer;
mod ones_sum;
mod own_bytes;
mod responder;
mod rgmii_in;
mod rgmii_out;
mod send_choice;
pub mod types;
mod udp_port;

pub use byte_crc::ByteCrc;
pub use byte_roles::{ByteRoles, RoleRow};
pub use datagram_check::DatagramCheck;
pub use datagram_gate::DatagramGate;
pub use datagram_queue::DatagramQueue;
pub use datagram_sender::{DatagramPhase, DatagramSender};
pub use frame_match::FrameMatch;
pub use header_bytes::HeaderBytes;
pub use mac_in::{FrameState, MacIn};
pub use mac_out::{MacOut, SendPart};
pub use mdio_writer::MdioWriter;
pub use ones_sum::OnesSum;
pub use own_bytes::OwnBytes;
pub use responder::Responder;
pub use rgmii_in::RgmiiIn;
pub use rgmii_out::RgmiiOut;
pub use send_choice::SendChoice;
pub use udp_port::UdpPort;
