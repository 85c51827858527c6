//! Whole frames of the serial link, in both directions, and the receiver that finds them among the bytes of a line.

use incircle_protocol::{
    DeviceFrame, HostFrame, CRC_BYTES, DEVICE_HEADER_BYTES, FRAME_END, HOST_HEADER_BYTES, MAX_PAYLOAD,
};

use super::cobs::{decode_reverse, encode, encode_reverse, CobsDecoder};
use crate::link::Crc32;

/// Largest number of bytes of a frame to the device, decoded.
const MAX_HOST_FRAME: usize = HOST_HEADER_BYTES + MAX_PAYLOAD + CRC_BYTES;

/// A frame to the device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FromHost {
    /// Number of the session that the frame belongs to.
    pub session: u8,
    /// Type of the frame.
    pub kind: HostFrame,
    /// Number of the frame, if it carries data.
    pub number: u8,
    /// Payload of the frame.
    pub payload: Vec<u8>,
}

impl FromHost {
    /// The bytes on the line, with the zero at the end.
    pub fn to_line(&self) -> Vec<u8> {
        let length = self.payload.len() as u16;
        let mut bytes = vec![self.session, self.kind as u8, self.number];
        bytes.extend(length.to_le_bytes());
        bytes.extend(&self.payload);
        let crc = Crc32::of(&bytes);
        bytes.extend(crc.to_le_bytes());
        let mut line = encode(&bytes);
        line.push(FRAME_END);
        line
    }

    /// The frame from decoded bytes, or `None` if the check sum, the length or the type is wrong.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let (said, crc) = bytes.split_at_checked(bytes.len().checked_sub(CRC_BYTES)?)?;
        if Crc32::of(said).to_le_bytes() != crc {
            return None;
        }
        let (&[session, kind, number, low, high], payload) = said.split_first_chunk::<HOST_HEADER_BYTES>()?;
        let kind = HostFrame::from_u8(kind)?;
        if usize::from(u16::from_le_bytes([low, high])) != payload.len() || !is_length_of(kind, payload.len()) {
            return None;
        }
        Some(Self { session, kind, number, payload: payload.to_vec() })
    }
}

/// Whether a frame of this type may have this many bytes of payload.
fn is_length_of(kind: HostFrame, length: usize) -> bool {
    match kind {
        HostFrame::Data => (4..=MAX_PAYLOAD).contains(&length) && length.is_multiple_of(4),
        HostFrame::Rate => length == 4,
        HostFrame::Hello | HostFrame::Open | HostFrame::Poll | HostFrame::Close => length == 0,
    }
}

/// The result of the end of a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Received {
    /// There was no byte between two zeros.
    Nothing,
    /// A valid frame has come.
    Frame(FromHost),
    /// The bytes were no valid frame.
    Broken,
}

/// Takes the bytes of a line, and divides them into frames.
#[derive(Clone, Debug, Default)]
pub struct FrameReceiver {
    decoder: CobsDecoder,
    bytes: Vec<u8>,
    is_empty: bool,
    is_spoilt: bool,
}

impl FrameReceiver {
    /// A receiver that has received nothing.
    pub fn new() -> Self {
        Self { is_empty: true, ..Self::default() }
    }

    /// Reports that a byte of the line was lost. The frame that had begun is invalid, whatever follows;
    /// between frames nothing happens.
    pub fn spoil(&mut self) {
        self.is_spoilt |= !self.is_empty;
    }

    /// Takes a byte, and returns a result if that byte ends a frame.
    pub fn take(&mut self, byte: u8) -> Option<Received> {
        if byte != FRAME_END {
            self.is_empty = false;
            if let Some(decoded) = self.decoder.take(byte) {
                // Bytes beyond the longest frame are not kept.
                self.is_spoilt |= self.bytes.len() == MAX_HOST_FRAME;
                if !self.is_spoilt {
                    self.bytes.push(decoded);
                }
            }
            return None;
        }
        let is_whole = self.decoder.end() && !self.is_spoilt;
        let ended = std::mem::replace(self, Self::new());
        if ended.is_empty {
            return Some(Received::Nothing);
        }
        let frame = is_whole.then(|| FromHost::from_bytes(&ended.bytes)).flatten();
        Some(frame.map_or(Received::Broken, Received::Frame))
    }
}

/// A frame to the host, as an observer of the line sees it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FromDevice {
    /// Number of the open session.
    pub session: u8,
    /// Type of the frame.
    pub kind: DeviceFrame,
    /// Number of the next data frame that the device expects.
    pub expected: u8,
    /// Number of answers that were sent completely, modulo 256.
    pub answers: u8,
    /// Number of free bytes in the receive FIFO.
    pub free: u16,
    /// Status bits, `STATUS_...` of the protocol.
    pub status: u8,
    /// The bytes behind the header.
    pub body: Vec<u8>,
}

