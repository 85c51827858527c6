//! The receive FIFO: holds the payload of frames until the core takes it, and can forget the bytes of a frame that
//! turns out not to be sound.
//!
//! 1. `takes` may be high only while `byte_valid` is high. A byte that is not taken stays.
//! 2. The user pushes at most as many bytes as `free` said before the first of them; the FIFO does not check.
//! 3. `commits` comes 3 clocks or more after the last `push`.
//!
//! Latency: from `commits` 2 clocks to `free`, and 3 to `byte_valid` if the FIFO was empty; 4 clocks from a byte
//! taken to the next.
//!
//! Source: three pointers into a block RAM: where the next byte goes, where the bytes that count end, and where the
//! free bytes end. The last one lies a whole memory behind the oldest byte, so it is the address of that byte too.
//! Pointers have 16 bits, of which the memory uses as many as its address has: the difference of two pointers is the
//! number of bytes between them.

use super::types::Byte;
use crate::leaf::{BlockMemory, Parameter};
use crate::prelude::*;
use incircle_protocol::LinkConfig;

/// Bits of an address of the largest FIFO.
const ADDRESS_BITS: usize = 15;

#[derive(LogicBlock, Default)]
pub struct ReceiveFifo {
    pub clock: Signal<In, Clock>,
    /// A reset empties the FIFO.
    pub reset: Signal<In, Bit>,
    /// Forget the bytes that do not count yet.
    pub begins: Signal<In, Bit>,
    /// Store one more byte, which does not count until `commits`.
    pub push: Signal<In, Bit>,
    pub push_data: Signal<In, Byte>,
    /// All bytes that were pushed count.
    pub commits: Signal<In, Bit>,
    /// Free bytes, among them the places of bytes that do not count yet.
    pub free: Signal<Out, Bits<16>>,
    /// The oldest byte that counts; the user takes the byte at the edge at which `takes` is high.
    pub byte_valid: Signal<Out, Bit>,
    pub byte_data: Signal<Out, Byte>,
    pub takes: Signal<In, Bit>,
    memory: BlockMemory<ADDRESS_BITS, 8>,
    provisional: DFF<Bits<16>>,
    committed: DFF<Bits<16>>,
    free_end: DFF<Bits<16>>,
    unused: DFF<Bits<16>>,
    holds: DFF<Bit>,
    /// Clocks for which the memory has read the oldest byte, up to 3.
    read_for: DFF<Bits<2>>,
    size: Parameter<Bits<16>>,
    one: Signal<Local, Bits<16>>,
    one_clock: Signal<Local, Bits<2>>,
    longest: Signal<Local, Bits<2>>,
}

impl ReceiveFifo {
    /// The FIFO of a link that has passed [`LinkConfig::check`].
    pub fn new(link: LinkConfig) -> Self {
        Self {
            memory: BlockMemory::new(link.fifo_bytes.trailing_zeros() as usize, 8),
            size: Parameter::new(u64::from(link.fifo_bytes).into()),
            ..Self::default()
        }
    }
}

impl Logic for ReceiveFifo {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, provisional, committed, free_end, unused, holds, read_for);
        clock!(self, clock, memory);
        self.one.next = 1.into();
        self.one_clock.next = 1.into();
        self.longest.next = 3.into();
        self.memory.write_address.next = self.provisional.q.val().get_bits::<15>(0);
        self.memory.write_data.next = self.push_data.val();
        self.memory.write_enable.next = self.push.val();
        self.memory.read_address.next = self.free_end.q.val().get_bits::<15>(0);
        self.byte_data.next = self.memory.read_data.val();
        self.byte_valid.next = self.holds.q.val() & (self.read_for.q.val() == self.longest.val());
        self.free.next = self.unused.q.val();

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
            self.read_for.d.next = 0.into();
        }
    }
}
