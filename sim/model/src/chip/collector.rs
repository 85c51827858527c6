//! Brings the answers of the engines together, each of them whole.
//!
//! Hardware twin: the block `AnswerCollector`.

use super::places::{in_turn, MOST};
use crate::clock::Outputs;
use incircle_protocol::{answer_status, Status};

/// The outputs of all engines.
pub(super) type Offers = [Outputs; MOST];

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Collector {
    /// Whether an answer passes, and whether its first beat is still to pass.
    is_active: bool,
    is_first: bool,
    /// The engine whose answer passes, or passed last.
    chosen: usize,
    /// The engine whose answer is next, as of the clock before, if no answer passed then.
    next: Option<usize>,
    stuck: [bool; MOST],
}

impl Collector {
    /// Whether the engine has said `Stuck`.
    pub(super) fn is_stuck(&self, engine: usize) -> bool {
        self.stuck[engine]
    }

    /// Whether the answer of this engine passes.
    pub(super) fn is_chosen(&self, engine: usize) -> bool {
        self.is_active && self.chosen == engine
    }

    /// The answer words of the chip. The data are those of the engine that passed last, whether or not they are valid.
    pub(super) fn outputs(&self, offers: &Offers) -> Outputs {
        let offer = offers[self.chosen];
        Outputs { response_valid: self.is_active && offer.response_valid, ..offer }
    }

    /// The engine of which a beat is taken at this edge.
    pub(super) fn takes(&self, offers: &Offers, response_ready: bool) -> Option<usize> {
        (self.outputs(offers).response_valid && response_ready).then_some(self.chosen)
    }

    /// Simulates one clock, in which a beat of the engine `takes` is taken.
    pub(super) fn clock(&mut self, offers: &Offers, takes: Option<usize>) {
        let next = in_turn(self.chosen).find(|&engine| offers[engine].response_valid).filter(|_| !self.is_active);
        let chosen = std::mem::replace(&mut self.next, next);
        if let (false, Some(chosen)) = (self.is_active, chosen) {
            (self.is_active, self.is_first, self.chosen) = (true, true, chosen);
        }
        let Some(engine) = takes else {
            return;
        };
        if self.is_first && answer_status(offers[engine].response_data as u32) == Status::Stuck as u8 {
            self.stuck[engine] = true;
        }
        self.is_first = false;
        self.is_active = !offers[engine].response_last;
    }
}
