//! Joins pairs of answer words to beats of the bus, and begins each answer with a new beat, so that no
//! two answers share one.
//!
//! 1. A beat on offer stays while `is_full` is high.
//! 2. The part of an answer's last beat that the answer leaves free is 0.
//! 3. `is_stalled` depends on a register and on `is_full` only.
//!
//! Latency: 1 clock from the last pair of a beat.

use crate::leaf::Parameter;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct AnswerBeats<const W: usize> {
    /// The core's clock; a reset forgets all pairs.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// A pair of answer words; `pair_last` marks the last pair of an answer.
    pub pair_valid: Signal<In, Bit>,
    pub pair_data: Signal<In, Bits<64>>,
    pub pair_last: Signal<In, Bit>,
    /// No pair is taken at this edge.
    pub is_stalled: Signal<Out, Bit>,
    /// A beat for the FIFO; `beat_last` marks the last beat of an answer.
    pub beat_valid: Signal<Out, Bit>,
    pub beat_data: Signal<Out, Bits<W>>,
    pub beat_last: Signal<Out, Bit>,
    /// The FIFO does not take the beat at this edge.
    pub is_full: Signal<In, Bit>,
    /// The block holds at least one pair.
    pub is_held: Signal<Out, Bit>,
    beat: DFF<Bits<W>>,
    /// The first pair of a beat of two pairs is held.
    is_half: DFF<Bit>,
    is_offered: DFF<Bit>,
    is_last: DFF<Bit>,
    is_free: Signal<Local, Bit>,
    takes: Signal<Local, Bit>,
    completes: Signal<Local, Bit>,
    low: Signal<Local, Bits<W>>,
    high: Signal<Local, Bits<W>>,
    pair_bits: Parameter<Bits<8>>,
    /// A beat holds one pair only.
    is_narrow: Parameter<Bit>,
}

impl<const W: usize> AnswerBeats<W> {
    /// The block for beats of W bits.
    ///
    /// # Panics
    /// If W is not 64 or 128.
    pub fn new() -> Self {
        assert!(W == 64 || W == 128, "a beat has 64 or 128 bits, not {W}");
        Self {
            // A beat of 64 bits has no second pair, so nothing is shifted.
            pair_bits: Parameter::new(Bits::from(W as u64 - 64)),
            is_narrow: Parameter::new(W == 64),
            ..Self::default()
        }
    }
}

impl<const W: usize> Logic for AnswerBeats<W> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, beat, is_half, is_offered, is_last);
        self.beat_valid.next = self.is_offered.q.val();
        self.beat_data.next = self.beat.q.val();
        self.beat_last.next = self.is_last.q.val();
        self.is_held.next = self.is_offered.q.val() | self.is_half.q.val();
        self.is_free.next = !(self.is_offered.q.val() & self.is_full.val());
        self.is_stalled.next = !self.is_free.val();
        self.takes.next = self.pair_valid.val() & self.is_free.val();
        self.completes.next = self.pair_last.val() | self.is_half.q.val() | self.is_narrow.val();
        self.low.next = bit_cast::<W, 64>(self.pair_data.val());
        self.high.next = self.low.val() << self.pair_bits.val();
        if self.is_free.val() {
            self.is_offered.d.next = false;
        }
        if self.takes.val() {
            self.beat.d.next = self.low.val();
            if self.is_half.q.val() & (!self.is_narrow.val()) {
                self.beat.d.next = self.beat.q.val() | self.high.val();
            }
            self.is_offered.d.next = self.completes.val();
            self.is_half.d.next = !self.completes.val();
            self.is_last.d.next = self.pair_last.val();
        }
        if self.reset.val() {
            self.is_half.d.next = false;
            self.is_offered.d.next = false;
        }
    }
}
