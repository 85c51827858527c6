//! A stand-in for the core at its two streams.

use std::collections::VecDeque;

use incircle_testkit::SplitMix64;

use super::Pins;

/// Makes a command of the stand-in: opcode in bits 31 to 24, status of the answer in bits 23 to 16, number of argument
/// words in bits 15 to 12, words of the answer's payload in bits 11 to 0. The word 0 is padding.
pub fn command(opcode: u32, status: u32, arguments: u32, length: u32) -> u32 {
    assert!(opcode > 0 && opcode < 256 && status < 256 && arguments < 16 && length < 4096);
    opcode << 24 | status << 16 | arguments << 12 | length
}

/// Answer of the stand-in to a command and its arguments.
pub fn answer(words: &[u32]) -> Vec<u32> {
    let length = words[0] & 0xfff;
    let sum = words.iter().fold(0, |sum: u32, word| sum.rotate_left(5) ^ word);
    let payload = (0..length).map(|index| if index % 5 == 3 { 0 } else { sum.wrapping_mul(index | 1) });
    [words[0] >> 16 << 16, length].into_iter().chain(payload).collect()
}

/// The core's side of the streams, with a pace of its own.
pub struct StandIn {
    pub pace: u64,
    /// True while the stand-in takes no command word.
    pub sleeps: bool,
    random: SplitMix64,
    taken: Vec<u32>,
    answer: VecDeque<u32>,
    offered: Vec<u32>,
    is_ready: bool,
    pub resets: usize,
    before: Option<u128>,
}

impl StandIn {
    pub fn new(seed: u64) -> Self {
        Self {
            pace: 1,
            sleeps: false,
            random: SplitMix64::new(seed),
            taken: Vec::new(),
            answer: VecDeque::new(),
            offered: Vec::new(),
            is_ready: false,
            resets: 0,
            before: None,
        }
    }

    /// Forgets the last clock: the ports may be in their first reset, when their values do not count.
    pub fn lose_track(&mut self) {
        self.before = None;
    }

    pub fn before_edge(&mut self, pins: &mut impl Pins) {
        let valid = pins.get("command_valid") == 1;
        // Without a valid word the port may show anything.
        let word = if valid { pins.get("command_data") } else { 0 };
        if pins.get("core_reset") == 1 {
            self.resets += 1;
            self.taken.clear();
            self.answer.clear();
            self.offered.clear();
            self.before = None;
            return;
        }
        assert!(self.before.is_none_or(|before| valid && word == before), "a command word moved");
        self.before = (valid && !self.is_ready).then_some(word);
        if !self.offered.is_empty() && pins.get("response_ready") == 1 {
            self.offered.clear();
        }
        if valid && self.is_ready && (word != 0 || !self.taken.is_empty()) {
            self.taken.push(word as u32);
        }
        let is_complete = self.taken.first().is_some_and(|first| self.taken.len() > (first >> 12 & 15) as usize);
        if is_complete && self.answer.is_empty() && self.offered.is_empty() {
            self.answer = answer(&self.taken).into();
            self.taken.clear();
        }
    }

    pub fn after_edge(&mut self, pins: &mut impl Pins) {
        if self.offered.is_empty() && !self.answer.is_empty() && self.random.below(self.pace) == 0 {
            let words = 1 + self.random.below(2) as usize;
            self.offered = self.answer.drain(..words.min(self.answer.len())).collect();
        }
        // The stand-in takes no word of the next command before it has offered the last word of this answer.
        let is_complete = self.taken.first().is_some_and(|first| self.taken.len() > (first >> 12 & 15) as usize);
        let may_take = self.answer.is_empty() && !is_complete;
        self.is_ready = may_take && !self.sleeps && self.random.below(self.pace) == 0;
        let word = |place: usize| self.offered.get(place).copied();
        let junk = self.random.next_u64() as u32;
        let data = u128::from(word(0).unwrap_or(junk)) | u128::from(word(1).unwrap_or(junk)) << 32;
        for (port, value) in [
            ("command_ready", u128::from(self.is_ready)),
            ("response_valid", (!self.offered.is_empty()).into()),
            ("response_data", data),
            ("response_both", (self.offered.len() == 2).into()),
            ("response_last", (!self.offered.is_empty() && self.answer.is_empty()).into()),
            ("device_busy", false.into()),
        ] {
            pins.set(port, value);
        }
    }
}
