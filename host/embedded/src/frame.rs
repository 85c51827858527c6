//! Frames: encoding those to the device byte by byte, and finding those from the device among received bytes.

use core::ops::Range;

use incircle_protocol::{
    decode_reverse_cobs, DeviceFrame, CRC_BYTES, DEVICE_HEADER_BYTES, FRAME_END, MAX_DEVICE_FRAME,
};

use crate::crc::Crc32;

/// Most bytes of a piece of COBS without a zero.
const PIECE: usize = 254;
/// Most bytes of an encoded frame from the device, without the closing zero.
const MAX_ENCODED: usize = MAX_DEVICE_FRAME + MAX_DEVICE_FRAME / PIECE + 1;

/// Encodes a frame to the device: takes its bytes and hands the bytes for the line to a sink.
///
/// COBS writes the length of a piece before the piece, so the encoder keeps one piece.
pub(crate) struct FrameWriter {
    piece: [u8; PIECE],
    length: usize,
    crc: Crc32,
}

impl FrameWriter {
    pub const fn new() -> Self {
        Self { piece: [0; PIECE], length: 0, crc: Crc32::new() }
    }

    /// Takes the next byte of header or payload.
    ///
    /// # Errors
    /// The first error of `sink`.
    pub fn add<E>(&mut self, byte: u8, sink: &mut impl FnMut(u8) -> Result<(), E>) -> Result<(), E> {
        self.crc.add(byte);
        self.encode(byte, sink)
    }

    fn encode<E>(&mut self, byte: u8, sink: &mut impl FnMut(u8) -> Result<(), E>) -> Result<(), E> {
        // A full piece stands for no zero, so it is handed out before the next byte is looked at.
        if self.length == PIECE {
            self.end_piece(sink)?;
        }
        if byte == 0 {
            return self.end_piece(sink);
        }
        if let Some(place) = self.piece.get_mut(self.length) {
            *place = byte;
            self.length += 1;
        }
        Ok(())
    }

    fn end_piece<E>(&mut self, sink: &mut impl FnMut(u8) -> Result<(), E>) -> Result<(), E> {
        // A piece has at most 254 bytes, so its length and one more fit a byte.
        sink(self.length as u8 + 1)?;
        let length = core::mem::take(&mut self.length);
        self.piece.iter().take(length).try_for_each(|&byte| sink(byte))
    }

    /// Adds the check sum and the closing zero.
    pub fn end<E>(mut self, sink: &mut impl FnMut(u8) -> Result<(), E>) -> Result<(), E> {
        for byte in self.crc.value().to_le_bytes() {
            self.encode(byte, sink)?;
        }
        self.end_piece(sink)?;
        sink(FRAME_END)
    }
}

/// The header of a frame from the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Header {
    pub session: u8,
    pub kind: DeviceFrame,
    /// Number of the `Data` frame that the device expects next.
    pub expected: u8,
    /// Answers sent to their end in this session, modulo 256.
    pub answers: u8,
    /// Free bytes of the device's FIFO.
    pub free: u16,
    /// Status bits, `STATUS_...` of the protocol.
    pub status: u8,
}

/// The content of the reader.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Held {
    /// Bytes of a frame that has not ended.
    Part,
    /// A frame that nobody has looked at, with the place of its body.
    Frame(Header, Range<usize>),
    /// A frame that somebody has looked at. The next byte replaces it.
    Seen(Header, Range<usize>),
}

/// Finds frames in the bytes from the line, and holds one frame.
pub(crate) struct FrameReader {
    bytes: [u8; MAX_ENCODED],
    length: usize,
    /// Whether more bytes came without a zero than any frame has.
    is_too_long: bool,
    held: Held,
}

impl FrameReader {
    pub const fn new() -> Self {
        Self { bytes: [0; MAX_ENCODED], length: 0, is_too_long: false, held: Held::Part }
    }

    /// Forgets all bytes.
    pub fn clear(&mut self) {
        (self.length, self.is_too_long, self.held) = (0, false, Held::Part);
    }

    /// Whether a frame waits to be looked at. The reader takes no byte until then.
    pub const fn has_frame(&self) -> bool {
        matches!(self.held, Held::Frame(..))
    }

    /// Looks at the frame that waits, if there is one. Its body stays until the next byte is taken.
    pub fn look(&mut self) -> Option<Header> {
        let Held::Frame(header, body) = &self.held else { return None };
        let (header, body) = (*header, body.clone());
        self.held = Held::Seen(header, body);
        Some(header)
    }

    /// Lets the frame that was looked at wait to be looked at once more.
    pub fn look_again(&mut self) {
        if let Held::Seen(header, body) = &self.held {
            self.held = Held::Frame(*header, body.clone());
        }
    }

