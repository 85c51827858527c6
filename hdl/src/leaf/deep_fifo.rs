//! A deep [`Fifo`](super::Fifo): the same from outside, but with its entries in block RAM.
//!
//! 1. While empty, `valid = push` and `data = push_data` in the same cycle. Otherwise `data` is the oldest entry.
//! 2. `pop` may be high only while `valid` is high. Without `pop`, `valid` and `data` stay.
//! 3. Push and pop at one edge are allowed in every state; if the FIFO is empty, the entry passes.
//! 4. The user never holds more than `2^address_bits` entries: there is no full flag and no check.
//!
//! Latency: none (combinational) from push to output while empty.
//!
//! The oldest entry stands in a register, so that few levels of logic lie between it and what its user computes from
//! it. All others have places in a ring in block RAM. A window of the 16 oldest of these stands in LUTs as well, where
//! it can be read without a clock. A new entry goes straight into the window if it falls into the window. Otherwise it
//! is spilled into the ring, and fetched as soon as the window has moved on:
//! ```text
//!           after_first           fetched             newest
//!                v                   v                   v
//!      first     [ window, up to 16  |      spilled      )-------
//! ```
//! A fetch takes three clocks, and begins only with 15 entries before it in the window. The window never holds fewer
//! while anything is spilled, because a clock that removes one entry fetches another; so a fetched entry is there long
//! before it is the oldest. A fetched entry and a new one may enter the window at one edge. The window has two banks
//! for that, and a bit per place tells which bank counts.
//!
//! An entry that is pushed behind the oldest and replaces it at the same edge is stored too, and its place is free
//! again at once. `pop` often depends on the oldest entry itself, so it comes late in a clock, and moves nothing but
//! the register and the end of the window.
//!
//! Source: [`Fifo`](super::Fifo) around a [`BlockMemory`](super::BlockMemory).

use super::lut_memory::LutMemory;
use super::memory_shape::MAX_ADDRESS_BITS;
use super::spill_ring::SpillRing;
use crate::prelude::*;

#[derive(LogicBlock)]
pub struct DeepFifo<const A: usize, const D: usize> {
    pub clock: Signal<In, Clock>,
    /// Empty the FIFO at this edge.
    pub reset: Signal<In, Bit>,
    /// Take `push_data` as a new entry at this edge.
    pub push: Signal<In, Bit>,
    pub push_data: Signal<In, Bits<D>>,
    /// Remove the entry on the output at this edge.
    pub pop: Signal<In, Bit>,
    /// The output holds an entry.
    pub valid: Signal<Out, Bit>,
    /// The oldest entry, zero above the stored bits.
    pub data: Signal<Out, Bits<D>>,
    ring: SpillRing<A, D>,
    new_bank: LutMemory<4, D>,
    fetched_bank: LutMemory<4, D>,
    was_fetched: LutMemory<4, 1>,
    holds_first: DFF<Bit>,
    /// The FIFO does not hold an oldest entry: a copy of the inverted `holds_first` that drives the data alone.
    passes: DFF<Bit>,
    first: DFF<Bits<D>>,
    holds_more: DFF<Bit>,
    window_is_full: DFF<Bit>,
    holds_spilled: DFF<Bit>,
    newest: DFF<Bits<A>>,
    fetched: DFF<Bits<A>>,
    after_first: DFF<Bits<4>>,
    kept_data: Signal<Local, Bits<D>>,
    joins: Signal<Local, Bit>,
    moves_up: Signal<Local, Bit>,
    spills: Signal<Local, Bit>,
    enters: Signal<Local, Bit>,
    fetches: Signal<Local, Bit>,
    advances: Signal<Local, Bit>,
    after_newest: Signal<Local, Bits<A>>,
    after_fetched: Signal<Local, Bits<A>>,
    after_moved: Signal<Local, Bits<4>>,
    place: Signal<Local, Bits<4>>,
    after_place: Signal<Local, Bits<4>>,
    one: Constant<Bits<A>>,
    one_place: Constant<Bits<4>>,
    nothing: Constant<Bits<A>>,
    first_place: Constant<Bits<4>>,
    from_user: Constant<Bits<1>>,
    from_ring: Constant<Bits<1>>,
    kept_bits: Constant<Bits<D>>,
}

impl<const A: usize, const D: usize> DeepFifo<A, D> {
    /// Address bits of the window in LUTs; a FIFO no deeper than the window is a [`Fifo`](super::Fifo).
    pub const WINDOW_BITS: usize = 4;

    /// A FIFO of `2^address_bits` entries of `stored_bits` bits.
    ///
    /// # Panics
    /// If `address_bits` is not in `5..=A` (and at most 20) or `stored_bits` not in `1..=D`.
    pub fn new(address_bits: usize, stored_bits: usize) -> Self {
        let window = Self::WINDOW_BITS;
        assert!(address_bits > window, "a deep buffer has more than {window} address bits, not {address_bits}");
        Self {
            clock: Signal::default(),
            reset: Signal::default(),
            push: Signal::default(),
            push_data: Signal::default(),
            pop: Signal::default(),
            valid: Signal::default(),
            data: Signal::default(),
            ring: SpillRing::new(address_bits, stored_bits),
            new_bank: LutMemory::new(window, stored_bits),
            fetched_bank: LutMemory::new(window, stored_bits),
            was_fetched: LutMemory::new(window, 1),
            holds_first: DFF::default(),
            passes: DFF::default(),
            first: DFF::default(),
            holds_more: DFF::default(),
            window_is_full: DFF::default(),
            holds_spilled: DFF::default(),
            newest: DFF::default(),
            fetched: DFF::default(),
            after_first: DFF::default(),
            kept_data: Signal::default(),
            joins: Signal::default(),
            moves_up: Signal::default(),
            spills: Signal::default(),
            enters: Signal::default(),
            fetches: Signal::default(),
            advances: Signal::default(),
            after_newest: Signal::default(),
            after_fetched: Signal::default(),
            after_moved: Signal::default(),
            place: Signal::default(),
            after_place: Signal::default(),
            one: Constant::new(Bits::from(1)),
            one_place: Constant::new(Bits::from(1)),
            nothing: Constant::new(Bits::default()),
            first_place: Constant::new(Bits::default()),
            from_user: Constant::new(Bits::from(0)),
            from_ring: Constant::new(Bits::from(1)),
            kept_bits: Constant::new(Bits::<D>::mask() >> (D - stored_bits) as u64),
        }
    }
}

