//! The datagrams of the UDP link, one frame each. `protocol/UDP.md` says how host and device use them.
//!
//! A datagram to the device is a header of 16 bytes, words, and a CRC-32. A datagram to the host is a header of 16
//! bytes, a body, and a CRC-32. In numbers of several bytes the low byte comes first. This module packs and unpacks the
//! headers; each side computes the CRC-32 for itself.

use crate::layout::Identity;

/// Version of the UDP link, `major << 16 | minor`. A host refuses a device with another major version, or with an older
/// minor version.
pub const UDP_LINK_VERSION: u32 = 1 << 16;
/// First word of the greeting of the UDP link: the letters `inCu`.
pub const UDP_LINK_MAGIC: u32 = 0x696e_4375;
/// UDP port of a device unless another is chosen: the letters `iC`.
pub const UDP_PORT: u16 = 0x6943;
/// Number of bytes before the words of a datagram to the device, and before the body of one to the host.
pub const DATAGRAM_HEADER_BYTES: usize = 16;
/// Most words of a `Data` datagram, and most answer words of a datagram to the host.
pub const MAX_DATAGRAM_WORDS: usize = 360;
/// Number of bytes before the words in an answer's datagram: the number of the answer (4), the index of the first word
/// (4).
pub const DATAGRAM_ANSWER_BYTES: usize = 8;
/// Longest datagram to the device in bytes.
pub const MAX_HOST_DATAGRAM: usize = DATAGRAM_HEADER_BYTES + 4 * MAX_DATAGRAM_WORDS + 4;
/// Longest datagram to the host in bytes, the last one of a long answer: with the headers of UDP and IPv4 it fills the
/// 1,500 bytes of an Ethernet frame.
pub const MAX_DEVICE_DATAGRAM: usize = DATAGRAM_HEADER_BYTES + DATAGRAM_ANSWER_BYTES + 4 * MAX_DATAGRAM_WORDS + 8;
/// Most words of answers that a device keeps in its FIFO while its core goes on: 8,192 entries of two words.
pub const UDP_KEPT_WORDS: usize = 16_384;
/// Number of words of the greeting of the UDP link, and of the words in a `Hello` to the device.
pub const UDP_GREETING_WORDS: usize = 14;
/// Number of answer words that the software model of the link keeps while they wait for their datagram.
pub const UDP_ANSWER_WORDS: usize = 1024;

/// The kind of a datagram to the device. The numbers are those of the serial link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum HostDatagram {
    /// Ask for the greeting. Needs no session, and changes nothing.
    Hello = 0x01,
    /// Begin the session of this number, bound to the sender's address and port.
    Open = 0x02,
    /// Ask the device for its state.
    Poll = 0x04,
    /// Carry words of commands.
    Data = 0x05,
    /// End the session.
    Close = 0x06,
}

impl HostDatagram {
    /// The kind of this number, if there is one.
    pub const fn from_u8(value: u8) -> Option<Self> {
        Some(match value {
            0x01 => Self::Hello,
            0x02 => Self::Open,
            0x04 => Self::Poll,
            0x05 => Self::Data,
            0x06 => Self::Close,
            _ => return None,
        })
    }

    /// Whether a datagram of this kind may have this many words.
    pub const fn may_have_words(self, words: usize) -> bool {
        match self {
            // As many words as the greeting: a stranger's answer is never longer than the question.
            Self::Hello => words == UDP_GREETING_WORDS,
            Self::Data => words >= 1 && words <= MAX_DATAGRAM_WORDS,
            Self::Open | Self::Poll | Self::Close => words == 0,
        }
    }
}

/// The kind of a datagram to the host. The numbers are those of the serial link, and one more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum DeviceDatagram {
    /// The greeting, of [`UDP_GREETING_WORDS`] words.
    Hello = 0x81,
    /// The session is now open.
    Opened = 0x82,
    /// All datagrams before `expected` have been accepted. The body is the number of answers that were sent to their
    /// end in this session, and the CRC-32 of the words accepted in this session, 4 bytes each.
    Ack = 0x83,
    /// A datagram is missing, and the host must send again from `expected` on. The body is that of `Ack`.
    Nak = 0x84,
    /// Words of an answer that go on in the next datagram.
    Answer = 0x85,
    /// The last words of an answer, followed by the CRC-32 of all its words.
    AnswerEnd = 0x86,
    /// No session is open, because the device was reset or heard nothing of its host for too long.
    NoSession = 0x87,
    /// The session is now closed.
    Closed = 0x88,
    /// Another session is open.
    Busy = 0x89,
}

