//! Runs `AnswerParts` in Rust and in Verilog beside plain code: all three must agree.

use std::collections::VecDeque;

use crate::rig::drawing::{draw, When};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::udp::AnswerParts;
use incircle_testkit::SplitMix64;

named_ports!(
    AnswerParts,
    [reset, word_valid, word_data, starts, takes, ended],
    [word_ready, is_due, is_last, answers, first_index, byte_valid, byte_data, byte_is_last, awaits],
    clock
);

/// Most words of a part.
const PART: usize = 360;

/// A block between a core, which offers words at some pace, and a datagram.
struct Rig {
    block: Stepper<AnswerParts>,
    random: SplitMix64,
    pending: VecDeque<u32>,
    offered: Option<u32>,
    /// The core offers a word in one clock out of this many.
    pace: u64,
}

impl Rig {
    /// Sets the inputs of a clock, of which the block may take the word that is on offer.
    fn settle(&mut self, ports: [(&str, bool); 4]) {
        ports.into_iter().for_each(|(port, bit)| self.block.set(port, bit));
        if self.offered.is_none() && self.random.below(self.pace) == 0 {
            self.offered = self.pending.pop_front();
        }
        self.block.set("word_valid", self.offered.is_some());
        self.block.set("word_data", self.offered.unwrap_or(0xffff_ffff));
        self.block.settle();
    }

    fn edge(&mut self, is_reset: bool) {
        if is_reset {
            (self.offered, self.pending) = (None, VecDeque::new());
        } else if self.block.is("word_ready") {
            self.offered = None;
        }
        self.block.edge();
    }

    fn clock(&mut self, starts: bool, takes: bool, ended: bool) {
        self.settle([("reset", false), ("starts", starts), ("takes", takes), ("ended", ended)]);
        self.edge(false);
    }

    fn reset(&mut self) {
        self.settle([("reset", true), ("starts", false), ("takes", false), ("ended", false)]);
        self.edge(true);
    }

    /// Takes some bytes of a part of this many, each in one clock out of `pace`, and returns them with the number of
    /// clocks.
    fn part(&mut self, some: usize, bytes: usize, pace: u64) -> (Vec<u8>, usize) {
        let (mut taken, begun) = (Vec::new(), self.block.clocks());
        while taken.len() < some {
            self.settle([("reset", false), ("starts", false), ("takes", false), ("ended", false)]);
            let takes = self.block.is("byte_valid") && self.random.below(pace) == 0;
            if takes {
                taken.push(self.block.get("byte_data") as u8);
                self.block.expect("byte_is_last", taken.len() == bytes);
                self.block.set("takes", true);
                self.block.settle();
            }
            self.edge(false);
        }
        (taken, self.block.clocks() - begun)
    }
}

#[test]
fn answers_are_cut_into_parts_with_their_place() {
    let block = Stepper::new("udp_answer_parts", AnswerParts::default(), 1);
    let mut rig = Rig { block, random: SplitMix64::new(5), pending: VecDeque::new(), offered: None, pace: 1 };
    rig.reset();
    let lengths = [0, 1, 2, 357, 358, 359, 360, 717, 718, 719, 1078, 1079, 7];
    let mut number = 0u32;
    for run in 0..3 * lengths.len() {
        let length = lengths[run % lengths.len()];
        rig.pace = [1, 5, 30][run / lengths.len()];
        let mut words = vec![rig.random.below(1 << 32) as u32, length as u32];
        words.extend((0..length).map(|_| rig.random.below(1 << 32) as u32));
        rig.pending.extend(&words);
        let is_cut = run % 11 == 10;
        for (part, expected) in words.chunks(PART).enumerate() {
            while !rig.block.is("is_due") {
                rig.clock(false, false, false);
                rig.settle([("reset", false), ("starts", false), ("takes", false), ("ended", false)]);
            }
            for _ in 0..rig.random.below(9) {
                rig.clock(false, false, false);
            }
            rig.settle([("reset", false), ("starts", true), ("takes", false), ("ended", false)]);
            rig.block.expect("is_due", true);
            rig.block.expect("is_last", (part + 1) * PART >= words.len());
            rig.block.expect("answers", number);
            rig.block.expect("first_index", (part * PART) as u128);
            rig.edge(false);
            rig.block.settle();
            rig.block.expect("first_index", (part * PART) as u128);
            let bytes: Vec<u8> = expected.iter().flat_map(|word| word.to_le_bytes()).collect();
            let pace = [1, 1, 3][run % 3];
            if is_cut {
                rig.part(2, bytes.len(), 1);
                break;
            }
            let (taken, clocks) = rig.part(bytes.len(), bytes.len(), pace);
            assert!(taken == bytes, "part {part} of {length} words");
            assert!(rig.pace > 1 || pace > 1 || clocks == bytes.len(), "{clocks} clocks for {} bytes", bytes.len());
        }
        if is_cut {
            rig.reset();
            number = 0;
            continue;
        }
        for _ in 0..3 + rig.random.below(9) {
            rig.settle([("reset", false), ("starts", false), ("takes", false), ("ended", false)]);
            assert!(!rig.block.is("byte_valid") && !rig.block.is("is_due") && !rig.block.is("awaits"));
            rig.edge(false);
        }
        rig.clock(false, false, true);
        number += 1;
        rig.block.settle();
        rig.block.expect("answers", number);
        rig.block.expect("awaits", true);
    }
}

#[test]
fn wave_of_an_answer_of_three_words() {
    let mut stimuli = vec![(6, "starts", 1), (20, "ended", 1)];
    // A head, the length 1, and a word. Each stays until it is taken.
    for (word, clocks) in [(0x0403_0201u128, 0..1), (1, 1..11), (0x0c0b_0a09, 11..15)] {
        stimuli.extend(clocks.flat_map(|clock| [(clock, "word_valid", 1), (clock, "word_data", word)]));
    }
    stimuli.extend((7..19).map(|clock| (clock, "takes", 1)));
    let lanes = [
        ("word_valid", "word_valid", 0, 1, When::Always),
        ("word_ready", "word_ready", 0, 1, When::If("word_valid")),
        ("is_due", "is_due", 0, 1, When::Always),
        ("is_last", "is_last", 0, 1, When::If("is_due")),
        ("starts", "starts", 0, 1, When::Always),
        ("takes", "takes", 0, 1, When::Always),
        ("byte_valid", "byte_valid", 0, 1, When::Always),
        ("byte_data", "byte_data", 0, 8, When::If("byte_valid")),
        ("byte_is_last", "byte_is_last", 0, 1, When::If("byte_valid")),
        ("ended", "ended", 0, 1, When::Always),
        ("awaits", "awaits", 0, 1, When::Always),
    ];
    draw("udp_answer_parts", AnswerParts::default(), &stimuli, 22, &lanes).assert_drawn_in("answer_parts");
}
