//! The words of a part of an answer, two at a time.
//!
//! 1. Beat 0 has outcome and number of the item, and the first vertex. With the outcome `Full` (8), the vertex is any
//!    word, and stands in `w0`.
//! 2. Beat 1, which only the parts of `Locate` and `Interpolate` have, has the other two vertices. Beats 2 to 4, which
//!    only the parts of `Interpolate` have, each have a weight: its low word, and its high word, which is 0.
//!
//! Latency: none, the block is combinational.

use super::types::{BeatNumber, Finding, Part};
use crate::commands::types::Word;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct PartBeat {
    pub part: Signal<In, Part>,
    /// Number of the beat in the part.
    pub beat: Signal<In, BeatNumber>,
    pub low: Signal<Out, Word>,
    pub high: Signal<Out, Word>,
    finding: Signal<Local, Finding>,
    wide_outcome: Signal<Local, Word>,
    shifted_outcome: Signal<Local, Word>,
    wide_number: Signal<Local, Word>,
    outcome_shift: Signal<Local, Word>,
    first: Signal<Local, BeatNumber>,
    second: Signal<Local, BeatNumber>,
    third: Signal<Local, BeatNumber>,
    fourth: Signal<Local, BeatNumber>,
    full_outcome: Signal<Local, Bits<4>>,
    missing_outcome: Signal<Local, Bits<4>>,
}

// The kernel holds the numbers as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    incircle_protocol::OUTCOME_SHIFT == 24
        && incircle_protocol::RunKind::Interpolate.part_words() == 10
        && incircle_protocol::Outcome::Missing as u8 == 6
        && incircle_protocol::Outcome::Full as u8 == 8,
    "the words of this block follow the protocol"
);

impl Logic for PartBeat {
    #[hdl_gen]
    fn update(&mut self) {
        self.outcome_shift.next = 24.into();
        self.first.next = 0.into();
        self.second.next = 1.into();
        self.third.next = 2.into();
        self.fourth.next = 3.into();
        self.full_outcome.next = 8.into();
        self.missing_outcome.next = 6.into();
        self.finding.next = self.part.val().finding;
        self.wide_outcome.next = bit_cast::<32, 4>(self.finding.val().outcome);
        self.shifted_outcome.next = self.wide_outcome.val() << self.outcome_shift.val();
        self.wide_number.next = bit_cast::<32, 24>(self.part.val().number);
        self.low.next = self.finding.val().w2;
        self.high.next = 0.into();
        if self.beat.val() == self.first.val() {
            self.low.next = self.shifted_outcome.val() | self.wide_number.val();
            self.high.next = bit_cast::<32, 15>(self.finding.val().v0);
            if (self.finding.val().outcome == self.full_outcome.val())
                | (self.finding.val().outcome == self.missing_outcome.val())
            {
                self.high.next = self.finding.val().w0;
            }
        }
        if self.beat.val() == self.second.val() {
            self.low.next = bit_cast::<32, 15>(self.finding.val().v1);
            self.high.next = bit_cast::<32, 15>(self.finding.val().v2);
        }
        if self.beat.val() == self.third.val() {
            self.low.next = self.finding.val().w0;
        }
        if self.beat.val() == self.fourth.val() {
            self.low.next = self.finding.val().w1;
        }
    }
}
