//! Pairs of answer words as beats; each answer begins with a new beat.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | the core's clock; reset forgets all pairs |
//! | `pair_valid`, `pair_data`, `pair_last` | in | 1, 64, 1 | a pair; the last one of its answer |
//! | `is_stalled` | out | 1 | no pair is taken at this edge |
//! | `beat_valid`, `beat_data`, `beat_last` | out | 1, W, 1 | a beat; the last one of its answer |
//! | `is_full` | in | 1 | it is not taken at this edge |
//! | `is_held` | out | 1 | pairs are held |
//!
//! 1. A beat that is offered stays while `is_full`.
//! 2. What an answer leaves of its last beat is 0.
//! 3. `is_stalled` is a function of a register and `is_full`.
//!
//! Latency: 1 clock from the last pair of a beat.

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Beats of answers; see the top of this file.
#[derive(LogicBlock)]
pub struct AnswerBeats<const W: usize> {
    /// Clock of the core.
    pub clock: Signal<In, Clock>,
    /// Forgets all pairs.
    pub reset: Signal<In, Bit>,
    /// A pair is there.
    pub pair_valid: Signal<In, Bit>,
    /// It.
    pub pair_data: Signal<In, Bits<64>>,
    /// The last one of its answer.
    pub pair_last: Signal<In, Bit>,
    /// No pair is taken.
    pub is_stalled: Signal<Out, Bit>,
    /// A beat is offered.
    pub beat_valid: Signal<Out, Bit>,
    /// It.
    pub beat_data: Signal<Out, Bits<W>>,
    /// The last one of its answer.
    pub beat_last: Signal<Out, Bit>,
    /// It is not taken.
    pub is_full: Signal<In, Bit>,
    /// Pairs are held.
    pub is_held: Signal<Out, Bit>,
    beat: DFF<Bits<W>>,
    /// The first half of a beat of two pairs is held.
    is_half: DFF<Bit>,
    is_offered: DFF<Bit>,
    is_last: DFF<Bit>,
    is_free: Signal<Local, Bit>,
    takes: Signal<Local, Bit>,
    completes: Signal<Local, Bit>,
    low: Signal<Local, Bits<W>>,
    high: Signal<Local, Bits<W>>,
    pair_bits: Constant<Bits<8>>,
    /// A beat is one pair.
    is_narrow: Constant<Bit>,
}

impl<const W: usize> Default for AnswerBeats<W> {
    fn default() -> Self {
        assert!(W == 64 || W == 128, "a beat has 64 or 128 bits, not {W}");
        Self {
            clock: Signal::default(),
            reset: Signal::default(),
            pair_valid: Signal::default(),
            pair_data: Signal::default(),
            pair_last: Signal::default(),
            is_stalled: Signal::default(),
            beat_valid: Signal::default(),
            beat_data: Signal::default(),
            beat_last: Signal::default(),
            is_full: Signal::default(),
            is_held: Signal::default(),
            beat: DFF::default(),
            is_half: DFF::default(),
            is_offered: DFF::default(),
            is_last: DFF::default(),
            is_free: Signal::default(),
            takes: Signal::default(),
            completes: Signal::default(),
            low: Signal::default(),
            high: Signal::default(),
            // In a beat of one pair there is no second one to shift.
            pair_bits: Constant::new(Bits::from(W as u64 - 64)),
            is_narrow: Constant::new(W == 64),
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