impl DeviceDatagram {
    /// The kind of this number, if there is one.
    pub const fn from_u8(value: u8) -> Option<Self> {
        Some(match value {
            0x81 => Self::Hello,
            0x82 => Self::Opened,
            0x83 => Self::Ack,
            0x84 => Self::Nak,
            0x85 => Self::Answer,
            0x86 => Self::AnswerEnd,
            0x87 => Self::NoSession,
            0x88 => Self::Closed,
            0x89 => Self::Busy,
            _ => return None,
        })
    }
}

/// The header of a datagram to the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HostHeader {
    /// Kind of the datagram.
    pub kind: HostDatagram,
    /// Number of a `Data` datagram, from 0 after `Open`; 0 in other kinds.
    pub number: u32,
    /// Number of the session. A `Hello` may have any number, which the answer repeats.
    pub session: u64,
}

impl HostHeader {
    /// The header as bytes. Bytes 1 to 3 are 0.
    pub const fn to_bytes(self) -> [u8; DATAGRAM_HEADER_BYTES] {
        with_tail([self.kind as u8, 0, 0, 0], self.number, self.session)
    }

    /// The header from bytes; `None` if there is no such kind. Bytes 1 to 3 have no meaning.
    pub const fn from_bytes(bytes: [u8; DATAGRAM_HEADER_BYTES]) -> Option<Self> {
        let (number, session) = tail_of(bytes);
        match HostDatagram::from_u8(bytes[0]) {
            Some(kind) => Some(Self { kind, number, session }),
            None => None,
        }
    }
}

/// The header of a datagram to the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeviceHeader {
    /// Kind of the datagram.
    pub kind: DeviceDatagram,
    /// Status bits: [`STATUS_OPEN`](crate::STATUS_OPEN), [`STATUS_DROPPED`](crate::STATUS_DROPPED) and
    /// [`STATUS_BUSY`](crate::STATUS_BUSY), as on the serial link.
    pub status: u8,
    /// Free bytes of the receive FIFO.
    pub free: u16,
    /// Number of the `Data` datagram that the device expects next.
    pub expected: u32,
    /// Number of the session, or the number in the datagram that this one answers.
    pub session: u64,
}

impl DeviceHeader {
    /// The header as bytes.
    pub const fn to_bytes(self) -> [u8; DATAGRAM_HEADER_BYTES] {
        let [low, high] = self.free.to_le_bytes();
        with_tail([self.kind as u8, self.status, low, high], self.expected, self.session)
    }

    /// The header from bytes; `None` if there is no such kind.
    pub const fn from_bytes(bytes: [u8; DATAGRAM_HEADER_BYTES]) -> Option<Self> {
        let (expected, session) = tail_of(bytes);
        let free = u16::from_le_bytes([bytes[2], bytes[3]]);
        match DeviceDatagram::from_u8(bytes[0]) {
            Some(kind) => Some(Self { kind, status: bytes[1], free, expected, session }),
            None => None,
        }
    }
}

/// Four bytes, a number and a session in a row.
const fn with_tail(first: [u8; 4], number: u32, session: u64) -> [u8; DATAGRAM_HEADER_BYTES] {
    let ([a, b, c, d], [e, f, g, h]) = (first, number.to_le_bytes());
    let [i, j, k, l, m, n, o, p] = session.to_le_bytes();
    [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p]
}

/// The number and the session behind the first four bytes.
const fn tail_of(bytes: [u8; DATAGRAM_HEADER_BYTES]) -> (u32, u64) {
    let [_, _, _, _, a, b, c, d, e, f, g, h, i, j, k, l] = bytes;
    (u32::from_le_bytes([a, b, c, d]), u64::from_le_bytes([e, f, g, h, i, j, k, l]))
}

/// The properties of a device's UDP link and core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UdpGreeting {
    /// The letters `inCu`, [`UDP_LINK_MAGIC`].
    pub magic: u32,
    /// Version of the UDP link, as [`UDP_LINK_VERSION`] packs it.
    pub link_version: u32,
    /// Clock of the core in Hz.
    pub clock_hz: u32,
    /// Size of the receive FIFO in bytes.
    pub fifo_bytes: u32,
    /// Milliseconds without a datagram of its host after which the device forgets the session.
    pub silence_ms: u32,
    /// Ethernet address of the device, in the order of its bytes on the wire.
    pub mac: [u8; 6],
    /// The identity of the core.
    pub identity: Identity,
}

