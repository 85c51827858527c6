//! The answers of the device on their way to the host.

use std::collections::VecDeque;

use super::crc::Crc32;

/// Number of words of an answer before its payload.
const HEAD_WORDS: u64 = 2;

/// The words of answers, in order, and the ends of answers among them.
#[derive(Clone, Debug)]
pub(crate) struct Answers {
    waiting: VecDeque<u32>,
    /// Number of words that may wait. The device is stopped at this number, and may then have given one word more.
    room: usize,
    /// The answer that the device is giving: the number of words so far, and its length if that is known.
    coming: (u64, Option<u64>),
    /// Number of answers that were sent to their end, modulo 2^32.
    sent: u32,
    /// Number of words of the current answer that were taken.
    index: u64,
    /// Length of the current answer in words, if it is known.
    length: Option<u64>,
    crc: Crc32,
}

impl Answers {
    /// No answers, with room for this many words.
    pub fn new(room: usize) -> Self {
        let (waiting, crc) = (VecDeque::new(), Crc32::default());
        Self { waiting, room, coming: (0, None), sent: 0, index: 0, length: None, crc }
    }

    /// Whether there is room for one more word.
    pub fn has_room(&self) -> bool {
        self.waiting.len() < self.room
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

    /// Number of answers that were sent to their end, modulo 2^32. It is the number of the current answer.
    pub fn sent(&self) -> u32 {
        self.sent
    }

    /// Index of the next word in the current answer, modulo 2^32.
    pub fn index(&self) -> u32 {
        self.index as u32
    }

    /// Whether no word waits and no answer has been sent in part.
    pub fn is_quiet(&self) -> bool {
        self.waiting.is_empty() && self.length.is_none()
    }

    /// Number of words that wait.
    pub fn waiting(&self) -> usize {
        self.waiting.len()
    }

    /// Number of words of the current answer that were not taken. `None` before the answer has come up to its length.
    pub fn left(&mut self) -> Option<u64> {
        if self.length.is_none() {
            let payload = *self.waiting.get(1)?;
            self.length = Some(HEAD_WORDS + u64::from(payload));
        }
        Some(self.length? - self.index)
    }

    /// Takes the next word of the current answer, if it has come.
    pub fn take(&mut self) -> Option<u32> {
        let word = self.waiting.pop_front()?;
        self.index += 1;
        word.to_le_bytes().iter().for_each(|&byte| self.crc.add(byte));
        Some(word)
    }

    /// Check sum of the words of the current answer that were taken.
    pub fn crc(&self) -> u32 {
        self.crc.value()
    }

    /// Ends the current answer, whose last word has been sent.
    pub fn end_answer(&mut self) {
        (self.index, self.length, self.crc) = (0, None, Crc32::default());
        self.sent = self.sent.wrapping_add(1);
    }
}
