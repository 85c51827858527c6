//! A first-in first-out buffer that shows its oldest entry on the output; an entry pushed into an empty FIFO is on
//! the output at once.
//!
//! 1. While empty, `valid = push` and `data = push_data` in the same cycle. Otherwise `data` is the oldest entry.
//! 2. `pop` may be high only while `valid` is high. Without `pop`, `valid` and `data` stay.
//! 3. Push and pop at one edge are allowed in every state; if the FIFO is empty, the entry passes without being stored.
//! 4. The user never holds more than `2^address_bits` entries: there is no full flag and no check.
//!
//! Latency: none (combinational) from push to output while empty.
//!
//! Source: pointers into a [`LutMemory`]; a register says whether the memory holds an entry, so no count is needed.

use super::lut_memory::LutMemory;
use super::memory_shape::MAX_ADDRESS_BITS;
use crate::prelude::*;

#[derive(LogicBlock)]
pub struct Fifo<const A: usize, const D: usize> {
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
    entries: LutMemory<A, D>,
    holds_entries: DFF<Bit>,
    newest: DFF<Bits<A>>,
    oldest: DFF<Bits<A>>,
    passes: Signal<Local, Bit>,
    stores: Signal<Local, Bit>,
    after_newest: Signal<Local, Bits<A>>,
    after_oldest: Signal<Local, Bits<A>>,
    one: Constant<Bits<A>>,
    nothing: Constant<Bits<A>>,
    kept_bits: Constant<Bits<D>>,
}

impl<const A: usize, const D: usize> Fifo<A, D> {
    /// A FIFO of `2^address_bits` entries of `stored_bits` bits.
    ///
    /// # Panics
    /// If `address_bits` is not in `1..=A` (and at most 20) or `stored_bits` not in `1..=D`.
    pub fn new(address_bits: usize, stored_bits: usize) -> Self {
        Self {
            clock: Signal::default(),
            reset: Signal::default(),
            push: Signal::default(),
            push_data: Signal::default(),
            pop: Signal::default(),
            valid: Signal::default(),
            data: Signal::default(),
            entries: LutMemory::new(address_bits, stored_bits),
            holds_entries: DFF::default(),
            newest: DFF::default(),
            oldest: DFF::default(),
            passes: Signal::default(),
            stores: Signal::default(),
            after_newest: Signal::default(),
            after_oldest: Signal::default(),
            one: Constant::new(Bits::from(1)),
            nothing: Constant::new(Bits::default()),
            kept_bits: Constant::new(Bits::<D>::mask() >> (D - stored_bits) as u64),
        }
    }
}

impl<const A: usize, const D: usize> Default for Fifo<A, D> {
    fn default() -> Self {
        Self::new(A.min(MAX_ADDRESS_BITS), D)
    }
}

impl<const A: usize, const D: usize> Logic for Fifo<A, D> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, holds_entries, newest, oldest);
        clock!(self, clock, entries);
        self.after_newest.next = self.newest.q.val() + self.one.val();
        self.after_oldest.next = self.oldest.q.val() + self.one.val();

        self.entries.read_address.next = self.oldest.q.val();
        self.valid.next = self.holds_entries.q.val() | self.push.val();
        if self.holds_entries.q.val() {
            self.data.next = self.entries.read_data.val();
        } else {
            self.data.next = self.push_data.val() & self.kept_bits.val();
        }

        // Do not store an entry that is popped while it is pushed into an empty FIFO: the user has seen it already.
        self.passes.next = (!self.holds_entries.q.val()) & self.pop.val();
        self.stores.next = self.push.val() & (!self.passes.val());
        self.entries.write_address.next = self.newest.q.val();
        self.entries.write_data.next = self.push_data.val();
        self.entries.write_enable.next = self.stores.val();
        if self.stores.val() {
            self.newest.d.next = self.after_newest.val();
            self.holds_entries.d.next = true;
        }
        if self.pop.val() & self.holds_entries.q.val() {
            self.oldest.d.next = self.after_oldest.val();
            if !self.stores.val() {
                self.holds_entries.d.next = self.after_oldest.val() != self.newest.q.val();
            }
        }

        if self.reset.val() {
            self.holds_entries.d.next = false;
            self.newest.d.next = self.nothing.val();
            self.oldest.d.next = self.nothing.val();
        }
    }
}