impl UdpGreeting {
    /// The greeting as words, in the order of the fields. The Ethernet address takes two words, low byte first.
    pub const fn to_words(self) -> [u32; UDP_GREETING_WORDS] {
        let core = self.identity.to_words();
        let [a, b, c, d, e, f] = self.mac;
        [
            self.magic,
            self.link_version,
            self.clock_hz,
            self.fifo_bytes,
            self.silence_ms,
            u32::from_le_bytes([a, b, c, d]),
            u32::from_le_bytes([e, f, 0, 0]),
            core[0],
            core[1],
            core[2],
            core[3],
            core[4],
            core[5],
            core[6],
        ]
    }

    /// The greeting from words in the order of the fields. No value is checked.
    pub const fn from_words(words: [u32; UDP_GREETING_WORDS]) -> Self {
        let ([a, b, c, d], [e, f, _, _]) = (words[5].to_le_bytes(), words[6].to_le_bytes());
        Self {
            magic: words[0],
            link_version: words[1],
            clock_hz: words[2],
            fifo_bytes: words[3],
            silence_ms: words[4],
            mac: [a, b, c, d, e, f],
            identity: Identity::from_words([words[7], words[8], words[9], words[10], words[11], words[12], words[13]]),
        }
    }
}

/// The parameters of a UDP link in hardware.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UdpLinkConfig {
    /// Clock of the core in Hz.
    pub clock_hz: u32,
    /// Size of the receive FIFO in bytes, a power of two from 2,048 to 32,768.
    pub fifo_bytes: u32,
    /// Milliseconds without a datagram of its host after which the device forgets the session.
    pub silence_ms: u32,
    /// Ethernet address of the device.
    pub mac: [u8; 6],
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sequence of bytes that looks random.
    struct Noise(u64);

    impl Noise {
        fn bytes<const N: usize>(&mut self) -> [u8; N] {
            core::array::from_fn(|_| {
                self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (self.0 >> 56) as u8
            })
        }
    }

    #[test]
    fn the_longest_datagrams_fit_an_ethernet_frame() {
        assert_eq!((MAX_HOST_DATAGRAM, MAX_DEVICE_DATAGRAM), (1460, 1500 - 20 - 8));
    }

    #[test]
    fn any_bytes_are_a_header_or_are_refused() {
        let mut noise = Noise(1);
        for kind in (0..=u8::MAX).cycle().take(20_000) {
            let mut bytes: [u8; DATAGRAM_HEADER_BYTES] = noise.bytes();
            bytes[0] = kind;
            match DeviceHeader::from_bytes(bytes) {
                Some(header) => assert_eq!(header.to_bytes(), bytes),
                None => assert!(!(0x81..=0x89).contains(&kind)),
            }
            match HostHeader::from_bytes(bytes) {
                Some(header) => {
                    let again = header.to_bytes();
                    assert_eq!((&again[..4], &again[4..]), (&[kind, 0, 0, 0][..], &bytes[4..]));
                }
                None => assert!(![1, 2, 4, 5, 6].contains(&kind)),
            }
        }
    }

    #[test]
    fn every_kind_keeps_its_header() {
        let mut noise = Noise(2);
        for value in 0..=u8::MAX {
            let session = u64::from_le_bytes(noise.bytes());
            let number = u32::from_le_bytes(noise.bytes());
            if let Some(kind) = HostDatagram::from_u8(value) {
                let header = HostHeader { kind, number, session };
                assert_eq!(HostHeader::from_bytes(header.to_bytes()), Some(header));
            }
            if let Some(kind) = DeviceDatagram::from_u8(value) {
                let header = DeviceHeader { kind, status: value, free: number as u16, expected: number, session };
                assert_eq!(DeviceHeader::from_bytes(header.to_bytes()), Some(header));
            }
        }
    }

    #[test]
    fn greetings_keep_all_but_the_bytes_behind_the_address() {
        let mut noise = Noise(3);
        for _ in 0..1000 {
            let mut words: [u32; UDP_GREETING_WORDS] = core::array::from_fn(|_| u32::from_le_bytes(noise.bytes()));
            words[6] &= 0xffff;
            let greeting = UdpGreeting::from_words(words);
            // The word of engines holds the contexts in 8 bits, and 0 engines stand for one.
            let again = UdpGreeting::from_words(greeting.to_words());
            assert_eq!(again, greeting);
            assert_eq!(greeting.to_words()[..7], words[..7]);
        }
    }

    #[test]
    fn lengths_belong_to_kinds() {
        for words in 0..400 {
            assert_eq!(HostDatagram::Data.may_have_words(words), (1..=360).contains(&words));
            assert_eq!(HostDatagram::Hello.may_have_words(words), words == 14);
            assert_eq!(HostDatagram::Poll.may_have_words(words), words == 0);
        }
    }
}
