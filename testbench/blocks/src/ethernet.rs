//! The blocks of the Ethernet port, and the whole port.

use crate::exported::block;
use incircle_hdl::ethernet::{
    ByteCrc, ByteRoles, DatagramCheck, DatagramGate, DatagramQueue, DatagramSender, FrameMatch, HeaderBytes, MacIn,
    MacOut, MdioWriter, OnesSum, OwnBytes, Responder, RgmiiIn, RgmiiOut, SendChoice, UdpPort,
};

/// Registers of a PHY, each a number and a value, that a test awaits.
pub const PHY_WRITES: [(u8, u16); 3] = [(31, 0), (28, 0x8c00), (0, 0x9140)];

/// Name of the root module and Verilog of each block.
pub(crate) fn blocks() -> Vec<(String, String)> {
    vec![
        block(ByteCrc::default(), "ethernet_byte_crc"),
        block(OnesSum::default(), "ethernet_ones_sum"),
        block(OwnBytes::default(), "ethernet_own_bytes"),
        block(ByteRoles::default(), "ethernet_byte_roles"),
        block(FrameMatch::default(), "ethernet_frame_match"),
        block(DatagramCheck::default(), "ethernet_datagram_check"),
        block(DatagramGate::default(), "ethernet_datagram_gate"),
        block(DatagramQueue::new(), "ethernet_datagram_queue"),
        block(HeaderBytes::default(), "ethernet_header_bytes"),
        block(DatagramSender::default(), "ethernet_datagram_sender"),
        block(Responder::default(), "ethernet_responder"),
        block(SendChoice::default(), "ethernet_send_choice"),
        block(MacIn::default(), "ethernet_mac_in"),
        block(MacOut::default(), "ethernet_mac_out"),
        block(MdioWriter::new(5, &PHY_WRITES, 7), "ethernet_mdio_writer"),
        block(RgmiiIn::new(0), "ethernet_rgmii_in"),
        block(RgmiiOut::default(), "ethernet_rgmii_out"),
        block(UdpPort::new(), "ethernet_udp_port"),
    ]
}
