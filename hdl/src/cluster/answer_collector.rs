//! Brings the answers of the engines together, each of them whole, and notes which engines have said `Stuck`.
//!
//! 1. While no answer passes, the next one is that of the first engine in turn that offers a word.
//! 2. No output depends on an input within a clock, except that the answer follows the beat of the chosen engine, which
//!    is a register of that engine, and that `takes` follows `response_ready`.
//! 3. `stuck` is set when the first beat of an answer with the status `Stuck` is taken, and stays until a reset.
//!
//! Latency: 2 clocks from a word on offer to the stream. Two clocks pass between two answers, because the choice is
//! made only while no answer passes: while the last beat passes, its engine would seem to offer another answer.

use super::engine_choice::EngineChoice;
use super::types::{EngineFlags, OfferedBeat};
use crate::commands::AnswerSource;
use crate::prelude::*;
use incircle_protocol::{answer_header, Status};

#[derive(LogicBlock, Default)]
pub struct AnswerCollector {
    pub clock: Signal<In, Clock>,
    /// After a reset no answer passes, and no engine counts as stuck.
    pub reset: Signal<In, Bit>,
    /// For each engine: it offers a beat (`offers`); the beat; the beat on offer is taken at this edge (`takes`).
    pub offers: Signal<In, EngineFlags>,
    pub beat0: Signal<In, OfferedBeat>,
    pub beat1: Signal<In, OfferedBeat>,
    pub beat2: Signal<In, OfferedBeat>,
    pub beat3: Signal<In, OfferedBeat>,
    pub takes: Signal<Out, EngineFlags>,
    pub response: AnswerSource,
    pub stuck: Signal<Out, EngineFlags>,
    is_active: DFF<Bit>,
    /// The first beat of the answer is still to pass.
    is_first: DFF<Bit>,
    /// The engine whose answer passes, or passed last.
    chosen: DFF<Bits<2>>,
    said: DFF<EngineFlags>,
    choice: EngineChoice,
    is_idle: Signal<Local, Bit>,
    none: Signal<Local, EngineFlags>,
    valid: Signal<Local, Bit>,
    beat: Signal<Local, OfferedBeat>,
    data: Signal<Local, Bits<64>>,
    passes: Signal<Local, Bit>,
    is_taken: Signal<Local, Bit>,
    status: Signal<Local, Bits<8>>,
    says_stuck: Signal<Local, Bit>,
    stuck_code: Signal<Local, Bits<8>>,
    number0: Signal<Local, Bits<2>>,
    number1: Signal<Local, Bits<2>>,
    number2: Signal<Local, Bits<2>>,
    number3: Signal<Local, Bits<2>>,
}

// The kernel holds the place and the value of the status as literals. A changed protocol fails here.
const _: () = assert!(
    answer_header(0, Status::Stuck) == 6 << 16,
    "the status of an answer is in bits 23 to 16 of its header, and `Stuck` is 6"
);

impl Logic for AnswerCollector {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_active, is_first, chosen, said);
        clock!(self, clock, choice);
        self.number0.next = 0.into();
        self.number1.next = 1.into();
        self.number2.next = 2.into();
        self.number3.next = 3.into();
        self.stuck_code.next = 6.into();
        self.stuck.next = self.said.q.val();
        self.is_idle.next = !self.is_active.q.val();
        self.none.next.engine0 = false;
        self.none.next.engine1 = false;
        self.none.next.engine2 = false;
        self.none.next.engine3 = false;
        self.choice.reset.next = self.reset.val();
        self.choice.current.next = self.chosen.q.val();
        self.choice.free.next.engine0 = self.is_idle.val() & self.offers.val().engine0;
        self.choice.free.next.engine1 = self.is_idle.val() & self.offers.val().engine1;
        self.choice.free.next.engine2 = self.is_idle.val() & self.offers.val().engine2;
        self.choice.free.next.engine3 = self.is_idle.val() & self.offers.val().engine3;
        self.choice.stuck.next = self.none.val();

        self.valid.next = self.offers.val().engine3;
        self.beat.next = self.beat3.val();
        match self.chosen.q.val().index() {
            0 => {
                self.valid.next = self.offers.val().engine0;
                self.beat.next = self.beat0.val();
            }
            1 => {
                self.valid.next = self.offers.val().engine1;
                self.beat.next = self.beat1.val();
            }
            2 => {
                self.valid.next = self.offers.val().engine2;
                self.beat.next = self.beat2.val();
            }
            _ => {}
        }
        self.response.valid.next = self.is_active.q.val() & self.valid.val();
        self.data.next = self.beat.val().data;
        self.response.data.next = self.data.val();
        self.response.both.next = self.beat.val().both;
        self.response.last.next = self.beat.val().last;
        self.passes.next = self.is_active.q.val() & self.response.ready.val();
        self.takes.next.engine0 = self.passes.val() & (self.chosen.q.val() == self.number0.val());
        self.takes.next.engine1 = self.passes.val() & (self.chosen.q.val() == self.number1.val());
        self.takes.next.engine2 = self.passes.val() & (self.chosen.q.val() == self.number2.val());
        self.takes.next.engine3 = self.passes.val() & (self.chosen.q.val() == self.number3.val());

        self.is_taken.next = self.passes.val() & self.valid.val();
        self.status.next = self.data.val().get_bits::<8>(16);
        self.says_stuck.next =
            self.is_taken.val() & self.is_first.q.val() & (self.status.val() == self.stuck_code.val());
        if self.says_stuck.val() {
            match self.chosen.q.val().index() {
                0 => {
                    self.said.d.next.engine0 = true;
                }
                1 => {
                    self.said.d.next.engine1 = true;
                }
                2 => {
                    self.said.d.next.engine2 = true;
                }
                _ => {
                    self.said.d.next.engine3 = true;
                }
            }
        }
        if self.is_taken.val() {
            self.is_first.d.next = false;
            self.is_active.d.next = !self.beat.val().last;
        }
        if self.is_idle.val() & self.choice.has_target.val() {
            self.is_active.d.next = true;
            self.is_first.d.next = true;
            self.chosen.d.next = self.choice.target.val();
        }
        if self.reset.val() {
            self.is_active.d.next = false;
            self.chosen.d.next = self.number0.val();
            self.said.d.next = self.none.val();
        }
    }
}
