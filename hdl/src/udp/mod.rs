//! The UDP link: the blocks that carry the core's two streams of words in datagrams, with credits, check sums and
//! sessions. `protocol/UDP.md` describes the datagrams byte by byte. The blocks for Ethernet, IPv4 and UDP are in
//! [`ethernet`](crate::ethernet).
//!
//! ```text
//! in:  DatagramReader -> DatagramMatch -> DatagramJudge -> UdpSessionState; SenderStore; ReceiveFifo; DatagramDigest
//! out: DatagramReplies, AnswerParts -> FrameChoice -> DatagramParts -> DatagramHeader, DatagramBytes -> DatagramSums
//! ```
//! All of them run in the clock of the core, a byte a clock, but `ResetHandshake`, which resets both sides of a device.
//! `ReceiveFifo`, `FrameChoice`, `WordNarrower`, `CommandProgress` and `LineTimers` are those of the [serial
//! link](crate::serial).

mod answer_parts;
mod datagram_bytes;
mod datagram_digest;
mod datagram_header;
mod datagram_judge;
mod datagram_match;
mod datagram_parts;
mod datagram_reader;
mod datagram_replies;
mod datagram_sums;
mod reset_handshake;
mod sender_store;
pub mod types;
mod udp_device;
mod udp_link;
mod udp_parameters;
mod udp_receiver;
mod udp_session_state;
mod udp_transmitter;

pub use answer_parts::{AnswerPartState, AnswerParts};
pub use datagram_bytes::DatagramBytes;
pub use datagram_digest::DatagramDigest;
pub use datagram_header::DatagramHeader;
pub use datagram_judge::DatagramJudge;
pub use datagram_match::DatagramMatch;
pub use datagram_parts::DatagramParts;
pub use datagram_reader::DatagramReader;
pub use datagram_replies::DatagramReplies;
pub use datagram_sums::DatagramSums;
pub use reset_handshake::ResetHandshake;
pub use sender_store::SenderStore;
pub use udp_device::UdpDevice;
pub use udp_link::UdpLink;
pub use udp_parameters::{UdpError, UdpParameters};
pub use udp_receiver::UdpReceiver;
pub use udp_session_state::UdpSessionState;
pub use udp_transmitter::UdpTransmitter;
