//! Splits beats into the words of the core's command stream, the lowest word first.
//!
//! 1. A word on offer stays until the core takes it. `command_valid` and `command_data` are registers.
//! 2. The next beat is taken at the edge that takes the last word of the beat before, so a word can
//!    pass at every clock.
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

use crate::commands::CommandSource;
use crate::leaf::Parameter;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct BeatWords<const W: usize> {
    /// The core's clock; a reset forgets the words of a beat.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// A beat of commands; the block takes the beat at the edge at which `takes` is high.
    pub beat_valid: Signal<In, Bit>,
    pub beat_data: Signal<In, Bits<W>>,
    pub takes: Signal<Out, Bit>,
    pub command: CommandSource,
    /// The block holds at least one word.
    pub is_held: Signal<Out, Bit>,
    words: DFF<Bits<W>>,
    /// Number of words held; the first of them is on offer.
    left: DFF<Bits<3>>,
    holds: DFF<Bit>,
    is_last: DFF<Bit>,
    moves: Signal<Local, Bit>,
    loads: Signal<Local, Bit>,
    after: Signal<Local, Bits<3>>,
    later: Signal<Local, Bits<W>>,
    one: Parameter<Bits<3>>,
    two: Parameter<Bits<3>>,
    all: Parameter<Bits<3>>,
    word_bits: Parameter<Bits<8>>,
}

impl<const W: usize> BeatWords<W> {
    /// The block for beats of W bits.
    ///
    /// # Panics
    /// If W is not 64 or 128.
    pub fn new() -> Self {
        assert!(W == 64 || W == 128, "a beat has 64 or 128 bits, not {W}");
        Self {
            one: Parameter::new(Bits::from(1)),
            two: Parameter::new(Bits::from(2)),
            all: Parameter::new(Bits::from(W as u64 / 32)),
            word_bits: Parameter::new(Bits::from(32)),
            ..Self::default()
        }
    }
}

impl<const W: usize> Logic for BeatWords<W> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, words, left, holds, is_last);
        self.command.valid.next = self.holds.q.val();
        self.command.data.next = self.words.q.val().get_bits::<32>(0);
        self.is_held.next = self.holds.q.val();
        self.moves.next = self.holds.q.val() & self.command.ready.val();
        self.loads.next =
            self.beat_valid.val() & ((!self.holds.q.val()) | (self.is_last.q.val() & self.command.ready.val()));
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
