//! Answers of the device on their way into frames.

use std::collections::VecDeque;

use incircle_protocol::{ANSWER_HEADER_BYTES, MAX_PAYLOAD};

use super::crc::Crc32;

/// Words of an answer before its payload.
const HEAD_WORDS: u64 = 2;
/// Most answer words of a frame.
const FRAME_WORDS: u64 = (MAX_PAYLOAD / 4) as u64;
/// Answer words that wait for the line; the device is held up by so many, and may then have given one more.
const WAITING: usize = 16;

/// The part of an answer that a frame carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Bytes before the words.
    pub header: [u8; ANSWER_HEADER_BYTES],
    /// How many words.
    pub words: u64,
    /// The answer ends with them.
    pub is_last: bool,
}

/// Words of answers, in order, and where each of them ends.
#[derive(Clone, Debug, Default)]
pub struct Answers {
    waiting: VecDeque<u32>,
    /// Words of the answer that comes in: how many came, and how many it has, if that is known.
    coming: (u64, Option<u64>),
    /// Answers sent to their end.
    sent: u8,
    /// Words of the present answer that are in frames.
    index: u64,
    /// Words of the present answer, if its length is known.
    length: Option<u64>,
    crc: Crc32,
}

impl Answers {
    /// Room for one more word.
    pub fn has_room(&self) -> bool {
        self.waiting.len() < WAITING
    }

    /// One more word of the device; true if it is the last of its answer.
    pub fn add(&mut self, word: u32) -> bool {
        self.waiting.push_back(word);
        let (came, length) = &mut self.coming;
        *came += 1;
        if *came == HEAD_WORDS {
            *length = Some(HEAD_WORDS + u64::from(word));
        }
        let is_last = *length == Some(*came);
        if is_last {
            self.coming = (0, None);
        }
        is_last
    }

    /// Number of answers sent to their end, modulo 256.
    pub fn sent(&self) -> u8 {
        self.sent
    }

    /// Nothing waits and no answer is half sent.
    pub fn is_quiet(&self) -> bool {
        self.waiting.is_empty() && self.length.is_none()
    }

    /// The next part, if it can be begun: of a new answer the length is there, of an old one a word.
    pub fn begin_part(&mut self) -> Option<Part> {
        if self.length.is_none() {
            let payload = *self.waiting.get(1)?;
            self.length = Some(HEAD_WORDS + u64::from(payload));
        }
        self.waiting.front()?;
        let left = self.length? - self.index;
        let [low, high] = (self.index as u16).to_le_bytes();
        Some(Part { header: [self.sent, low, high], words: left.min(FRAME_WORDS), is_last: left <= FRAME_WORDS })
    }

    /// The next word of the part that was begun, if it is there.
    pub fn word(&mut self) -> Option<u32> {
        let word = self.waiting.pop_front()?;
        self.index += 1;
        word.to_le_bytes().iter().for_each(|&byte| self.crc.add(byte));
        Some(word)
    }

    /// Check sum of the words of the present answer so far.
    pub fn crc(&self) -> u32 {
        self.crc.value()
    }

    /// The last part is sent.
    pub fn end_answer(&mut self) {
        (self.index, self.length, self.crc) = (0, None, Crc32::default());
        self.sent = self.sent.wrapping_add(1);
    }
}
