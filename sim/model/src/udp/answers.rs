//! The answers of the device on their way into datagrams.

use std::collections::VecDeque;

use incircle_protocol::{MAX_DATAGRAM_WORDS, UDP_ANSWER_WORDS};

use crate::serial::Crc32;

/// Number of words of an answer before its payload.
const HEAD_WORDS: u64 = 2;

/// The part of an answer that one datagram carries.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Part {
    /// Number of the answer, from 0 after `Open`.
    pub number: u32,
    /// Index of the first word in the answer.
    pub index: u32,
    pub words: Vec<u32>,
    /// The CRC-32 of all words of the answer, if it ends with this part.
    pub digest: Option<u32>,
}

/// The words of answers, in order, and the ends of answers among them.
#[derive(Clone, Debug, Default)]
pub(super) struct Answers {
    waiting: VecDeque<u32>,
    /// The answer that the core is giving: the number of words so far, and its length if that is known.
    coming: (u64, Option<u64>),
    /// Number of answers that were sent to their end.
    sent: u32,
    /// Number of words of the current answer that are in datagrams.
    index: u64,
    /// Length of the current answer in words, if it is known.
    length: Option<u64>,
    crc: Crc32,
}

impl Answers {
    /// Whether there is room for one more word.
    pub fn has_room(&self) -> bool {
        self.waiting.len() < UDP_ANSWER_WORDS
    }

    /// Adds a word of the core, and returns whether it is the last of its answer.
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

    /// Number of answers that were sent to their end.
    pub fn sent(&self) -> u32 {
        self.sent
    }

    /// Whether no word waits and no answer has been sent in part.
    pub fn is_quiet(&self) -> bool {
        self.waiting.is_empty() && self.length.is_none()
    }

    /// The next part, once all its words have come: a datagram cannot wait for words in its middle.
    pub fn next_part(&mut self) -> Option<Part> {
        if self.length.is_none() {
            let payload = *self.waiting.get(1)?;
            self.length = Some(HEAD_WORDS + u64::from(payload));
        }
        let left = self.length? - self.index;
        let count = left.min(MAX_DATAGRAM_WORDS as u64);
        if (self.waiting.len() as u64) < count {
            return None;
        }
        let words: Vec<u32> = self.waiting.drain(..count as usize).collect();
        words.iter().flat_map(|word| word.to_le_bytes()).for_each(|byte| self.crc.add(byte));
        let digest = (left == count).then(|| self.crc.value());
        let part = Part { number: self.sent, index: self.index as u32, words, digest };
        self.index += count;
        if digest.is_some() {
            (self.index, self.length, self.crc) = (0, None, Crc32::default());
            self.sent = self.sent.wrapping_add(1);
        }
        Some(part)
    }
}