impl FromDevice {
    /// The bytes of the header.
    pub fn header(&self) -> [u8; DEVICE_HEADER_BYTES] {
        let [low, high] = self.free.to_le_bytes();
        [self.session, self.kind as u8, self.expected, self.answers, low, high, self.status]
    }

    /// The bytes on the line, with the zero at the end.
    pub fn to_line(&self) -> Vec<u8> {
        let mut bytes = self.header().to_vec();
        bytes.extend(&self.body);
        let crc = Crc32::of(&bytes);
        bytes.extend(crc.to_le_bytes());
        let mut line = encode_reverse(&bytes);
        line.push(FRAME_END);
        line
    }

    /// The frame from the bytes on the line, without the zero at their end. `None` if they are no valid frame.
    pub fn from_line(line: &[u8]) -> Option<Self> {
        let bytes = decode_reverse(line)?;
        let (said, crc) = bytes.split_at_checked(bytes.len().checked_sub(CRC_BYTES)?)?;
        if Crc32::of(said).to_le_bytes() != crc {
            return None;
        }
        let (&[session, kind, expected, answers, low, high, status], body) =
            said.split_first_chunk::<DEVICE_HEADER_BYTES>()?;
        let kind = DeviceFrame::from_u8(kind)?;
        let free = u16::from_le_bytes([low, high]);
        Some(Self { session, kind, expected, answers, free, status, body: body.to_vec() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn data(length: usize) -> FromHost {
        FromHost { session: 7, kind: HostFrame::Data, number: 200, payload: vec![0x55; length] }
    }

    fn received(line: &[u8]) -> Vec<Received> {
        let mut receiver = FrameReceiver::new();
        line.iter().filter_map(|&byte| receiver.take(byte)).collect()
    }

    #[test]
    fn frames_come_whole_or_broken_and_leave_nothing_behind() {
        let good = data(1024);
        let line = good.to_line();
        assert_eq!(received(&line), [Received::Frame(good.clone())]);
        assert_eq!(received(&[0, 0]), [Received::Nothing, Received::Nothing]);
        for place in (0..line.len() - 1).step_by(97) {
            let mut noisy = line.clone();
            noisy[place] ^= 0x10;
            let said = received(&[&noisy[..], &line].concat());
            assert_eq!(said.last(), Some(&Received::Frame(good.clone())), "{place}");
            assert!(!said[..said.len() - 1].iter().any(|said| matches!(said, Received::Frame(_))), "{place}");
            let cut = [&line[..place], &[0], &line[..]].concat();
            assert_eq!(received(&cut).last(), Some(&Received::Frame(good.clone())), "{place}");
        }
    }

    #[test]
    fn noise_spoils_the_frame_that_it_falls_into_and_no_other() {
        let good = data(8);
        let line = good.to_line();
        for place in 0..=line.len() {
            let mut receiver = FrameReceiver::new();
            let (before, behind) = line.split_at(place);
            let mut said: Vec<_> = before.iter().filter_map(|&byte| receiver.take(byte)).collect();
            receiver.spoil();
            said.extend(behind.iter().chain(&line).filter_map(|&byte| receiver.take(byte)));
            let is_hit = (1..line.len()).contains(&place);
            let first = if is_hit { Received::Broken } else { Received::Frame(good.clone()) };
            assert_eq!(said, [first, Received::Frame(good.clone())], "{place}");
        }
    }

    #[test]
    fn wrong_lengths_are_no_frames() {
        for length in [0, 3, 5, 1028] {
            assert_eq!(received(&data(length).to_line()), [Received::Broken], "{length}");
        }
        let long = [&[1; 5000][..], &[0]].concat();
        assert_eq!(received(&long), [Received::Broken]);
        let poll = FromHost { session: 1, kind: HostFrame::Poll, number: 0, payload: vec![1] };
        assert_eq!(received(&poll.to_line()), [Received::Broken]);
    }

    #[test]
    fn frames_of_the_device_come_back() {
        let frame = FromDevice {
            session: 9,
            kind: DeviceFrame::Answer,
            expected: 3,
            answers: 0,
            free: 4096,
            status: 1,
            body: vec![0; 700],
        };
        let line = frame.to_line();
        assert_eq!(FromDevice::from_line(&line[..line.len() - 1]), Some(frame));
        assert_eq!(FromDevice::from_line(&line[1..line.len() - 1]), None);
        assert_eq!(FromDevice::from_line(&[]), None);
    }
}
