//! Beats as the words of the core's command stream, little end first.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | the core's clock; reset forgets the words of a beat |
//! | `beat_valid`, `beat_data`, `takes` | in, in, out | 1, W, 1 | a beat; it is taken at this edge |
//! | `command_valid`, `command_ready`, `command_data` | out, in, out | 1, 1, 32 | the command stream |
//! | `is_held` | out | 1 | words of a beat are held |
//!
//! 1. A word once offered stays until it is taken. `command_valid` and `command_data` are registers.
//! 2. With the last word of a beat taken, the next beat is taken at the same edge: a word at every clock.
//!
//! Latency: 1 clock from a beat to its first word.
//!
//! Two beats of two words, the second of which has to wait:
//! ```text
//! beat_valid      ___/^^^^^^^^^^^\___________
//! takes           ___/^^\_____/^^\___________
//! command_valid   ______/^^^^^^^^^^^^^^\_____
//! command_ready   /^^^^^^^^\__/^^^^^^^^^^^^^^
//! command_data      .  .  1  2  2  3  4  .  .
//! ```

use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Words of beats; see the top of this file.
#[derive(LogicBlock)]
pub struct BeatWords<const W: usize> {
    /// Clock of the core.
    pub clock: Signal<In, Clock>,
    /// Forgets the words of a beat.
    pub reset: Signal<In, Bit>,
    /// A beat is there.
    pub beat_valid: Signal<In, Bit>,
    /// It.
    pub beat_data: Signal<In, Bits<W>>,
    /// It is taken.
    pub takes: Signal<Out, Bit>,
    /// A word is offered.
    pub command_valid: Signal<Out, Bit>,
    /// It is taken.
    pub command_ready: Signal<In, Bit>,
    /// The word.
    pub command_data: Signal<Out, Bits<32>>,
    /// Words are held.
    pub is_held: Signal<Out, Bit>,
    words: DFF<Bits<W>>,
    /// Words that are held; the first one is on the output.
    left: DFF<Bits<3>>,
    holds: DFF<Bit>,
    is_last: DFF<Bit>,
    moves: Signal<Local, Bit>,
    loads: Signal<Local, Bit>,
    after: Signal<Local, Bits<3>>,
    later: Signal<Local, Bits<W>>,
    one: Constant<Bits<3>>,
    two: Constant<Bits<3>>,
    all: Constant<Bits<3>>,
    word_bits: Constant<Bits<8>>,
}

impl<const W: usize> Default for BeatWords<W> {
    fn default() -> Self {
        assert!(W == 64 || W == 128, "a beat has 64 or 128 bits, not {W}");
        Self {
            clock: Signal::default(),
            reset: Signal::default(),
            beat_valid: Signal::default(),
            beat_data: Signal::default(),
            takes: Signal::default(),
            command_valid: Signal::default(),
            command_ready: Signal::default(),
            command_data: Signal::default(),
            is_held: Signal::default(),
            words: DFF::default(),
            left: DFF::default(),
            holds: DFF::default(),
            is_last: DFF::default(),
            moves: Signal::default(),
            loads: Signal::default(),
            after: Signal::default(),
            later: Signal::default(),
            one: Constant::new(Bits::from(1)),
            two: Constant::new(Bits::from(2)),
            all: Constant::new(Bits::from(W as u64 / 32)),
            word_bits: Constant::new(Bits::from(32)),
        }
    }
}

impl<const W: usize> Logic for BeatWords<W> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, words, left, holds, is_last);
        self.command_valid.next = self.holds.q.val();
        self.command_data.next = self.words.q.val().get_bits::<32>(0);
        self.is_held.next = self.holds.q.val();
        self.moves.next = self.holds.q.val() & self.command_ready.val();
        self.loads.next =
            self.beat_valid.val() & ((!self.holds.q.val()) | (self.is_last.q.val() & self.command_ready.val()));
        self.takes.next = self.loads.val();
        self.after.next = self.left.q.val() - self.one.val();
        self.later.next = self.words.q.val() >> self.word_bits.val();
        if self.moves.val() {
            self.words.d.next = self.later.val();
            self.left.d.next = self.after.val();
            self.is_last.d.next = self.left.q.val() == self.two.val();
            self.holds.d.next = !self.is_last.q.val();
        }
        if self.loads.val() {
            self.words.d.next = self.beat_data.val();
            self.left.d.next = self.all.val();
            self.is_last.d.next = false;
            self.holds.d.next = true;
        }
        if self.reset.val() {
            self.holds.d.next = false;
        }
    }
}
