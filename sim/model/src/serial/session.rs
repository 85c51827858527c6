//! A session of the link: numbers, payload on its way to the core, answers on theirs to the host.

use std::collections::VecDeque;

use incircle_protocol::PADDING;

use super::answers::Answers;
use super::crc::Crc32;
use super::device::WordDevice;
use super::frame::FromHost;

/// How far behind the expected one a number may be to count as old.
const OLD: u8 = 128;

/// What became of data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Taken {
    /// It was awaited, and is in.
    Here,
    /// It was in before.
    Before,
    /// Other data comes first, or there is no room.
    NotYet,
    /// The same, and the host has been told since data was last taken.
    NotYetToldBefore,
}

/// A session under way.
#[derive(Clone, Debug)]
pub(super) struct Session {
    pub(super) number: u8,
    /// The data that is awaited.
    pub(super) expected: u8,
    /// Check sum of all payload that was taken.
    pub(super) taken: Crc32,
    /// Data came that is not to be taken before other data.
    has_gap: bool,
    /// Payload that the core has not taken.
    fifo: VecDeque<u32>,
    pub(super) answers: Answers,
    /// The core has taken a word of a command whose answer has not ended.
    pub(super) is_busy: bool,
    /// It has taken one since the last word of the last answer came.
    is_ahead: bool,
    /// Clocks since a word passed, and those after which the core can only be waiting for the host.
    quiet: u64,
    patience: u64,
}

impl Session {
    pub(super) fn new(number: u8, patience: u64) -> Self {
        Self {
            number,
            expected: 0,
            taken: Crc32::default(),
            has_gap: false,
            fifo: VecDeque::new(),
            answers: Answers::default(),
            is_busy: false,
            is_ahead: false,
            quiet: 0,
            patience,
        }
    }

    /// Words pass between FIFO, core and answers.
    pub(super) fn pass(&mut self, core: &mut impl WordDevice, clocks: u64) {
        for _ in 0..clocks {
            // Nothing to do, or nothing that can be done before the line has taken an answer word: such clocks are not simulated.
            if self.fifo.is_empty() && (!self.is_busy || self.quiet > self.patience) || !self.answers.has_room() {
                return;
            }
            self.quiet += 1;
            let passed = core.step(self.fifo.front().copied(), true);
            if passed.answer[0].is_some() || passed.is_taken {
                self.quiet = 0;
            }
            for word in passed.answer.into_iter().flatten() {
                if self.answers.add(word) {
                    self.is_ahead = false;
                }
            }
            if passed.is_taken {
                // Padding between commands is none.
                let is_padding = self.fifo.pop_front() == Some(PADDING) && !self.is_ahead;
                if !is_padding {
                    (self.is_busy, self.is_ahead) = (true, true);
                }
            }
        }
    }

    /// Bytes in the FIFO.
    pub(super) fn waiting_bytes(&self) -> usize {
        4 * self.fifo.len()
    }

    /// Data came that is not to be taken before other data.
    pub(super) fn has_gap(&self) -> bool {
        self.has_gap
    }

    /// The last part of an answer is sent.
    pub(super) fn end_answer(&mut self) {
        self.answers.end_answer();
        self.is_busy = self.is_ahead || !self.answers.is_quiet();
    }

    /// Data of this session; there is room for it or not.
    pub(super) fn take_data(&mut self, frame: &FromHost, is_room: bool) -> Taken {
        let behind = self.expected.wrapping_sub(frame.number);
        if behind == 0 && is_room {
            for bytes in frame.payload.chunks_exact(4) {
                let word = bytes.iter().rev().fold(0, |word, &byte| (word << 8) | u32::from(byte));
                self.fifo.push_back(word);
            }
            frame.payload.iter().for_each(|&byte| self.taken.add(byte));
            self.expected = self.expected.wrapping_add(1);
            self.has_gap = false;
            return Taken::Here;
        }
        if (1..=OLD).contains(&behind) {
            return Taken::Before;
        }
        if std::mem::replace(&mut self.has_gap, true) {
            Taken::NotYetToldBefore
        } else {
            Taken::NotYet
        }
    }
}
