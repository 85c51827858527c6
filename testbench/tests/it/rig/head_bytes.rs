//! The meaning of each place of a received frame, as the RFCs lay out the headers, and the bytes of a frame as
//! `ByteRoles` gives them. Nothing here is shared with the blocks.

use std::ops::RangeInclusive;

use crate::rig::ethernet_frames::{Party, BROADCAST, DEVICE};
use crate::rig::stepper::bundles::{pack, Layout};
use incircle_testkit::SplitMix64;

/// First places of the header of IPv4, or of ARP, and of the header of UDP, or of ICMP. The type of the frame stands
/// before the first of them.
const TYPE: usize = 12;
const IPV4: usize = 14;
const UDP: usize = 34;
const PAYLOAD: usize = 42;
const END: usize = 2047;

/// Fields of a byte of a frame: `data`, `roles`, `is_low`, `wanted`, `second`, `broadcast`.
pub const HEAD_BYTE: Layout<6> = [8, 21, 1, 8, 8, 8];

/// The roles in the order of their bits, and the places that have each of them.
pub const ROLES: [(&str, &[RangeInclusive<usize>]); 21] = [
    ("tests_mac", &[0..=5]),
    ("tests_group", &[6..=6]),
    ("tests_ip", &[TYPE..=IPV4, IPV4 + 6..=IPV4 + 7]),
    ("is_flags", &[IPV4 + 6..=IPV4 + 6]),
    ("tests_udp", &[IPV4 + 9..=IPV4 + 9, UDP + 2..=UDP + 3]),
    ("tests_echo", &[UDP..=UDP + 1]),
    ("tests_protocol", &[IPV4 + 9..=IPV4 + 9]),
    ("tests_arp", &[TYPE..=TYPE + 9]),
    ("tests_target", &[IPV4 + 24..=IPV4 + 27]),
    ("tests_address", &[IPV4 + 16..=IPV4 + 19]),
    ("is_peer", &[6..=11, IPV4 + 12..=IPV4 + 15, UDP..=UDP + 1]),
    ("length_high", &[IPV4 + 2..=IPV4 + 2]),
    ("length_low", &[IPV4 + 3..=IPV4 + 3]),
    ("length_ends", &[IPV4 + 4..=IPV4 + 4]),
    ("udp_high", &[UDP + 4..=UDP + 4]),
    ("udp_low", &[UDP + 5..=UDP + 5]),
    ("counts", &[UDP + 6..=END]),
    ("sums_header", &[IPV4..=IPV4 + 19]),
    ("sums_udp", &[IPV4 + 2..=IPV4 + 3, IPV4 + 12..=END]),
    ("is_udp_sum", &[UDP + 6..=UDP + 7]),
    ("is_payload", &[PAYLOAD..=END]),
];

/// Addresses of a device, and the broadcast address of its network.
#[derive(Clone, Copy, Debug)]
pub struct Addresses {
    pub device: Party,
    pub broadcast: [u8; 4],
}

/// The addresses of the device under test.
pub const OURS: Addresses = Addresses { device: DEVICE, broadcast: BROADCAST };

impl Addresses {
    /// Addresses with every byte random.
    pub fn random(random: &mut SplitMix64) -> Self {
        let mut byte = || random.below(256) as u8;
        let mac = [(); 6].map(|()| byte());
        let address = [(); 4].map(|()| byte());
        let port = u16::from_be_bytes([byte(), byte()]);
        Self { device: Party { mac, address, port }, broadcast: [(); 4].map(|()| byte()) }
    }

    /// All bytes: Ethernet address, IPv4 address, port, broadcast address.
    pub fn bytes(&self) -> Vec<u8> {
        [self.device.bytes(), self.broadcast.to_vec()].concat()
    }

    /// Packs the addresses as a `Station`, in which each of them is a number whose highest byte comes first.
    pub fn packed(&self) -> u128 {
        let wide = |bytes: &[u8]| bytes.iter().fold(0u128, |value, byte| value << 8 | u128::from(*byte));
        let Party { mac, address, port } = self.device;
        wide(&mac) | wide(&address) << 48 | u128::from(port) << 80 | wide(&self.broadcast) << 96
    }

    /// The byte that UDP and echo requests for these addresses have at a place, or that an ARP request has as its
    /// target; then the one of ARP, or the protocol of an echo request; then the one of the broadcast address. Places
    /// at which no such byte is fixed have none.
    pub fn wanted(&self, place: usize) -> [Option<u8>; 3] {
        let Party { mac, address, port } = self.device;
        let fields: [&[(usize, &[u8])]; 3] = [
            &[
                (0, &mac),
                (TYPE, &[0x08, 0x00, 0x45]),
                (IPV4 + 6, &[0, 0]),
                (IPV4 + 9, &[17]),
                (IPV4 + 16, &address),
                (UDP, &[8, 0]),
                (UDP + 2, &port.to_be_bytes()),
                (IPV4 + 24, &address),
            ],
            &[(TYPE, &[0x08, 0x06, 0, 1, 8, 0, 6, 4, 0, 1]), (IPV4 + 9, &[1])],
            &[(IPV4 + 16, &self.broadcast)],
        ];
        fields.map(|fields| fields.iter().find_map(|(first, bytes)| bytes.get(place.checked_sub(*first)?).copied()))
    }

    /// Packs a byte of a frame as a `HeadByte`. Where no byte is wanted, the fields are random.
    pub fn head(&self, place: usize, data: u8, random: &mut SplitMix64) -> u128 {
        let [wanted, second, broadcast] =
            self.wanted(place).map(|byte| u64::from(byte.unwrap_or(random.below(256) as u8)));
        pack(HEAD_BYTE, [data.into(), roles(place), place as u64 % 2, wanted, second, broadcast])
    }
}

/// Roles of the byte at a place, as bits.
pub fn roles(place: usize) -> u64 {
    let has = |places: &[RangeInclusive<usize>]| places.iter().any(|range| range.contains(&place));
    ROLES.iter().enumerate().map(|(bit, (_, places))| u64::from(has(places)) << bit).sum()
}
