//! Ethernet frames put together and taken apart by plain code, which shares nothing with the blocks: a packet is a list
//! of bytes, and every field stands at its place in the RFC.

use incircle_testkit::SplitMix64;

/// Addresses of a device on the network.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Party {
    pub mac: [u8; 6],
    pub address: [u8; 4],
    pub port: u16,
}

/// The device under test, and the broadcast address of its network.
pub const DEVICE: Party = Party { mac: [0x02, 0x69, 0x6e, 0x43, 0x75, 0x01], address: [10, 0, 7, 2], port: 26_947 };
pub const BROADCAST: [u8; 4] = [10, 0, 7, 255];
/// The Ethernet address of all.
pub const ALL: [u8; 6] = [0xff; 6];

impl Party {
    /// A host at random.
    pub fn random(random: &mut SplitMix64) -> Self {
        let mut byte = || random.below(256) as u8;
        Self {
            mac: [byte() & 0xfe, byte(), byte(), byte(), byte(), byte()],
            address: [10, 0, 7, byte()],
            port: u16::from(byte()) << 8 | u16::from(byte()),
        }
    }

    /// The addresses as they stand before the payload of a datagram: 12 bytes.
    pub fn bytes(&self) -> Vec<u8> {
        [&self.mac[..], &self.address, &self.port.to_be_bytes()].concat()
    }
}

/// The check sum of a frame, bit by bit.
pub fn frame_sum(bytes: &[u8]) -> [u8; 4] {
    let mut state = u32::MAX;
    for bit in bytes.iter().flat_map(|byte| (0..8).map(move |place| byte >> place & 1)) {
        let feeds_back = state & 1 != u32::from(bit);
        state = state >> 1 ^ if feeds_back { 0xedb8_8320 } else { 0 };
    }
    (!state).to_le_bytes()
}

/// Pads a frame to 60 bytes and appends its check sum.
pub fn sealed(mut frame: Vec<u8>) -> Vec<u8> {
    frame.resize(frame.len().max(60), 0);
    let sum = frame_sum(&frame);
    frame.extend(sum);
    frame
}

/// The check sum of the internet: the complement of the sum of all words modulo 65,535.
pub fn internet_sum(bytes: &[u8]) -> u16 {
    let words = bytes.chunks(2).map(|word| u64::from(word[0]) << 8 | u64::from(*word.get(1).unwrap_or(&0)));
    let sum: u64 = words.sum();
    !match (sum, sum % 65_535) {
        (0, _) => 0,
        (_, 0) => 65_535,
        (_, rest) => rest as u16,
    }
}

/// An IPv4 packet without options in an Ethernet frame, without padding and check sum.
pub fn ipv4(from: Party, to: ([u8; 6], [u8; 4]), protocol: u8, body: &[u8]) -> Vec<u8> {
    let mut header = vec![0x45, 0, 0, 0, 0, 0, 0x40, 0, 64, protocol, 0, 0];
    header.extend(from.address);
    header.extend(to.1);
    header[2..4].copy_from_slice(&(20 + body.len() as u16).to_be_bytes());
    let sum = internet_sum(&header);
    header[10..12].copy_from_slice(&sum.to_be_bytes());
    [&to.0[..], &from.mac, &[8, 0], &header, body].concat()
}

/// A UDP datagram with its check sum, or with none.
pub fn udp(from: Party, to: ([u8; 6], [u8; 4], u16), payload: &[u8], has_sum: bool) -> Vec<u8> {
    let length = 8 + payload.len() as u16;
    let mut body = [from.port, to.2, length, 0].map(u16::to_be_bytes).concat();
    body.extend(payload);
    if has_sum {
        let covered = [&from.address[..], &to.1, &[0, 17], &length.to_be_bytes(), &body].concat();
        let sum = internet_sum(&covered);
        body[6..8].copy_from_slice(&(if sum == 0 { 0xffff } else { sum }).to_be_bytes());
    }
    ipv4(from, (to.0, to.1), 17, &body)
}