impl<const A: usize, const D: usize> Default for DeepFifo<A, D> {
    fn default() -> Self {
        Self::new(A.min(MAX_ADDRESS_BITS), D)
    }
}

impl<const A: usize, const D: usize> Logic for DeepFifo<A, D> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, holds_first, passes, first, holds_more, window_is_full, holds_spilled);
        dff_setup!(self, clock, newest, fetched, after_first);
        clock!(self, clock, ring, new_bank, fetched_bank, was_fetched);
        self.after_newest.next = self.newest.q.val() + self.one.val();
        self.after_fetched.next = self.fetched.q.val() + self.one.val();
        self.after_moved.next = self.after_first.q.val() + self.one_place.val();
        self.place.next = self.fetched.q.val().get_bits::<4>(0);
        self.after_place.next = self.place.val() + self.one_place.val();

        self.kept_data.next = self.push_data.val() & self.kept_bits.val();
        self.valid.next = self.holds_first.q.val() | self.push.val();
        self.data.next = self.first.q.val();
        if self.passes.q.val() {
            self.data.next = self.kept_data.val();
        }

        // On every pop the register of the oldest entry takes the successor, even one that is only just pushed.
        self.new_bank.read_address.next = self.after_first.q.val();
        self.fetched_bank.read_address.next = self.after_first.q.val();
        self.was_fetched.read_address.next = self.after_first.q.val();
        if self.pop.val() | (!self.holds_first.q.val()) {
            self.first.d.next = self.kept_data.val();
            if self.holds_more.q.val() {
                self.first.d.next = self.new_bank.read_data.val();
                if self.was_fetched.read_data.val() == self.from_ring.val() {
                    self.first.d.next = self.fetched_bank.read_data.val();
                }
            }
        }
        self.holds_first.d.next = self.valid.val();
        if self.pop.val() {
            self.holds_first.d.next = self.holds_first.q.val() & (self.holds_more.q.val() | self.push.val());
        }

        // The input `pop` comes late, so only the last of these decisions depends on it.
        self.joins.next = self.push.val() & self.holds_first.q.val();
        self.spills.next = self.joins.val() & (self.holds_spilled.q.val() | self.window_is_full.q.val());
        self.enters.next = self.joins.val() & (!self.spills.val());
        self.fetches.next = self.holds_spilled.q.val() & (!self.window_is_full.q.val());
        self.advances.next = (!self.window_is_full.q.val()) & (self.holds_spilled.q.val() | self.joins.val());
        self.moves_up.next = self.pop.val() & self.holds_first.q.val() & (self.holds_more.q.val() | self.push.val());

        self.ring.write_address.next = self.newest.q.val();
        self.ring.write_data.next = self.push_data.val();
        self.ring.write_enable.next = self.spills.val();
        self.ring.read_address.next = self.fetched.q.val();
        self.ring.reset.next = self.reset.val();
        self.ring.fetches.next = self.fetches.val();
        self.ring.place.next = self.place.val();
        self.fetched_bank.write_address.next = self.ring.fetched_place.val();
        self.fetched_bank.write_data.next = self.ring.fetched_data.val();
        self.fetched_bank.write_enable.next = self.ring.fetched.val();

        // A fetch marks its place in the window at once; the data follow two clocks later, in the other bank.
        self.new_bank.write_address.next = self.place.val();
        self.new_bank.write_data.next = self.push_data.val();
        self.new_bank.write_enable.next = self.enters.val();
        self.was_fetched.write_address.next = self.place.val();
        self.was_fetched.write_data.next = self.from_user.val();
        if self.fetches.val() {
            self.was_fetched.write_data.next = self.from_ring.val();
        }
        self.was_fetched.write_enable.next = self.advances.val();

        if self.joins.val() {
            self.newest.d.next = self.after_newest.val();
        }
        if self.advances.val() {
            self.fetched.d.next = self.after_fetched.val();
        }
        if self.moves_up.val() {
            self.after_first.d.next = self.after_moved.val();
        }
        if self.fetches.val() {
            self.holds_spilled.d.next = self.after_fetched.val() != self.newest.q.val();
        }
        if self.spills.val() {
            self.holds_spilled.d.next = true;
        }
        if self.advances.val() & (!self.moves_up.val()) {
            self.holds_more.d.next = true;
            self.window_is_full.d.next = self.after_place.val() == self.after_first.q.val();
        }
        if self.moves_up.val() & (!self.advances.val()) {
            self.holds_more.d.next = self.after_moved.val() != self.place.val();
            self.window_is_full.d.next = false;
        }

        if self.reset.val() {
            self.holds_first.d.next = false;
            self.holds_more.d.next = false;
            self.window_is_full.d.next = false;
            self.holds_spilled.d.next = false;
            self.newest.d.next = self.nothing.val();
            self.fetched.d.next = self.nothing.val();
            self.after_first.d.next = self.first_place.val();
        }
        self.passes.d.next = !self.holds_first.d.val();
    }
}
