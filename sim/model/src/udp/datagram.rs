//! Whole datagrams of the UDP link, in both directions.

use incircle_protocol::{DeviceDatagram, DeviceHeader, HostDatagram, HostHeader, DATAGRAM_HEADER_BYTES};

use crate::link::Crc32;

/// Number of bytes of a check sum.
const CRC_BYTES: usize = 4;

/// A datagram to the device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ToDevice {
    /// Number of the session that the datagram belongs to.
    pub session: u64,
    /// Kind of the datagram.
    pub kind: HostDatagram,
    /// Number of the datagram, if it carries data.
    pub number: u32,
    /// Words of the datagram.
    pub words: Vec<u32>,
}

impl ToDevice {
    /// The bytes of the datagram.
    pub fn to_bytes(&self) -> Vec<u8> {
        let header = HostHeader { kind: self.kind, number: self.number, session: self.session };
        let words: Vec<u8> = self.words.iter().flat_map(|word| word.to_le_bytes()).collect();
        sealed(header.to_bytes(), &words)
    }

    /// The datagram from its bytes, or `None` if the check sum, the length or the kind is wrong.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let (header, payload) = opened(bytes)?;
        let HostHeader { kind, number, session } = HostHeader::from_bytes(*header)?;
        let words: Vec<u32> = payload.chunks(4).map(word).collect::<Option<_>>()?;
        kind.may_have_words(words.len()).then_some(Self { session, kind, number, words })
    }
}

/// A datagram to the host, as an observer of the cable sees it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ToHost {
    /// The header.
    pub header: DeviceHeader,
    /// The bytes behind the header.
    pub body: Vec<u8>,
}

impl ToHost {
    /// The bytes of the datagram.
    pub fn to_bytes(&self) -> Vec<u8> {
        sealed(self.header.to_bytes(), &self.body)
    }

    /// The datagram from its bytes, or `None` if the check sum or the kind is wrong.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let (header, body) = opened(bytes)?;
        Some(Self { header: DeviceHeader::from_bytes(*header)?, body: body.to_vec() })
    }

    /// Kind of the datagram.
    pub fn kind(&self) -> DeviceDatagram {
        self.header.kind
    }
}

/// A header and a body with their check sum.
fn sealed(header: [u8; DATAGRAM_HEADER_BYTES], body: &[u8]) -> Vec<u8> {
    let mut bytes = [&header[..], body].concat();
    let crc = Crc32::of(&bytes);
    bytes.extend(crc.to_le_bytes());
    bytes
}

/// Header and body of a datagram, if its check sum is right.
fn opened(bytes: &[u8]) -> Option<(&[u8; DATAGRAM_HEADER_BYTES], &[u8])> {
    let (said, crc) = bytes.split_at_checked(bytes.len().checked_sub(CRC_BYTES)?)?;
    if Crc32::of(said).to_le_bytes() != crc {
        return None;
    }
    said.split_first_chunk()
}

/// Four bytes as a word; `None` for fewer bytes.
fn word(bytes: &[u8]) -> Option<u32> {
    bytes.try_into().ok().map(u32::from_le_bytes)
}
