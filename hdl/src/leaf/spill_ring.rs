//! The ring behind a [`DeepFifo`](super::DeepFifo): a block memory that returns, with each entry fetched, the place in
//! the window for which the entry was asked.
//!
//! Latency: 2 clocks from `fetches` to `fetched`.

use super::block_memory::BlockMemory;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct SpillRing<const A: usize, const D: usize> {
    pub clock: Signal<In, Clock>,
    /// A reset forgets the fetches under way.
    pub reset: Signal<In, Bit>,
    /// An entry that is written at this edge.
    pub write_address: Signal<In, Bits<A>>,
    pub write_data: Signal<In, Bits<D>>,
    pub write_enable: Signal<In, Bit>,
    /// Fetch the entry at `read_address` for this place in the window.
    pub read_address: Signal<In, Bits<A>>,
    pub fetches: Signal<In, Bit>,
    pub place: Signal<In, Bits<4>>,
    /// A fetched entry has come for this place in the window.
    pub fetched: Signal<Out, Bit>,
    pub fetched_place: Signal<Out, Bits<4>>,
    pub fetched_data: Signal<Out, Bits<D>>,
    memory: BlockMemory<A, D>,
    in_array: DFF<Bit>,
    in_output: DFF<Bit>,
    place_in_array: DFF<Bits<4>>,
    place_in_output: DFF<Bits<4>>,
}

impl<const A: usize, const D: usize> SpillRing<A, D> {
    /// A ring of `2^address_bits` entries of `stored_bits` bits.
    pub fn new(address_bits: usize, stored_bits: usize) -> Self {
        Self { memory: BlockMemory::new(address_bits, stored_bits), ..Self::default() }
    }
}

impl<const A: usize, const D: usize> Logic for SpillRing<A, D> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, in_array, in_output, place_in_array, place_in_output);
        clock!(self, clock, memory);
        self.memory.write_address.next = self.write_address.val();
        self.memory.write_data.next = self.write_data.val();
        self.memory.write_enable.next = self.write_enable.val();
        self.memory.read_address.next = self.read_address.val();
        self.in_array.d.next = self.fetches.val();
        self.in_output.d.next = self.in_array.q.val();
        self.place_in_array.d.next = self.place.val();
        self.place_in_output.d.next = self.place_in_array.q.val();
        self.fetched.next = self.in_output.q.val();
        self.fetched_place.next = self.place_in_output.q.val();
        self.fetched_data.next = self.memory.read_data.val();
        if self.reset.val() {
            self.in_array.d.next = false;
            self.in_output.d.next = false;
        }
    }
}
