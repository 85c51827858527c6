//! The receive FIFO: holds the payload of frames until the core takes it, and can forget the payload of a frame that
//! turns out not to be sound. An entry has D bits: a byte on the serial link, a word on the UDP link.
//!
//! 1. `takes` may be high only while `entry_valid` is high. An entry that is not taken stays.
//! 2. The user pushes at most as many entries as `free` said before the first of them, or pushes only while `is_full`
//!    is low; the FIFO does not check.
//! 3. `commits` comes 3 clocks or more after the last `push`.
//!
//! Latency: from `commits` 2 clocks to `free`, and 3 to `entry_valid` if the FIFO was empty; 4 clocks from an entry
//! taken to the next; 1 clock from a push to `is_full`.
//!
//! Source: three pointers into a block RAM: where the next entry goes, where the entries that count end, and where the
//! free ones end. The last one lies a whole memory behind the oldest entry, so it is the address of that entry too.
//! Pointers have 16 bits, of which the memory uses as many as its address has: the difference of two pointers is the
//! number of entries between them.

use super::types::FifoRoom;
use crate::leaf::{BlockMemory, Parameter};
use crate::prelude::*;

/// Bits of an address of the largest FIFO.
const ADDRESS_BITS: usize = 15;

#[derive(LogicBlock, Default)]
pub struct ReceiveFifo<const D: usize> {
    pub clock: Signal<In, Clock>,
    /// A reset empties the FIFO.
    pub reset: Signal<In, Bit>,
    /// Forget the entries that do not count yet.
    pub begins: Signal<In, Bit>,
    /// Store one more entry, which does not count until `commits`.
    pub push: Signal<In, Bit>,
    pub push_data: Signal<In, Bits<D>>,
    /// All entries that were pushed count.
    pub commits: Signal<In, Bit>,
    /// The room for more entries.
    pub room: Signal<Out, FifoRoom>,
    /// The oldest entry that counts; the user takes the entry at the edge at which `takes` is high.
    pub entry_valid: Signal<Out, Bit>,
    pub entry_data: Signal<Out, Bits<D>>,
    pub takes: Signal<In, Bit>,
    memory: BlockMemory<ADDRESS_BITS, D>,
    provisional: DFF<Bits<16>>,
    committed: DFF<Bits<16>>,
    free_end: DFF<Bits<16>>,
    unused: DFF<Bits<16>>,
    holds: DFF<Bit>,
    full: DFF<Bit>,
    /// Clocks for which the memory has read the oldest entry, up to 3.
    read_for: DFF<Bits<2>>,
    size: Parameter<Bits<16>>,
    one: Signal<Local, Bits<16>>,
    one_clock: Signal<Local, Bits<2>>,
    longest: Signal<Local, Bits<2>>,
}

impl<const D: usize> ReceiveFifo<D> {
    /// A FIFO of this many entries, a power of two from 2 to 32,768.
    pub fn new(entries: u32) -> Self {
        Self {
            memory: BlockMemory::new(entries.trailing_zeros() as usize, D),
            size: Parameter::new(u64::from(entries).into()),
            ..Self::default()
        }
    }
}

impl<const D: usize> Logic for ReceiveFifo<D> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, provisional, committed, free_end, unused, holds, full, read_for);
        clock!(self, clock, memory);
        self.one.next = 1.into();
        self.one_clock.next = 1.into();
        self.longest.next = 3.into();
        self.memory.write_address.next = self.provisional.q.val().get_bits::<15>(0);
        self.memory.write_data.next = self.push_data.val();
        self.memory.write_enable.next = self.push.val();
        self.memory.read_address.next = self.free_end.q.val().get_bits::<15>(0);
        self.entry_data.next = self.memory.read_data.val();
        self.entry_valid.next = self.holds.q.val() & (self.read_for.q.val() == self.longest.val());
        self.room.next.free = self.unused.q.val();
        self.room.next.is_full = self.full.q.val();

        self.full.d.next = self.provisional.q.val() == self.free_end.q.val();
        self.unused.d.next = self.free_end.q.val() - self.committed.q.val();
        self.holds.d.next = self.unused.q.val() != self.size.val();
        if self.read_for.q.val() != self.longest.val() {
            self.read_for.d.next = self.read_for.q.val() + self.one_clock.val();
        }
        if self.push.val() {
            self.provisional.d.next = self.provisional.q.val() + self.one.val();
        }
        if self.commits.val() {
            self.committed.d.next = self.provisional.q.val();
        }
        if self.begins.val() {
            self.provisional.d.next = self.committed.q.val();
        }
        if self.takes.val() {
            self.free_end.d.next = self.free_end.q.val() + self.one.val();
            self.read_for.d.next = 0.into();
        }
        if self.reset.val() {
            self.provisional.d.next = 0.into();
            self.committed.d.next = 0.into();
            self.free_end.d.next = self.size.val();
            self.unused.d.next = self.size.val();
            self.holds.d.next = false;
            self.full.d.next = false;
            self.read_for.d.next = 0.into();
        }
    }
}
