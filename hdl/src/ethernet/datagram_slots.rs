//! Two slots for datagrams on their way out, each filled in the clock of the core and read in that of the port.
//!
//! 1. A datagram is 12 bytes of its receiver (Ethernet address, IPv4 address, UDP port, each highest byte first) and 0
//!    to 1,472 bytes of payload. The block does not check the length.
//! 2. `byte_ready` depends on registers only, and stays high until the end of a datagram. The byte with `byte_is_last`
//!    ends the datagram; `byte_drops`, without a byte, forgets those of one that has not ended.
//! 3. While `holds` is high, `length` and the bytes of the oldest datagram stay. `lets_go` at an edge frees its slot;
//!    it may be high only while `holds` is.
//! 4. Both resets are held together, at least for three clocks of either.
//!
//! Latency: 2 clocks from `read_index` to `read_data`; 3 clocks of the reader from the last byte to `holds`, and 3 of
//! the writer from `lets_go` to `byte_ready`, each perhaps one more.
//!
//! Source: each side has a flag for each slot that changes when the slot is filled or freed, and sees the other's flags
//! through a synchroniser. The slot is filled while they differ. Flags, the bytes in the memory and the two lengths are
//! all that crosses; bytes and lengths are stable before the flag is seen.

use super::types::{Byte, Place};
use crate::leaf::{DualClockMemory, Synchroniser};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct DatagramSlots {
    pub write_clock: Signal<In, Clock>,
    pub write_reset: Signal<In, Bit>,
    /// The bytes of a datagram.
    pub byte_valid: Signal<In, Bit>,
    pub byte_ready: Signal<Out, Bit>,
    pub byte_data: Signal<In, Byte>,
    pub byte_is_last: Signal<In, Bit>,
    pub byte_drops: Signal<In, Bit>,
    pub read_clock: Signal<In, Clock>,
    pub read_reset: Signal<In, Bit>,
    /// The oldest datagram, its length, and a byte of it.
    pub holds: Signal<Out, Bit>,
    pub length: Signal<Out, Place>,
    pub read_index: Signal<In, Place>,
    pub read_data: Signal<Out, Byte>,
    /// The reader is done with the datagram.
    pub lets_go: Signal<In, Bit>,
    memory: DualClockMemory<12, 8>,
    filled_seen: Synchroniser<Bits<2>>,
    freed_seen: Synchroniser<Bits<2>>,
    filled: DFF<Bits<2>>,
    freed: DFF<Bits<2>>,
    write_slot: DFF<Bit>,
    read_slot: DFF<Bit>,
    count: DFF<Place>,
    length0: DFF<Place>,
    length1: DFF<Place>,
    takes: Signal<Local, Bit>,
    after_byte: Signal<Local, Place>,
    one: Signal<Local, Place>,
    write_base: Signal<Local, Bits<12>>,
    read_base: Signal<Local, Bits<12>>,
    write_mask: Signal<Local, Bits<2>>,
    read_mask: Signal<Local, Bits<2>>,
    write_differs: Signal<Local, Bits<2>>,
    read_differs: Signal<Local, Bits<2>>,
}

impl DatagramSlots {
    /// Empty slots.
    pub fn new() -> Self {
        Self { memory: DualClockMemory::new(12, 8), ..Self::default() }
    }
}

impl Logic for DatagramSlots {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, write_clock, filled, write_slot, count, length0, length1);
        dff_setup!(self, read_clock, freed, read_slot);
        clock!(self, write_clock, freed_seen);
        clock!(self, read_clock, filled_seen);
        self.memory.write_clock.next = self.write_clock.val();
        self.memory.read_clock.next = self.read_clock.val();
        self.freed_seen.sent.next = self.freed.q.val();
        self.filled_seen.sent.next = self.filled.q.val();
        self.one.next = 1.into();

        self.write_base.next = 0.into();
        self.write_mask.next = 1.into();
        if self.write_slot.q.val() {
            self.write_base.next = 2048.into();
            self.write_mask.next = 2.into();
        }
        self.write_differs.next = (self.filled.q.val() ^ self.freed_seen.received.val()) & self.write_mask.val();
        self.byte_ready.next = !self.write_differs.val().any();
        self.takes.next = self.byte_valid.val() & (!self.write_differs.val().any());
        self.after_byte.next = self.count.q.val() + self.one.val();
        self.memory.write_address.next = bit_cast::<12, 11>(self.count.q.val()) | self.write_base.val();
        self.memory.write_data.next = self.byte_data.val();
        self.memory.write_enable.next = self.takes.val();
        if self.takes.val() {
            self.count.d.next = self.after_byte.val();
            if self.byte_is_last.val() {
                self.count.d.next = 0.into();
                self.filled.d.next = self.filled.q.val() ^ self.write_mask.val();
                self.write_slot.d.next = !self.write_slot.q.val();
                if self.write_slot.q.val() {
                    self.length1.d.next = self.after_byte.val();
                } else {
                    self.length0.d.next = self.after_byte.val();
                }
            }
        }
        if self.byte_drops.val() {
            self.count.d.next = 0.into();
        }
        if self.write_reset.val() {
            self.count.d.next = 0.into();
            self.filled.d.next = 0.into();
            self.write_slot.d.next = false;
        }

        self.read_base.next = 0.into();
        self.read_mask.next = 1.into();
        self.length.next = self.length0.q.val();
        if self.read_slot.q.val() {
            self.read_base.next = 2048.into();
            self.read_mask.next = 2.into();
            self.length.next = self.length1.q.val();
        }
        self.read_differs.next = (self.freed.q.val() ^ self.filled_seen.received.val()) & self.read_mask.val();
        self.holds.next = self.read_differs.val().any();
        self.memory.read_address.next = bit_cast::<12, 11>(self.read_index.val()) | self.read_base.val();
        self.memory.read_enable.next = true;
        self.read_data.next = self.memory.read_data.val();
        if self.lets_go.val() {
            self.freed.d.next = self.freed.q.val() ^ self.read_mask.val();
            self.read_slot.d.next = !self.read_slot.q.val();
        }
        if self.read_reset.val() {
            self.freed.d.next = 0.into();
            self.read_slot.d.next = false;
        }
    }
}
