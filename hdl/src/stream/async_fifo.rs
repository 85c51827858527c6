//! A FIFO between two clocks, which carries the beats of the stream link from the bus to the core and back.
//!
//! 1. P is the number of bits of a pointer. The memory holds `2^(P-1)` entries, and the read port two more.
//! 2. `pop` may be high only while `valid` is high. Without `pop`, `valid` and `data` stay.
//! 3. `is_full`, `valid` and `data` are registers; `is_fetched` and `is_empty` depend on registers only. Each belongs
//!    to the clock of its own side.
//! 4. Both resets are held together, at least until each side has seen the other's pointer at 0: three clocks of
//!    either. During a reset `is_full` is 1 and `valid` is 0.
//!
//! Latency: five edges of `read_clock` from the edge that takes an entry to `valid`, and perhaps one more if that edge
//! coincides with one of `read_clock`. One entry passes at every clock of the slower side.
//!
//! The pointers count in Gray code and pass through a [`Synchroniser`]. Nothing else crosses but the words in the
//! memory, which are stable for two clocks of the reader before the reader learns of them:
//! ```text
//! push -> write_count, write_gray --------> write_seen -> empty -> read_count -> fetched -> shown -> valid
//!   |       full <- read_seen <------------ read_gray <---------------+             |         |
//!   +-> memory (2^(P-1) words) ---------------------------------------------> array --> output --> data
//! ```
//! Source: C. E. Cummings, Simulation and Synthesis Techniques for Asynchronous FIFO Design, SNUG 2002, style 1.

use crate::leaf::{DualClockMemory, Parameter, Synchroniser};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct AsyncFifo<const P: usize, const D: usize> {
    /// The writer's side: its clock, and a reset that empties the FIFO.
    pub write_clock: Signal<In, Clock>,
    pub write_reset: Signal<In, Bit>,
    /// An entry, which is taken at an edge with `push` high and `is_full` low.
    pub push: Signal<In, Bit>,
    pub push_data: Signal<In, Bits<D>>,
    pub is_full: Signal<Out, Bit>,
    /// As far as the writer knows, the reader has fetched all that was taken.
    pub is_fetched: Signal<Out, Bit>,
    /// The reader's side: its clock and its reset.
    pub read_clock: Signal<In, Clock>,
    pub read_reset: Signal<In, Bit>,
    /// The oldest entry, which `pop` removes at this edge.
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
    /// The Gray code of the pointer behind the next entry, so that no addition lies between the pointer and `full`.
    next_gray: DFF<Bits<P>>,
    full: DFF<Bit>,
    read_count: DFF<Bits<P>>,
    read_gray: DFF<Bits<P>>,
    /// The memory holds nothing that the reader could fetch.
    empty: DFF<Bit>,
    /// An entry is in the register of the memory's array (`fetched`), and one in the output register (`shown`).
    fetched: DFF<Bit>,
    shown: DFF<Bit>,
    takes: Signal<Local, Bit>,
    after_write: Signal<Local, Bits<P>>,
    second_write: Signal<Local, Bits<P>>,
    second_half: Signal<Local, Bits<P>>,
    full_code: Signal<Local, Bits<P>>,
    moves: Signal<Local, Bit>,
    fetches: Signal<Local, Bit>,
    after_read: Signal<Local, Bits<P>>,
    read_ahead: Signal<Local, Bits<P>>,
    read_half: Signal<Local, Bits<P>>,
    read_code: Signal<Local, Bits<P>>,
    nothing: Parameter<Bits<P>>,
    one: Parameter<Bits<P>>,
    two: Parameter<Bits<P>>,
    /// A pointer that is a whole round ahead differs in these bits of its Gray code.
    round: Parameter<Bits<P>>,
}

impl<const P: usize, const D: usize> AsyncFifo<P, D> {
    /// Number of entries in the memory.
    pub const DEPTH: usize = 1 << (P - 1);

    /// A FIFO of [`DEPTH`](Self::DEPTH) entries and two more.
    ///
    /// # Panics
    /// If P is not in `3..=16`.
    pub fn new() -> Self {
        assert!((3..=16).contains(&P), "a buffer between two clocks has pointers of 3 to 16 bits, not {P}");
        Self {
            memory: DualClockMemory::new(P - 1, D),
            nothing: Parameter::new(Bits::default()),
            one: Parameter::new(Bits::from(1)),
            two: Parameter::new(Bits::from(2)),
            round: Parameter::new(Bits::from(3 << (P - 2))),
            ..Self::default()
        }
    }
}

impl<const P: usize, const D: usize> Logic for AsyncFifo<P, D> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, write_clock, write_count, write_gray, next_gray, full);
        dff_setup!(self, read_clock, read_count, read_gray, empty, fetched, shown);
        clock!(self, write_clock, read_seen);
        clock!(self, read_clock, write_seen);
        self.memory.write_clock.next = self.write_clock.val();
        self.memory.read_clock.next = self.read_clock.val();
        self.read_seen.sent.next = self.read_gray.q.val();
        self.write_seen.sent.next = self.write_gray.q.val();

        // The writer's side sees the reader's pointer late, so the FIFO may look fuller than it is, but never emptier.
        self.is_full.next = self.full.q.val();
        self.is_fetched.next = self.write_gray.q.val() == self.read_seen.received.val();
        self.takes.next = self.push.val() & (!self.full.q.val());
        self.memory.write_address.next = self.write_count.q.val();
        self.memory.write_data.next = self.push_data.val();
        self.memory.write_enable.next = self.takes.val();
        self.after_write.next = self.write_count.q.val() + self.one.val();
        self.second_write.next = self.write_count.q.val() + self.two.val();
        self.second_half.next = self.second_write.val() >> self.one.val();
        self.full_code.next = self.read_seen.received.val() ^ self.round.val();
        self.full.d.next = self.write_gray.q.val() == self.full_code.val();
        if self.takes.val() {
            self.write_count.d.next = self.after_write.val();
            self.write_gray.d.next = self.next_gray.q.val();
            self.next_gray.d.next = self.second_write.val() ^ self.second_half.val();
            self.full.d.next = self.next_gray.q.val() == self.full_code.val();
        }
        if self.write_reset.val() {
            self.write_count.d.next = self.nothing.val();
            self.write_gray.d.next = self.nothing.val();
            self.next_gray.d.next = self.one.val();
            self.full.d.next = true;
        }

        // The reader's side sees the writer's pointer late, so the FIFO may look emptier than it is, but never fuller.
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
