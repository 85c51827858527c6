//! A buffer between two clocks.
//!
//! 1. P is the number of bits of a pointer: there is room for `2^(P-1)` entries, and two more in the read port.
//! 2. `pop` only while `valid`. Without it `valid` and `data` stay.
//! 3. `is_full`, `valid` and `data` are registers, `is_fetched` and `is_empty` functions of registers. Each belongs to its own side's clock.
//! 4. Both resets are held together, for so long that each side has seen the other's pointer at 0: three clocks of either. In a reset
//!    `is_full` is 1 and `valid` is 0.
//!
//! Latency: from the edge that takes an entry five edges of `read_clock` to `valid`, and where that edge and one of `read_clock` fall together
//! perhaps one more. An entry passes at every clock of the slower side.
//!
//! Pointers count in Gray code and pass through a [`Synchroniser`]; they are all that crosses but for the words in the memory,
//! which stand there for two clocks of the reader before it hears of them:
//! ```text
//! push -> write_count, write_gray --------> write_seen -> empty -> read_count -> fetched -> shown -> valid
//!   |       full <- read_seen <------------ read_gray <---------------+             |         |
//!   +-> memory (2^(P-1) words) ---------------------------------------------> array --> output --> data
//! ```
//! Source: C. E. Cummings, Simulation and Synthesis Techniques for Asynchronous FIFO Design, SNUG 2002, style 1.

use crate::leaf::{DualClockMemory, Parameter, Synchroniser};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// A buffer between two clocks; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct AsyncFifo<const P: usize, const D: usize> {
    /// The writer's side: clock, and reset, which empties it.
    pub write_clock: Signal<In, Clock>,
    pub write_reset: Signal<In, Bit>,
    /// An entry; it is taken where `push` and not `is_full`.
    pub push: Signal<In, Bit>,
    pub push_data: Signal<In, Bits<D>>,
    pub is_full: Signal<Out, Bit>,
    /// The reader has fetched all that was taken, as far as the writer knows.
    pub is_fetched: Signal<Out, Bit>,
    /// The reader's side.
    pub read_clock: Signal<In, Clock>,
    pub read_reset: Signal<In, Bit>,
    /// There is an entry; it; it is removed at this edge.
    pub valid: Signal<Out, Bit>,
    pub data: Signal<Out, Bits<D>>,
    pub pop: Signal<In, Bit>,
    /// The reader knows of no entry that has not been popped.
    pub is_empty: Signal<Out, Bit>,
    memory: DualClockMemory<P, D>,
    read_seen: Synchroniser<Bits<P>>,
    write_seen: Synchroniser<Bits<P>>,
    write_count: DFF<Bits<P>>,
    write_gray: DFF<Bits<P>>,
    full: DFF<Bit>,
    read_count: DFF<Bits<P>>,
    read_gray: DFF<Bits<P>>,
    /// Nothing is left in the memory to fetch.
    empty: DFF<Bit>,
    /// An entry stands in the array's register, one in the output register.
    fetched: DFF<Bit>,
    shown: DFF<Bit>,
    takes: Signal<Local, Bit>,
    after_write: Signal<Local, Bits<P>>,
    write_ahead: Signal<Local, Bits<P>>,
    write_half: Signal<Local, Bits<P>>,
    write_code: Signal<Local, Bits<P>>,
    full_code: Signal<Local, Bits<P>>,
    moves: Signal<Local, Bit>,
    fetches: Signal<Local, Bit>,
    after_read: Signal<Local, Bits<P>>,
    read_ahead: Signal<Local, Bits<P>>,
    read_half: Signal<Local, Bits<P>>,
    read_code: Signal<Local, Bits<P>>,
    nothing: Parameter<Bits<P>>,
    one: Parameter<Bits<P>>,
    /// A pointer a whole round ahead differs in these bits of its Gray code.
    round: Parameter<Bits<P>>,
}

