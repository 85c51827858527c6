//! A session of the serial link: numbers of frames, payload on its way to the core, and answers on their
//! way to the host.

use std::collections::VecDeque;

use incircle_protocol::PADDING;

use super::answers::Answers;
use super::crc::Crc32;
use super::device::WordDevice;
use super::frame::FromHost;

/// Largest distance behind the expected number at which a number counts as old.
const OLD: u8 = 128;

/// The outcome for a data frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Taken {
    /// The frame was expected, and its payload is in the FIFO.
    Here,
    /// The frame was already taken.
    Before,
    /// Another frame must come first, or there is no room.
    NotYet,
    /// Another frame must come first, or there is no room, and the host has been told since the last frame was taken.
    NotYetToldBefore,
}

/// The open session of a device.
#[derive(Clone, Debug)]
pub(super) struct Session {
    pub(super) number: u8,
    /// Number of the data frame that is expected next.
    pub(super) expected: u8,
    /// Check sum of all payload that was taken.
    pub(super) taken: Crc32,
    /// Whether a data frame came that must not be taken before another.
    has_gap: bool,
    /// Payload that the core has not taken.
    fifo: VecDeque<u32>,
    pub(super) answers: Answers,
    /// Whether the core has taken a word of a command and the answer has not ended.
    pub(super) is_busy: bool,
    /// Whether the core has taken a word since the last word of the last answer came.
    is_ahead: bool,
    /// Number of clocks since a word passed, and the number after which the core can only be waiting for the host.
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

    /// Lets words pass between the FIFO, the core and the answers, for this many clocks.
    pub(super) fn pass(&mut self, core: &mut impl WordDevice, clocks: u64) {
        for _ in 0..clocks {
            // In these clocks nothing is to do, or nothing can be done before the line takes an answer word, so
            // they are not simulated.
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
                // Padding between commands is not part of a command.
                let is_padding = self.fifo.pop_front() == Some(PADDING) && !self.is_ahead;
                if !is_padding {
                    (self.is_busy, self.is_ahead) = (true, true);
                }
            }
        }
    }

    /// Number of bytes in the FIFO.
    pub(super) fn waiting_bytes(&self) -> usize {
        4 * self.fifo.len()
    }

    /// Whether a data frame came that must not be taken before another.
    pub(super) fn has_gap(&self) -> bool {
        self.has_gap
    }

    /// Ends the current answer, whose last part has been sent.
    pub(super) fn end_answer(&mut self) {
        self.answers.end_answer();
        self.is_busy = self.is_ahead || !self.answers.is_quiet();
    }

    /// Takes a data frame of this session, if it is the expected one and there is room.
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
