//! Encoding frames to the device and decoding frames from it. No byte from the line is used before its check sum holds.

use incircle_protocol::{
    decode_reverse_cobs, DeviceFrame, HostFrame, ANSWER_HEADER_BYTES, CRC_BYTES, DEVICE_HEADER_BYTES, FRAME_END,
    HOST_HEADER_BYTES, MAX_DEVICE_FRAME, MAX_PAYLOAD,
};

use super::cobs;
use crate::transports::words::words_of;

/// Most bytes of an encoded frame from the device, without the closing zero.
const MAX_ENCODED: usize = MAX_DEVICE_FRAME + MAX_DEVICE_FRAME / 254 + 1;
/// Most bytes by which an encoded frame is longer than its payload: header, check sum, length bytes, closing zero.
pub(super) const MOST_OVERHEAD: usize = MAX_ENCODED + 1 - MAX_PAYLOAD;

/// Appends an encoded frame to the device, with its closing zero.
pub(super) fn encode(session: u8, kind: HostFrame, number: u8, payload: &[u8], out: &mut Vec<u8>) {
    debug_assert!(payload.len() <= MAX_PAYLOAD);
    let mut frame = Vec::with_capacity(HOST_HEADER_BYTES + payload.len() + CRC_BYTES);
    let [low, high] = (payload.len() as u16).to_le_bytes();
    frame.extend([session, kind as u8, number, low, high]);
    frame.extend_from_slice(payload);
    let crc = crc32fast::hash(&frame);
    frame.extend(crc.to_le_bytes());
    cobs::encode(&frame, out);
    out.push(FRAME_END);
}

/// A frame from the device whose check sum holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Message<'b> {
    /// Number of the session that is open on the device, or 0.
    pub session: u8,
    pub kind: DeviceFrame,
    /// Number of the `Data` frame that the device awaits.
    pub expected: u8,
    /// Number of answers that the device has sent to their end, modulo 256.
    pub answers: u8,
    /// Free bytes of the device's FIFO, which is the credit.
    pub free: u16,
    /// Status bits of the link.
    pub status: u8,
    /// Bytes behind the header, without the check sum.
    pub body: &'b [u8],
}

impl<'b> Message<'b> {
    /// Parses a decoded frame; `None` if it is too short, of no known kind, or has a wrong check sum.
    fn parse(frame: &'b [u8]) -> Option<Self> {
        let (checked, crc) = frame.split_last_chunk::<CRC_BYTES>()?;
        let (header, body) = checked.split_first_chunk::<DEVICE_HEADER_BYTES>()?;
        let &[session, kind, expected, answers, low, high, status] = header;
        let kind = DeviceFrame::from_u8(kind)?;
        if crc32fast::hash(checked) != u32::from_le_bytes(*crc) {
            return None;
        }
        let free = u16::from_le_bytes([low, high]);
        Some(Self { session, kind, expected, answers, free, status, body })
    }

    /// The body as `N` words; `None` if it has another length.
    pub fn words<const N: usize>(&self) -> Option<[u32; N]> {
        let mut words = [0; N];
        if self.body.len() != 4 * N {
            return None;
        }
        for (word, bytes) in words.iter_mut().zip(words_of(self.body)) {
            *word = bytes;
        }
        Some(words)
    }

    /// The body as a part of an answer; `None` if no part of an answer has this length.
    pub fn answer(&self) -> Option<AnswerPart<'b>> {
        let (&[number, low, high], rest) = self.body.split_first_chunk::<ANSWER_HEADER_BYTES>()?;
        let (words, digest) = if self.kind == DeviceFrame::AnswerEnd {
            let (words, digest) = rest.split_last_chunk::<CRC_BYTES>()?;
            (words, Some(u32::from_le_bytes(*digest)))
        } else {
            (rest, None)
        };
        if words.is_empty() || words.len() % 4 != 0 || words.len() > MAX_PAYLOAD {
            return None;
        }
        Some(AnswerPart { number, index: u16::from_le_bytes([low, high]), bytes: words, digest })
    }
}

/// A part of an answer: some of its words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct AnswerPart<'b> {
    /// Number of the answer, modulo 256.
    pub number: u8,
    /// Index of the first word of this part within the answer, modulo 65,536.
    pub index: u16,
    /// Words of this part, at least one, four bytes each.
    pub bytes: &'b [u8],
    /// Check sum over all words of the answer. Only the last part has it.
    pub digest: Option<u32>,
}

/// Finds frames in the bytes from the line. A decoder holds the bytes of one frame at most, whatever comes.
#[derive(Debug, Default)]
pub(super) struct Decoder {
    bytes: Vec<u8>,
    /// Whether more bytes came without a zero than any frame has. All bytes up to the next zero are then skipped.
    is_too_long: bool,
    /// Whether the bytes were handed out as a frame, so that they may be dropped.
    is_done: bool,
}

/// The outcome of the bytes up to a zero.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Decoded<'b> {
    /// No zero has come yet, or there were no bytes before it.
    Nothing,
    /// The bytes before the zero are not a frame.
    Broken,
    /// The bytes before the zero are a frame whose check sum holds.
    Frame(Message<'b>),
}

