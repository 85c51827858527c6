//! The words of a session: commands in the FIFO before the core, and answers behind it.

use std::collections::VecDeque;

use incircle_protocol::PADDING;

use super::answers::Answers;
use super::crc::Crc32;
use super::device::WordDevice;

/// The outcome for a `Data` frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Taken {
    /// The frame was expected, and its words are in the FIFO.
    Here,
    /// The frame was already taken.
    Before,
    /// Another frame must come first, or there is no room.
    NotYet,
    /// Another frame must come first, or there is no room, and the host has been told since the last frame was taken.
    NotYetToldBefore,
}

/// The words of a session on both sides of the core.
#[derive(Clone, Debug)]
pub(crate) struct Flow {
    /// Words that the core has not taken.
    fifo: VecDeque<u32>,
    /// Check sum of all words that were taken from the host.
    taken: Crc32,
    /// Whether a `Data` frame came that must not be taken before another.
    has_gap: bool,
    pub answers: Answers,
    /// Whether the core has taken a word of a command and the answer has not ended.
    is_busy: bool,
    /// Whether the core has taken a word since the last word of the last answer came.
    is_ahead: bool,
    /// Number of clocks since a word passed, and the number after which the core can only be waiting for the host.
    quiet: u64,
    patience: u64,
}

impl Flow {
    /// No words yet, with room for this many words of answers. After `patience` clocks in which no word passes, the
    /// core can only be waiting for the host.
    pub fn new(room: usize, patience: u64) -> Self {
        Self {
            fifo: VecDeque::new(),
            taken: Crc32::default(),
            has_gap: false,
            answers: Answers::new(room),
            is_busy: false,
            is_ahead: false,
            quiet: 0,
            patience,
        }
    }

    /// Lets words pass between the FIFO, the core and the answers, for this many clocks. Returns the number of clocks
    /// in which there was something to do; in all others nothing changes until a frame comes or goes.
    pub fn pass(&mut self, core: &mut impl WordDevice, clocks: u64) -> u64 {
        for clock in 0..clocks {
            if self.is_stalled(core) {
                return clock;
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
        clocks
    }

    /// Whether the core has nothing to do, or cannot go on before an answer leaves.
    pub fn is_stalled(&self, core: &impl WordDevice) -> bool {
        let is_at_work = self.is_busy || core.owes_answers();
        self.fifo.is_empty() && (!is_at_work || self.quiet > self.patience) || !self.answers.has_room()
    }

    /// Number of bytes in the FIFO.
    pub fn waiting_bytes(&self) -> usize {
        4 * self.fifo.len()
    }

    /// Whether the core has taken a word of a command and the answer has not ended.
    pub fn is_busy(&self) -> bool {
        self.is_busy
    }

    /// Whether a `Data` frame came that must not be taken before another.
    pub fn has_gap(&self) -> bool {
        self.has_gap
    }

    /// Check sum of all words that were taken from the host.
    pub fn taken(&self) -> u32 {
        self.taken.value()
    }

    /// Takes the words of the `Data` frame that was expected.
    pub fn take(&mut self, words: impl IntoIterator<Item = u32>) -> Taken {
        for word in words {
            self.fifo.push_back(word);
            word.to_le_bytes().iter().for_each(|&byte| self.taken.add(byte));
        }
        self.has_gap = false;
        Taken::Here
    }

    /// Refuses a `Data` frame that comes too early, or for which there is no room.
    pub fn refuse(&mut self) -> Taken {
        if std::mem::replace(&mut self.has_gap, true) {
            Taken::NotYetToldBefore
        } else {
            Taken::NotYet
        }
    }

    /// Ends the current answer, whose last word has been sent.
    pub fn end_answer(&mut self) {
        self.answers.end_answer();
        self.is_busy = self.is_ahead || !self.answers.is_quiet();
    }
}
