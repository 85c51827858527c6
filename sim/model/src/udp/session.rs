//! A session of the UDP link: its host, numbers of datagrams, words on their way to the core, and answers on their way
//! to the host.

use std::collections::VecDeque;
use std::net::SocketAddrV4;

use incircle_protocol::PADDING;

use super::answers::{Answers, Part};
use crate::serial::{Crc32, WordDevice};

/// The outcome for a `Data` datagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Taken {
    /// The datagram was expected, and its words are in the FIFO.
    Here,
    /// The datagram was already taken.
    Before,
    /// Another datagram must come first, or there is no room.
    NotYet,
    /// Another datagram must come first, or there is no room, and the host has been told since the last one was taken.
    NotYetToldBefore,
}

/// The open session of a device.
#[derive(Clone, Debug)]
pub(super) struct Session {
    pub(super) number: u64,
    /// Address and port of the host.
    pub(super) host: SocketAddrV4,
    /// Number of the `Data` datagram that is expected next.
    pub(super) expected: u32,
    /// Check sum of all words that were taken.
    pub(super) taken: Crc32,
    /// Whether a `Data` datagram came that must not be taken before another.
    pub(super) has_gap: bool,
    /// Words that the core has not taken.
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
    pub(super) fn new(number: u64, host: SocketAddrV4, patience: u64) -> Self {
        Self {
            number,
            host,
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

    /// Lets words pass between the FIFO, the core and the answers, for this many clocks. Returns the number of clocks
    /// in which there was something to do; in all others nothing changes until a datagram comes or goes.
    pub(super) fn pass(&mut self, core: &mut impl WordDevice, clocks: u64) -> u64 {
        for clock in 0..clocks {
            if self.is_stalled() {
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
    pub(super) fn is_stalled(&self) -> bool {
        self.fifo.is_empty() && (!self.is_busy || self.quiet > self.patience) || !self.answers.has_room()
    }

    /// Number of bytes in the FIFO.
    pub(super) fn waiting_bytes(&self) -> usize {
        4 * self.fifo.len()
    }

    /// The part of an answer that is due.
    pub(super) fn next_part(&mut self) -> Option<Part> {
        let part = self.answers.next_part()?;
        if part.digest.is_some() {
            self.is_busy = self.is_ahead || !self.answers.is_quiet();
        }
        Some(part)
    }

    /// Takes a `Data` datagram of this session, if it is the expected one and there is room.
    pub(super) fn take_data(&mut self, number: u32, words: &[u32], fifo_bytes: u32) -> Taken {
        let has_room = self.waiting_bytes() + 4 * words.len() <= fifo_bytes as usize;
        if number == self.expected && has_room {
            self.fifo.extend(words);
            words.iter().flat_map(|word| word.to_le_bytes()).for_each(|byte| self.taken.add(byte));
            self.expected = self.expected.wrapping_add(1);
            self.has_gap = false;
            return Taken::Here;
        }
        if number < self.expected {
            return Taken::Before;
        }
        if std::mem::replace(&mut self.has_gap, true) {
            Taken::NotYetToldBefore
        } else {
            Taken::NotYet
        }
    }
}
