//! The datagrams of the UDP link, as the host writes and reads them.

use incircle_protocol::{DeviceHeader, HostDatagram, HostHeader, CRC_BYTES, DATAGRAM_HEADER_BYTES};

use crate::transports::words::words_of;

/// A datagram to the device with these bytes of words.
pub(super) fn encode(kind: HostDatagram, number: u32, session: u64, words: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(DATAGRAM_HEADER_BYTES + words.len() + CRC_BYTES);
    bytes.extend(HostHeader { kind, number, session }.to_bytes());
    bytes.extend(words);
    let crc = crc32fast::hash(&bytes);
    bytes.extend(crc.to_le_bytes());
    bytes
}

/// A datagram of the device, with its body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Message<'a> {
    pub header: DeviceHeader,
    pub body: &'a [u8],
}

impl<'a> Message<'a> {
    /// The message in these bytes; `None` if the check sum or the kind is wrong.
    pub fn decode(bytes: &'a [u8]) -> Option<Self> {
        let (said, crc) = bytes.split_last_chunk::<CRC_BYTES>()?;
        if crc32fast::hash(said) != u32::from_le_bytes(*crc) {
            return None;
        }
        let (header, body) = said.split_first_chunk::<DATAGRAM_HEADER_BYTES>()?;
        Some(Self { header: DeviceHeader::from_bytes(*header)?, body })
    }

    /// The words of the body, without bytes that are left over.
    pub fn words(&self) -> impl Iterator<Item = u32> + use<'a> {
        words_of(self.body)
    }
}