/// An echo request.
pub fn echo(from: Party, to: ([u8; 6], [u8; 4]), payload: &[u8]) -> Vec<u8> {
    let mut body = vec![8, 0, 0, 0, 0x12, 0x34, 0, 7];
    body.extend(payload);
    let sum = internet_sum(&body);
    body[2..4].copy_from_slice(&sum.to_be_bytes());
    ipv4(from, to, 1, &body)
}

/// An ARP request for an address.
pub fn arp(from: Party, to: [u8; 6], asked: [u8; 4]) -> Vec<u8> {
    [&to[..], &from.mac, &[8, 6, 0, 1, 8, 0, 6, 4, 0, 1], &from.mac, &from.address, &[0; 6], &asked].concat()
}

/// What the device must do with a frame.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reaction {
    /// Sender and payload of a datagram, and whether the datagram came to all devices.
    pub datagram: Option<(Vec<u8>, bool)>,
    /// The frame that the device answers.
    pub answer: Option<Vec<u8>>,
}

/// What the device must do with the bytes of a frame, its check sum included.
pub fn reaction(frame: &[u8]) -> Reaction {
    let none = Reaction::default();
    if !(64..=1518).contains(&frame.len()) {
        return none;
    }
    let (body, sum) = frame.split_at(frame.len() - 4);
    let (to, from) = (&body[..6], &body[6..12]);
    let is_own = to == DEVICE.mac;
    if frame_sum(body) != sum || !(is_own || to == ALL) || from[0] & 1 == 1 {
        return none;
    }
    match [body[12], body[13]] {
        [8, 6] => Reaction { answer: arp_answer(body), ..none },
        [8, 0] => ipv4_reaction(body, is_own),
        _ => none,
    }
}

fn arp_answer(body: &[u8]) -> Option<Vec<u8>> {
    if body[14..22] != [0, 1, 8, 0, 6, 4, 0, 1] || body[38..42] != DEVICE.address {
        return None;
    }
    let mut answer = body.to_vec();
    answer[..6].copy_from_slice(&body[6..12]);
    answer[6..12].copy_from_slice(&DEVICE.mac);
    answer[21] = 2;
    answer[22..28].copy_from_slice(&DEVICE.mac);
    answer[28..32].copy_from_slice(&DEVICE.address);
    answer[32..42].copy_from_slice(&body[22..32]);
    Some(sealed(answer))
}

fn ipv4_reaction(body: &[u8], is_own: bool) -> Reaction {
    let none = Reaction::default();
    let length = usize::from(body[16]) << 8 | usize::from(body[17]);
    let is_plain = body[14] == 0x45 && body[20] & 0xbf == 0 && body[21] == 0;
    if !is_plain || internet_sum(&body[14..34]) != 0 || length < 28 || 14 + length > body.len() {
        return none;
    }
    let target = &body[30..34];
    let packet = &body[34..14 + length];
    let is_to_one = is_own && target == DEVICE.address;
    if body[23] == 1 && packet[..2] == [8, 0] && is_to_one {
        let mut answer = body.to_vec();
        answer[..6].copy_from_slice(&body[6..12]);
        answer[6..12].copy_from_slice(&DEVICE.mac);
        answer[26..30].copy_from_slice(&body[30..34]);
        answer[30..34].copy_from_slice(&body[26..30]);
        answer[34] = 0;
        let sum = u32::from(packet[2]) << 8 | u32::from(packet[3]);
        let sum = (sum + 0x800) % 65_535;
        answer[36..38].copy_from_slice(&(if sum == 0 { 65_535 } else { sum as u16 }).to_be_bytes());
        return Reaction { answer: Some(sealed(answer)), ..none };
    }
    let is_for_us = target == DEVICE.address || target == BROADCAST || target == [255; 4];
    let says = |place: usize| u16::from(packet[place]) << 8 | u16::from(packet[place + 1]);
    if body[23] != 17 || !is_for_us || says(2) != DEVICE.port || usize::from(says(4)) != packet.len() {
        return none;
    }
    let covered = [&body[26..34], &[0, 17], &packet[4..6], packet].concat();
    if says(6) != 0 && internet_sum(&covered) != 0 {
        return none;
    }
    let sender = [&body[6..12], &body[26..30], &packet[..2], &packet[8..]].concat();
    Reaction { datagram: Some((sender, !is_to_one)), ..none }
}
