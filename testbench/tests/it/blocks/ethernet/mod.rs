//! Tests of the blocks in `hdl/src/ethernet`.

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
mod udp_port;
