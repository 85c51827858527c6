//! The blocks of the UDP link, and the whole link.

use incircle_protocol::{UdpLinkConfig, SMALL};

use crate::exported::{block, named};
use incircle_hdl::export::udp_link;
use incircle_hdl::udp::{
    AnswerParts, DatagramBytes, DatagramDigest, DatagramHeader, DatagramJudge, DatagramMatch, DatagramParts,
    DatagramReader, DatagramReplies, DatagramSums, ResetHandshake, SenderStore, UdpSessionState,
};

/// A UDP link that is quick to simulate: a slow clock and the smallest FIFO. The silence is longer than any answer
/// takes.
pub const QUICK_UDP_LINK: UdpLinkConfig =
    UdpLinkConfig { clock_hz: 1_000_000, fifo_bytes: 2_048, silence_ms: 400, mac: [2, 0x69, 0x6e, 0x43, 0x75, 1] };

/// The UDP link of the exchange in `protocol/UDP.md`.
pub const UDP_PAGE_LINK: UdpLinkConfig =
    UdpLinkConfig { clock_hz: 120_000_000, fifo_bytes: 16_384, silence_ms: 2000, mac: [2, 0, 0, 0x69, 0x43, 1] };

/// Name of the root module and Verilog of each block.
pub(crate) fn blocks() -> Vec<(String, String)> {
    vec![
        block(AnswerParts::default(), "udp_answer_parts"),
        block(DatagramBytes::new(SMALL, UDP_PAGE_LINK), "udp_datagram_bytes"),
        block(DatagramDigest::default(), "udp_datagram_digest"),
        block(DatagramHeader::default(), "udp_datagram_header"),
        block(DatagramJudge::default(), "udp_datagram_judge"),
        block(DatagramMatch::default(), "udp_datagram_match"),
        block(DatagramParts::default(), "udp_datagram_parts"),
        block(DatagramReader::default(), "udp_datagram_reader"),
        block(DatagramReplies::default(), "udp_datagram_replies"),
        block(DatagramSums::default(), "udp_datagram_sums"),
        block(ResetHandshake::default(), "udp_reset_handshake"),
        block(SenderStore::default(), "udp_sender_store"),
        block(UdpSessionState::default(), "udp_session_state"),
        named("udp_link", udp_link(SMALL, QUICK_UDP_LINK, "udp_link")),
    ]
}
