//! A lying device on a serial line. The liar takes the device's frames apart, changes them, and closes them with a
//! correct check sum, so a host cannot tell the lie from a frame of the device.

use std::collections::VecDeque;

use incircle_model::serial::{Crc32, FromDevice};
use incircle_protocol::{
    answer_opcode, DeviceFrame, Opcode, ANSWER_HEADER_BYTES, CRC_BYTES, FRAME_END, GREETING_WORDS, IDENTITY_WORDS,
    MAX_DEVICE_FRAME,
};

/// The lie that a device tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lie {
    /// The link claims another major version.
    Version,
    /// The core claims another major version of the protocol.
    Protocol,
    /// The identity claims a capacity of 2^32 - 1 points.
    Capacity,
    /// Records name points that do not exist.
    Index,
    /// The answers to `Read` never end.
    Endless,
    /// Every frame claims more room than the device has.
    Credit,
    /// The report of an insertion counts points that were never sent.
    Report,
}

impl Lie {
    /// The names of all lies, for messages.
    pub const NAMES: &'static str = "version, protocol, capacity, index, endless, credit or report";

    /// The lie of this name.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "version" => Self::Version,
            "protocol" => Self::Protocol,
            "capacity" => Self::Capacity,
            "index" => Self::Index,
            "endless" => Self::Endless,
            "credit" => Self::Credit,
            "report" => Self::Report,
            _ => return None,
        })
    }
}

/// Indices of words in the greeting.
const LINK_VERSION_WORD: usize = 1;
const IDENTITY: usize = GREETING_WORDS - IDENTITY_WORDS;
/// Indices of words in the identity.
const PROTOCOL_VERSION_WORD: usize = 1;
const CAPACITY_WORD: usize = 4;
/// Number of words in front of an answer's payload.
const HEAD_WORDS: usize = 2;
/// Indices of words of an answer's first records.
const FIRST_RECORD: std::ops::Range<usize> = HEAD_WORDS..HEAD_WORDS + 3;
/// A word with ids that no small job has in any form: 3fe with ids of 10 bits, ffe with those of 12, fbfe and ffef with
/// those of 16, and 7bfe in a whole record. None of them is the infinite vertex.
const NO_VERTEX: u32 = 0xffef_fbfe;
/// Number of frames that are sent in place of the end of an answer that never ends.
const ENDLESS_FRAMES: u8 = 8;

/// Turns the bytes of a device into those of a liar.
#[derive(Debug)]
pub(super) struct Liar {
    lie: Lie,
    line: Vec<u8>,
    /// Number of words of the current answer so far, and its opcode.
    words: usize,
    opcode: u8,
    /// Check sum of the words of the current answer as they were changed.
    crc: Crc32,
    said: VecDeque<u8>,
}

impl Liar {
    pub(super) fn new(lie: Lie) -> Self {
        Self { lie, line: Vec::new(), words: 0, opcode: 0, crc: Crc32::default(), said: VecDeque::new() }
    }

    /// Takes the next byte of the liar.
    pub(super) fn next(&mut self) -> Option<u8> {
        self.said.pop_front()
    }

    /// Hands over a byte of the device. Bytes are kept until their frame ends.
    pub(super) fn take(&mut self, byte: u8) {
        if byte != FRAME_END && self.line.len() < 2 * MAX_DEVICE_FRAME {
            return self.line.push(byte);
        }
        let line = std::mem::take(&mut self.line);
        match FromDevice::from_line(&line) {
            Some(frame) => self.say(frame),
            None => self.said.extend(line.into_iter().chain([byte])),
        }
    }

    fn say(&mut self, mut frame: FromDevice) {
        if self.lie == Lie::Credit {
            frame.free = u16::MAX;
        }
        match frame.kind {
            DeviceFrame::Hello => self.lie_of_identity(&mut frame.body, IDENTITY),
            DeviceFrame::Answer | DeviceFrame::AnswerEnd => return self.say_answer(frame),
            _ => {}
        }
        self.said.extend(frame.to_line());
    }

    /// Changes the identity in a greeting or in the answer to `Hello`. `identity` is the index of
    /// the identity's first word.
    fn lie_of_identity(&self, bytes: &mut [u8], identity: usize) {
        let (place, value) = match self.lie {
            Lie::Version if identity == IDENTITY => (LINK_VERSION_WORD, 2 << 16),
            Lie::Protocol => (identity + PROTOCOL_VERSION_WORD, 9 << 16),
            Lie::Capacity => (identity + CAPACITY_WORD, u32::MAX),
            _ => return,
        };
        put(bytes, place, value);
    }

    fn say_answer(&mut self, mut frame: FromDevice) {
        let mut end = frame.body.len();
        if frame.kind == DeviceFrame::AnswerEnd {
            end = end.saturating_sub(CRC_BYTES);
        }
        let Some(words) = frame.body.get_mut(ANSWER_HEADER_BYTES..end) else {
            return;
        };
        let is_first = self.words == 0;
        if let (true, Some(header)) = (is_first, words.first_chunk()) {
            self.opcode = answer_opcode(u32::from_le_bytes(*header));
        }
        match (Opcode::from_u8(self.opcode), self.lie) {
            (Some(Opcode::Hello), _) if is_first => self.lie_of_identity(words, HEAD_WORDS),
            (Some(Opcode::Read | Opcode::Triangles), Lie::Index) if is_first => {
                for place in FIRST_RECORD {
                    put(words, place, NO_VERTEX);
                }
            }
            (Some(Opcode::Insert), Lie::Report) if is_first => put(words, HEAD_WORDS, 1_000_000),
            _ => {}
        }
        words.iter().for_each(|&byte| self.crc.add(byte));
        self.words += words.len() / 4;
        if frame.kind == DeviceFrame::AnswerEnd {
            self.end_answer(frame, end);
        } else {
            self.said.extend(frame.to_line());
        }
    }

