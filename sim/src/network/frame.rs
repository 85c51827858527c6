//! The Ethernet frames around the datagrams of hosts, put together and taken apart.

use std::net::{Ipv4Addr, SocketAddrV4};

use incircle_model::serial::Crc32;

/// Bytes of the headers of Ethernet, IPv4 and UDP.
const HEADERS: usize = 14 + 20 + 8;
/// Shortest frame without its check sum.
const SHORTEST: usize = 60;
/// The bytes that go before a frame.
const PREAMBLE: [u8; 8] = [0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0xd5];

/// Ethernet address of the simulated host of this IPv4 address.
fn mac_of(host: Ipv4Addr) -> [u8; 6] {
    let [a, b, c, d] = host.octets();
    [0x02, 0x68, a, b, c, d]
}

/// The bytes of a frame on the cable, from the preamble to the check sum, that carries a datagram. UDP has no check sum
/// in it.
pub(super) fn framed(from: SocketAddrV4, to: SocketAddrV4, to_mac: [u8; 6], datagram: &[u8]) -> Vec<u8> {
    let length = |bytes: usize| (bytes as u16).to_be_bytes();
    let mut ip = [0x45, 0, 0, 0, 0, 0, 0x40, 0, 64, 17, 0, 0].to_vec();
    ip.extend(from.ip().octets());
    ip.extend(to.ip().octets());
    ip[2..4].copy_from_slice(&length(28 + datagram.len()));
    let sum = internet_sum(&ip);
    ip[10..12].copy_from_slice(&sum.to_be_bytes());
    let mut frame = [&to_mac[..], &mac_of(*from.ip()), &[8, 0], &ip].concat();
    for field in [from.port().to_be_bytes(), to.port().to_be_bytes(), length(8 + datagram.len()), [0, 0]] {
        frame.extend(field);
    }
    frame.extend(datagram);
    on_cable(&frame)
}

/// The bytes of a frame on the cable, from the preamble to the check sum. Short frames are padded.
pub(super) fn on_cable(frame: &[u8]) -> Vec<u8> {
    let mut frame = frame.to_vec();
    frame.resize(frame.len().max(SHORTEST), 0);
    let sum = Crc32::of(&frame).to_le_bytes();
    [&PREAMBLE[..], &frame, &sum].concat()
}

/// The frame in bytes from the cable, without preamble and check sum, or `None` if it is damaged.
pub(super) fn frame_of(line: &[u8]) -> Option<&[u8]> {
    let frame = line.strip_prefix(&PREAMBLE)?;
    let (frame, sum) = frame.split_at_checked(frame.len().checked_sub(4)?)?;
    (Crc32::of(frame).to_le_bytes() == sum).then_some(frame)
}

/// Receiver and bytes of the datagram in a frame from the cable, or `None` if the frame is damaged or carries none.
pub(super) fn datagram_of(line: &[u8]) -> Option<(SocketAddrV4, Vec<u8>)> {
    let frame = frame_of(line)?;
    if frame.len() < HEADERS || frame[12..15] != [8, 0, 0x45] {
        return None;
    }
    let word = |at: usize| u16::from_be_bytes([frame[at], frame[at + 1]]);
    let length = usize::from(word(38)).checked_sub(8)?;
    let is_udp = frame[23] == 17 && internet_sum(&frame[14..34]) == 0 && usize::from(word(16)) == 28 + length;
    let [a, b, c, d] = [frame[30], frame[31], frame[32], frame[33]];
    let to = SocketAddrV4::new(Ipv4Addr::new(a, b, c, d), word(36));
    let is_for_host = frame[..6] == mac_of(*to.ip());
    let bytes = frame.get(HEADERS..HEADERS + length)?;
    (is_udp && is_for_host).then(|| (to, bytes.to_vec()))
}

/// The check sum of the header of IPv4.
fn internet_sum(header: &[u8]) -> u16 {
    let words = header.chunks_exact(2).map(|word| u32::from(u16::from_be_bytes([word[0], word[1]])));
    let mut sum: u32 = words.sum();
    while sum > 0xffff {
        sum = (sum & 0xffff) + (sum >> 16);
    }
    !(sum as u16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_datagram_comes_out_of_its_frame() {
        let host = SocketAddrV4::new(Ipv4Addr::new(10, 0, 0, 2), 40_000);
        let device = SocketAddrV4::new(Ipv4Addr::new(10, 0, 0, 7), 26_947);
        for length in [0, 1, 18, 19, 1472] {
            let bytes: Vec<u8> = (0..length).map(|byte| byte as u8).collect();
            let frame = framed(device, host, mac_of(*host.ip()), &bytes);
            assert_eq!(datagram_of(&frame), Some((host, bytes)));
            let mut damaged = frame.clone();
            damaged[30] ^= 1;
            assert_eq!(datagram_of(&damaged), None);
        }
    }

    #[test]
    fn noise_is_no_datagram() {
        for length in 0..90 {
            assert_eq!(datagram_of(&vec![0x55; length]), None);
        }
    }
}