    /// The body of the frame that is held, without the check sum.
    pub fn body(&self) -> &[u8] {
        match &self.held {
            Held::Frame(_, body) | Held::Seen(_, body) => self.bytes.get(body.clone()).unwrap_or_default(),
            Held::Part => &[],
        }
    }

    /// Takes a byte from the line. A frame whose check sum is wrong is dropped. A frame that waits is not replaced: the
    /// byte is lost, as on a line, and the protocol repairs that.
    pub fn take(&mut self, byte: u8) {
        if self.has_frame() {
            return;
        }
        self.held = Held::Part;
        if byte != FRAME_END {
            match self.bytes.get_mut(self.length) {
                Some(place) => (*place, self.length) = (byte, self.length + 1),
                None => self.is_too_long = true,
            }
            return;
        }
        let length = core::mem::take(&mut self.length);
        if !core::mem::take(&mut self.is_too_long) {
            if let Some((header, body)) = self.parse(length) {
                self.held = Held::Frame(header, body);
            }
        }
    }

    /// The frame in the first bytes, with the place of its body.
    fn parse(&mut self, length: usize) -> Option<(Header, Range<usize>)> {
        let encoded = self.bytes.get_mut(..length)?;
        let start = decode_reverse_cobs(encoded)?;
        let (said, crc) = encoded.get(start..)?.split_last_chunk::<CRC_BYTES>()?;
        let (&[session, kind, expected, answers, low, high, status], _) =
            said.split_first_chunk::<DEVICE_HEADER_BYTES>()?;
        if Crc32::of(said) != u32::from_le_bytes(*crc) {
            return None;
        }
        let kind = DeviceFrame::from_u8(kind)?;
        let header = Header { session, kind, expected, answers, free: u16::from_le_bytes([low, high]), status };
        Some((header, start + DEVICE_HEADER_BYTES..length - CRC_BYTES))
    }
}

/// The 32-bit word at this place of little-endian bytes; `None` beyond their end.
pub(crate) fn word_at(bytes: &[u8], index: usize) -> Option<u32> {
    let bytes = bytes.get(4 * index..)?.first_chunk()?;
    Some(u32::from_le_bytes(*bytes))
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use incircle_model::serial::{FromDevice, FromHost};
    use incircle_protocol::HostFrame;
    use incircle_testkit::SplitMix64;
    use std::vec::Vec;

    fn random_payload(random: &mut SplitMix64, length: usize) -> Vec<u8> {
        // Long pieces without a zero, and many zeros.
        let most = [0xffu64, 3, 1][random.below(3) as usize];
        let least = random.below(2) as u8;
        (0..length).map(|_| (random.below(most + 1) as u8).max(least)).collect()
    }

    /// The frames equal those of the model, which shares no code with this crate.
    #[test]
    fn frames_to_the_device_are_those_of_the_model() {
        let mut random = SplitMix64::new(1);
        for length in (0..=1024).step_by(4) {
            let payload = random_payload(&mut random, length);
            let frame = FromHost { session: 7, kind: HostFrame::Data, number: 3, payload };
            let mut line = Vec::new();
            let mut sink = |byte| {
                line.push(byte);
                Ok::<(), ()>(())
            };
            let mut writer = FrameWriter::new();
            let [low, high] = (length as u16).to_le_bytes();
            for byte in [7, HostFrame::Data as u8, 3, low, high].into_iter().chain(frame.payload.iter().copied()) {
                writer.add(byte, &mut sink).unwrap();
            }
            writer.end(&mut sink).unwrap();
            assert_eq!(line, frame.to_line(), "{length}");
        }
    }

    #[test]
    fn frames_of_the_model_are_found_among_noise() {
        let mut random = SplitMix64::new(2);
        let mut reader = FrameReader::new();
        for length in 0..=1031 {
            let body = random_payload(&mut random, length);
            let (kind, status) = (DeviceFrame::Answer, 1);
            let frame = FromDevice { session: 9, kind, expected: 1, answers: 0, free: 4096, status, body };
            let line = frame.to_line();
            let mut broken = line.clone();
            broken[random.below(line.len() as u64 - 1) as usize] ^= 0x55;
            let noise: Vec<u8> = (0..random.below(3000)).map(|_| random.next_u64() as u8).collect();
            for byte in noise.into_iter().chain([0]).chain(broken).chain([0]).chain(line) {
                assert_eq!(reader.look(), None, "{length}");
                reader.take(byte);
            }
            let header = Header { session: 9, kind, expected: 1, answers: 0, free: 4096, status };
            assert_eq!(reader.look(), Some(header), "{length}");
            assert_eq!(reader.body(), frame.body, "{length}");
            reader.look_again();
            assert_eq!(reader.look(), Some(header), "{length}");
        }
        assert_eq!(word_at(&[1, 2, 3, 4, 5, 0, 0, 0], 1), Some(5));
        assert_eq!(word_at(&[0; 7], 1), None);
    }
}
