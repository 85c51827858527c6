//! Tests of the blocks in `hdl/src/udp`.

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
mod udp_link;
mod udp_session_state;
