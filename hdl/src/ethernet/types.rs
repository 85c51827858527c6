//! The bundles of signals that pass between the blocks of the Ethernet port.

use rust_hdl_core::prelude::*;

pub use crate::serial::types::Byte;

/// Place of a byte in an Ethernet frame, from 0 for the first byte behind the preamble.
pub type Place = Bits<11>;

crate::packed! {
    /// The addresses of the device. The first byte on the wire is the highest one.
    pub struct Station {
        /// Ethernet address.
        pub mac: Bits<48>,
        /// IPv4 address.
        pub address: Bits<32>,
        /// UDP port.
        pub port: Bits<16>,
        /// IPv4 address at which all devices of the network listen, beside 255.255.255.255.
        pub broadcast: Bits<32>,
    }

    /// Whether entries of datagrams are on their way to the reader: as far as the reader's clock knows, and as far as
    /// that of the port does.
    pub struct OnTheWay {
        pub to_the_reader: bool,
        pub from_the_port: bool,
    }

    /// The meaning of a byte of a received frame, by its place. A `tests` field demands that the byte equals the first
    /// or second wanted byte, if a frame is to stay what the field names.
    pub struct Roles {
        /// Destination of the frame: the device's own Ethernet address, or all ones.
        pub tests_mac: bool,
        /// Highest byte of the sender's Ethernet address, whose lowest bit marks a group of stations.
        pub tests_group: bool,
        /// IPv4 without options and fragments: first wanted byte.
        pub tests_ip: bool,
        /// The byte with the flags of IPv4, of which "do not fragment" does not count.
        pub is_flags: bool,
        /// UDP: first wanted byte.
        pub tests_udp: bool,
        /// Echo request: first wanted byte, and second wanted byte.
        pub tests_echo: bool,
        pub tests_protocol: bool,
        /// ARP request: second wanted byte, and first wanted byte.
        pub tests_arp: bool,
        pub tests_target: bool,
        /// Destination in the header of IPv4: the device's own address, its broadcast address, or all ones.
        pub tests_address: bool,
        /// Ethernet address, IPv4 address or port of the sender.
        pub is_peer: bool,
        /// The length of the IPv4 datagram, high and low byte, and the byte behind it.
        pub length_high: bool,
        pub length_low: bool,
        pub length_ends: bool,
        /// The length of UDP, high and low byte.
        pub udp_high: bool,
        pub udp_low: bool,
        /// The byte lies behind the length of UDP.
        pub counts: bool,
        /// The byte belongs to the check sum of the header of IPv4; to the check sum of UDP.
        pub sums_header: bool,
        pub sums_udp: bool,
        /// The byte is the check sum of UDP, high or low.
        pub is_udp_sum: bool,
        /// The byte lies behind the header of UDP.
        pub is_payload: bool,
    }

    /// A byte of a received frame with what is known of its place.
    pub struct HeadByte {
        pub data: Byte,
        pub roles: Roles,
        /// The byte has an odd place, so it is the low byte of a word of a check sum.
        pub is_low: bool,
        /// The byte that a sound header has here, and a second one; see the roles.
        pub wanted: Byte,
        pub second: Byte,
        /// The byte of the broadcast address that belongs here.
        pub broadcast: Byte,
    }

    /// The kinds of frames that a frame may still be one of, by the bytes of it that have come.
    pub struct Kinds {
        /// A UDP datagram for the device, in IPv4 without options and not a fragment.
        pub is_udp: bool,
        /// An echo request to the device's own address.
        pub is_echo: bool,
        /// An ARP request for the device's address.
        pub is_arp: bool,
        /// The Ethernet frame or the datagram goes to all, not to the device alone.
        pub is_to_all: bool,
    }

    /// The checks of the numbers in the headers of a datagram; each is final once the bytes that it needs have come.
    pub struct DatagramState {
        /// The check sum of the header of IPv4 is right.
        pub header_is_right: bool,
        /// All bytes of the datagram have come.
        pub is_whole: bool,
        /// Length and check sum of UDP are right; a check sum of 0 means that there is none.
        pub udp_is_right: bool,
        /// The byte at hand, if it lies behind the header of UDP, belongs to the datagram.
        pub has_more: bool,
    }

    /// A row of the table of answers: where a byte of an answer comes from.
    pub struct AnswerRow {
        /// 0: the stored frame, 1: the device's addresses, 2: the literal `index`, 3: the check sum.
        pub source: Bits<2>,
        /// Index in the addresses of the device, or the literal, or 1 for the low byte of the check sum.
        pub index: Bits<4>,
        /// Added to the place, modulo 2^11, to find the byte in the stored frame.
        pub offset: Bits<11>,
    }

    /// A row of the table of datagrams: where a byte of the headers of a datagram comes from.
    pub struct HeaderRow {
        /// 0: the literal, 1: the device's addresses, 2: the datagram as it was given, 3 and 4: the length for
        /// IPv4, high and low, 5 and 6: the length for UDP, 7: the check sum.
        pub source: Bits<3>,
        /// The literal, or the index in the addresses, or 1 for the low byte of the check sum.
        pub literal: Byte,
    }
}