    /// Sends the last frame of an answer, or, for an answer that never ends, the same words again and again.
    fn end_answer(&mut self, mut frame: FromDevice, end: usize) {
        frame.body.truncate(end);
        let is_read_out = matches!(Opcode::from_u8(self.opcode), Some(Opcode::Read | Opcode::Triangles));
        if self.lie == Lie::Endless && is_read_out {
            frame.kind = DeviceFrame::Answer;
            for _ in 0..ENDLESS_FRAMES {
                self.said.extend(frame.to_line());
                let index = u16::from_le_bytes([frame.body[1], frame.body[2]]);
                let words = (end - ANSWER_HEADER_BYTES) / 4;
                let [low, high] = index.wrapping_add(words as u16).to_le_bytes();
                (frame.body[1], frame.body[2]) = (low, high);
            }
        } else {
            frame.body.extend(self.crc.value().to_le_bytes());
            self.said.extend(frame.to_line());
        }
        (self.words, self.crc) = (0, Crc32::default());
    }
}

/// Changes a word, if the frame has it.
fn put(bytes: &mut [u8], word: usize, value: u32) {
    if let Some(place) = bytes.get_mut(4 * word..4 * word + 4) {
        place.copy_from_slice(&value.to_le_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(lie: Lie, frames: &[FromDevice]) -> Vec<FromDevice> {
        let mut liar = Liar::new(lie);
        frames.iter().flat_map(FromDevice::to_line).for_each(|byte| liar.take(byte));
        let line: Vec<u8> = std::iter::from_fn(|| liar.next()).collect();
        let frames = line.split(|&byte| byte == 0).filter(|line| !line.is_empty());
        frames.map(|line| FromDevice::from_line(line).unwrap()).collect()
    }

    fn frame(kind: DeviceFrame, words: &[u32]) -> FromDevice {
        let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        let mut body = bytes.clone();
        if kind == DeviceFrame::AnswerEnd {
            body = [&[0; 3][..], &bytes, &Crc32::of(&bytes).to_le_bytes()].concat();
        }
        FromDevice { session: 1, kind, expected: 2, answers: 0, free: 4096, status: 1, body }
    }

    fn word(frame: &FromDevice, start: usize, place: usize) -> u32 {
        let bytes = &frame.body[start + 4 * place..][..4];
        u32::from_le_bytes(bytes.try_into().unwrap())
    }

    #[test]
    fn lies_have_sound_check_sums() {
        let hello = frame(DeviceFrame::Hello, &[7; GREETING_WORDS]);
        assert_eq!(word(&said(Lie::Version, std::slice::from_ref(&hello))[0], 0, 1), 2 << 16);
        assert_eq!(word(&said(Lie::Protocol, std::slice::from_ref(&hello))[0], 0, 7), 9 << 16);
        assert_eq!(word(&said(Lie::Capacity, std::slice::from_ref(&hello))[0], 0, 10), u32::MAX);
        let frames = said(Lie::Credit, &[hello.clone(), frame(DeviceFrame::Ack, &[1])]);
        assert!(frames.iter().all(|frame| frame.free == u16::MAX));
        assert_eq!(said(Lie::Index, std::slice::from_ref(&hello)), [hello]);
    }

    #[test]
    fn answers_are_told_otherwise_or_without_end() {
        for opcode in [Opcode::Read, Opcode::Triangles] {
            read_outs_are_told_otherwise_or_without_end(opcode);
        }
    }

    fn read_outs_are_told_otherwise_or_without_end(opcode: Opcode) {
        let read = frame(DeviceFrame::AnswerEnd, &[(opcode as u32) << 24, 6, 1, 2, 3, 4, 5, 6]);
        let lied = &said(Lie::Index, std::slice::from_ref(&read))[0];
        assert_eq!((word(lied, 3, 2), word(lied, 3, 5)), (NO_VERTEX, 4));
        let words = &lied.body[3..lied.body.len() - 4];
        assert_eq!(lied.body[lied.body.len() - 4..], Crc32::of(words).to_le_bytes());
        let endless = said(Lie::Endless, std::slice::from_ref(&read));
        assert_eq!(endless.len(), usize::from(ENDLESS_FRAMES));
        assert!(endless.iter().all(|frame| frame.kind == DeviceFrame::Answer));
        assert_eq!(endless[1].body[1], 8);
        let insert = frame(DeviceFrame::AnswerEnd, &[0x0300_0000, 5, 9, 9, 0, 0, 16]);
        assert_eq!(word(&said(Lie::Report, std::slice::from_ref(&insert))[0], 3, 2), 1_000_000);
        assert_eq!(said(Lie::Report, std::slice::from_ref(&read)), [read]);
    }

    #[test]
    fn what_is_no_frame_passes() {
        let mut liar = Liar::new(Lie::Credit);
        [9, 8, 7, 0].into_iter().for_each(|byte| liar.take(byte));
        assert_eq!(std::iter::from_fn(|| liar.next()).collect::<Vec<_>>(), [9, 8, 7, 0]);
    }
}