impl Decoder {
    /// Forgets the bytes of an unfinished frame.
    pub fn clear(&mut self) {
        *self = Self { bytes: std::mem::take(&mut self.bytes), ..Self::default() };
        self.bytes.clear();
    }

    /// Takes bytes up to the first zero. Returns the number of bytes taken, and what they completed.
    pub fn take(&mut self, bytes: &[u8]) -> (usize, Decoded<'_>) {
        if self.is_done {
            self.clear();
        }
        let end = bytes.iter().position(|&byte| byte == FRAME_END);
        let piece = &bytes[..end.unwrap_or(bytes.len())];
        let room = MAX_ENCODED - self.bytes.len();
        self.is_too_long |= piece.len() > room;
        self.bytes.extend_from_slice(&piece[..piece.len().min(room)]);
        match end {
            Some(end) => (end + 1, self.complete()),
            None => (bytes.len(), Decoded::Nothing),
        }
    }

    fn complete(&mut self) -> Decoded<'_> {
        self.is_done = true;
        if self.bytes.is_empty() {
            return Decoded::Nothing;
        }
        let start = if self.is_too_long { None } else { decode_reverse_cobs(&mut self.bytes) };
        let message = start.and_then(|start| Message::parse(&self.bytes[start..]));
        message.map_or(Decoded::Broken, Decoded::Frame)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// An encoded frame as a device sends it.
    pub fn device_frame(header: [u8; 7], body: &[u8]) -> Vec<u8> {
        let mut frame = header.to_vec();
        frame.extend_from_slice(body);
        let crc = crc32fast::hash(&frame);
        frame.extend(crc.to_le_bytes());
        let mut out = Vec::new();
        cobs::tests::encode_reverse(&frame, &mut out);
        out.push(FRAME_END);
        out
    }

    #[test]
    fn a_frame_towards_the_device_is_what_the_page_says() {
        let mut out = Vec::new();
        encode(9, HostFrame::Data, 3, &[1, 0, 0, 7], &mut out);
        assert_eq!(out.pop(), Some(0));
        let plain = cobs::tests::decode(&out).expect("COBS");
        assert_eq!(plain[..9], [9, 5, 3, 4, 0, 1, 0, 0, 7]);
        assert_eq!(plain[9..], crc32fast::hash(&plain[..9]).to_le_bytes());
        // The check sum of Ethernet and zip: this is its published check value.
        assert_eq!(crc32fast::hash(b"123456789"), 0xcbf4_3926);
    }

    #[test]
    fn frames_are_found_among_noise() {
        let mut line = vec![5, 6, 0, 0];
        line.extend(device_frame([7, 0x83, 2, 1, 0x10, 0x20, 1], &[1, 2, 3, 4]));
        line.extend([9; 5000]);
        line.push(0);
        let mut bad = device_frame([7, 0x83, 2, 1, 0, 0, 1], &[1, 2, 3, 4]);
        bad[1] ^= 1;
        line.extend(bad);
        line.extend(device_frame([7, 0x86, 2, 1, 0, 0, 1], &[4, 1, 0, 1, 2, 3, 4, 5, 6, 7, 8]));
        for chunk in [1, 3, 4096] {
            let mut decoder = Decoder::default();
            let mut found = Vec::new();
            for mut bytes in line.chunks(chunk) {
                while !bytes.is_empty() {
                    let (taken, decoded) = decoder.take(bytes);
                    match decoded {
                        Decoded::Nothing => {}
                        Decoded::Broken => found.push("broken".to_owned()),
                        Decoded::Frame(message) => found.push(format!("{:?} {:?}", message.kind, message.free)),
                    }
                    bytes = &bytes[taken..];
                    assert!(decoder.bytes.len() <= MAX_ENCODED);
                }
            }
            assert_eq!(found, ["broken", "Ack 8208", "broken", "broken", "AnswerEnd 0"]);
        }
    }

    #[test]
    fn parts_of_answers_are_whole_words() {
        let part = |kind, body: &[u8]| {
            let line = device_frame([1, kind, 0, 0, 0, 0, 0], body);
            let mut decoder = Decoder::default();
            let (_, decoded) = decoder.take(&line);
            let Decoded::Frame(message) = decoded else { panic!("{decoded:?}") };
            message.answer().map(|part| (part.number, part.index, part.bytes.len(), part.digest))
        };
        assert_eq!(part(0x85, &[3, 1, 2, 1, 0, 0, 0]), Some((3, 0x201, 4, None)));
        assert_eq!(part(0x86, &[3, 1, 2, 1, 0, 0, 0, 5, 0, 0, 0]), Some((3, 0x201, 4, Some(5))));
        for body in [&[][..], &[1, 2], &[1, 2, 3], &[1, 2, 3, 4], &[1, 2, 3, 4, 5, 6, 7, 8]] {
            assert_eq!(part(0x85, body), None);
            assert_eq!(part(0x86, body), None);
        }
    }
}
