//! The answers of the device on their way into frames.
//!
//! Hardware twin: the answer packer of `hdl/src/serial/`.

use std::collections::VecDeque;

use incircle_protocol::{ANSWER_HEADER_BYTES, MAX_PAYLOAD};

use super::crc::Crc32;

/// Number of words of an answer before its payload.
const HEAD_WORDS: u64 = 2;
/// Largest number of answer words in a frame.
const FRAME_WORDS: u64 = (MAX_PAYLOAD / 4) as u64;
/// Number of answer words that may wait for the line. The device is stopped at this number, and may then have
/// given one word more.
const WAITING: usize = 16;

/// The part of an answer that one frame carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// The bytes before the words.
    pub header: [u8; ANSWER_HEADER_BYTES],
    /// Number of words of the part that are still to come.
    pub words: u64,
    /// Whether the answer ends with this part.
    pub is_last: bool,
}

/// The words of answers, in order, and the ends of answers among them.
#[derive(Clone, Debug, Default)]
pub struct Answers {
    waiting: VecDeque<u32>,
    /// The answer that the device is giving: the number of words so far, and its length if that is known.
    coming: (u64, Option<u64>),
    /// Number of answers that were sent completely, modulo 256.
    sent: u8,
    /// Number of words of the current answer that are in frames.
    index: u64,
    /// Length of the current answer in words, if it is known.
    length: Option<u64>,
    crc: Crc32,
}

impl Answers {
    /// Whether there is room for one more word.
    pub fn has_room(&self) -> bool {
        self.waiting.len() < WAITING
    }

    /// Adds a word of the device, and returns whether it is the last of its answer.
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

    /// Number of answers that were sent completely, modulo 256.
    pub fn sent(&self) -> u8 {
        self.sent
    }

    /// Whether no word waits and no answer has been sent in part.
    pub fn is_quiet(&self) -> bool {
        self.waiting.is_empty() && self.length.is_none()
    }

    /// The next part, if it can begin. A new answer must have come up to its length, and a begun answer must
    /// have a word ready.
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

    /// The next word of the part that was begun, if the word has come.
    pub fn word(&mut self) -> Option<u32> {
        let word = self.waiting.pop_front()?;
        self.index += 1;
        word.to_le_bytes().iter().for_each(|&byte| self.crc.add(byte));
        Some(word)
    }

    /// Check sum of the words of the current answer so far.
    pub fn crc(&self) -> u32 {
        self.crc.value()
    }

    /// Ends the current answer, whose last part has been sent.
    pub fn end_answer(&mut self) {
        (self.index, self.length, self.crc) = (0, None, Crc32::default());
        self.sent = self.sent.wrapping_add(1);
    }
}
