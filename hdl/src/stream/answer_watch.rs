//! Watches the answer beats that the bus takes, and finds headers with a status other than `Ok`, which
//! the registers then show.
//!
//! Latency: 1 clock from a beat to `events`.

use super::events::AnswerEvents;
use crate::commands::types::Word;
use crate::prelude::*;
use incircle_protocol::{answer_header, Status};

#[derive(LogicBlock, Default)]
pub struct AnswerWatch<const W: usize> {
    /// The bus's clock and reset.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The FIFOs are in reset, so the next beat is the first one of an answer.
    pub resets: Signal<In, Bit>,
    /// The stream of answers, as the bus sees it.
    pub m_axis_tvalid: Signal<In, Bit>,
    pub m_axis_tready: Signal<In, Bit>,
    pub m_axis_tdata: Signal<In, Bits<W>>,
    pub m_axis_tlast: Signal<In, Bit>,
    pub events: Signal<Out, AnswerEvents>,
    /// The bus has taken a beat of the present answer, but not the last one.
    is_inside: DFF<Bit>,
    takes: DFF<Bit>,
    waits: DFF<Bit>,
    ends: DFF<Bit>,
    begins: DFF<Bit>,
    word: DFF<Word>,
    is_taken: Signal<Local, Bit>,
    status: Signal<Local, Bits<8>>,
}

// The kernel holds the place of the status, and `Ok` as 0, as literals. A changed protocol fails here.
const _: () = assert!(
    answer_header(0, Status::Ok) == 0 && answer_header(0, Status::UnknownOpcode) == 1 << 16,
    "the status of an answer is in bits 23 to 16 of its header"
);

impl<const W: usize> Logic for AnswerWatch<W> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, is_inside, takes, waits, ends, begins, word);
        self.is_taken.next = self.m_axis_tvalid.val() & self.m_axis_tready.val();
        self.takes.d.next = self.is_taken.val();
        self.waits.d.next = self.m_axis_tvalid.val() & (!self.m_axis_tready.val());
        self.ends.d.next = self.is_taken.val() & self.m_axis_tlast.val();
        self.begins.d.next = self.is_taken.val() & (!self.is_inside.q.val());
        self.word.d.next = self.m_axis_tdata.val().get_bits::<32>(0);
        if self.is_taken.val() {
            self.is_inside.d.next = !self.m_axis_tlast.val();
        }
        if self.resets.val() {
            self.is_inside.d.next = false;
        }
        if self.reset.val() {
            self.is_inside.d.next = false;
            self.takes.d.next = false;
            self.waits.d.next = false;
            self.ends.d.next = false;
            self.begins.d.next = false;
        }
        self.events.next.took = self.takes.q.val();
        self.events.next.waited = self.waits.q.val();
        self.events.next.ended = self.ends.q.val();
        self.events.next.header = self.word.q.val();
        self.status.next = self.word.q.val().get_bits::<8>(16);
        self.events.next.failed = self.begins.q.val() & self.status.val().any();
    }
}