impl<const P: usize, const D: usize> AsyncFifo<P, D> {
    /// Entries in the memory.
    pub const DEPTH: usize = 1 << (P - 1);

    /// A buffer of [`DEPTH`](Self::DEPTH) entries and two more.
    ///
    /// # Panics
    /// If P is not in `3..=16`.
    pub fn new() -> Self {
        assert!((3..=16).contains(&P), "a buffer between two clocks has pointers of 3 to 16 bits, not {P}");
        Self {
            memory: DualClockMemory::new(P - 1, D),
            nothing: Parameter::new(Bits::default()),
            one: Parameter::new(Bits::from(1)),
            round: Parameter::new(Bits::from(3 << (P - 2))),
            ..Self::default()
        }
    }
}

impl<const P: usize, const D: usize> Logic for AsyncFifo<P, D> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, write_clock, write_count, write_gray, full);
        dff_setup!(self, read_clock, read_count, read_gray, empty, fetched, shown);
        clock!(self, write_clock, read_seen);
        clock!(self, read_clock, write_seen);
        self.memory.write_clock.next = self.write_clock.val();
        self.memory.read_clock.next = self.read_clock.val();
        self.read_seen.sent.next = self.read_gray.q.val();
        self.write_seen.sent.next = self.write_gray.q.val();

        // The writer's side.
        self.is_full.next = self.full.q.val();
        self.is_fetched.next = self.write_gray.q.val() == self.read_seen.received.val();
        self.takes.next = self.push.val() & (!self.full.q.val());
        self.memory.write_address.next = self.write_count.q.val();
        self.memory.write_data.next = self.push_data.val();
        self.memory.write_enable.next = self.takes.val();
        self.after_write.next = self.write_count.q.val() + self.one.val();
        self.write_ahead.next = self.write_count.q.val();
        if self.takes.val() {
            self.write_ahead.next = self.after_write.val();
        }
        self.write_half.next = self.write_ahead.val() >> self.one.val();
        self.write_code.next = self.write_ahead.val() ^ self.write_half.val();
        self.full_code.next = self.read_seen.received.val() ^ self.round.val();
        self.write_count.d.next = self.write_ahead.val();
        self.write_gray.d.next = self.write_code.val();
        self.full.d.next = self.write_code.val() == self.full_code.val();
        if self.write_reset.val() {
            self.write_count.d.next = self.nothing.val();
            self.write_gray.d.next = self.nothing.val();
            self.full.d.next = true;
        }

        // The reader's side.
        self.valid.next = self.shown.q.val();
        self.data.next = self.memory.read_data.val();
        self.is_empty.next = self.empty.q.val() & (!self.fetched.q.val()) & (!self.shown.q.val());
        self.moves.next = self.pop.val() | (!self.shown.q.val());
        self.fetches.next = self.moves.val() & (!self.empty.q.val());
        self.memory.read_address.next = self.read_count.q.val();
        self.memory.read_enable.next = self.moves.val();
        self.after_read.next = self.read_count.q.val() + self.one.val();
        self.read_ahead.next = self.read_count.q.val();
        if self.fetches.val() {
            self.read_ahead.next = self.after_read.val();
        }
        self.read_half.next = self.read_ahead.val() >> self.one.val();
        self.read_code.next = self.read_ahead.val() ^ self.read_half.val();
        self.read_count.d.next = self.read_ahead.val();
        self.read_gray.d.next = self.read_code.val();
        self.empty.d.next = self.read_code.val() == self.write_seen.received.val();
        if self.moves.val() {
            self.fetched.d.next = self.fetches.val();
            self.shown.d.next = self.fetched.q.val();
        }
        if self.read_reset.val() {
            self.read_count.d.next = self.nothing.val();
            self.read_gray.d.next = self.nothing.val();
            self.empty.d.next = true;
            self.fetched.d.next = false;
            self.shown.d.next = false;
        }
    }
}
