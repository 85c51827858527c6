//! Datagrams on their way out, up to four of them one behind another in a ring of 4,096 bytes, written in the clock of
//! the core and read in that of the port.
//!
//! 1. A datagram is 12 bytes of its receiver (Ethernet address, IPv4 address, UDP port, each highest byte first) and 0
//!    to 1,472 bytes of payload. The block does not check the length.
//! 2. `byte_ready` is a register. It rises when there is room for the longest datagram, and stays high until the end of
//!    a datagram. The byte with `byte_is_last` ends the datagram; `byte_drops`, without a byte, forgets those of one
//!    that has not ended.
//! 3. While `holds` is high, `length` and the bytes of the oldest datagram stay. `lets_go` at an edge frees its place;
//!    it may be high only while `holds` is.
//! 4. Both resets are held together, at least for four clocks of either.
//!
//! Two of the longest datagrams and two of the shortest fit if the short ones begin before the second long one: a
//! datagram begins only when there is room for the longest. So a short one between long ones, such as a receipt between
//! answers, does not make the cable wait until the next long one is whole.
//!
//! Latency: 2 clocks from `read_index` to `read_data`; 3 clocks of the reader from the last byte to `holds`, perhaps
//! one more; 2 clocks of the writer from the last byte to `byte_ready` for the next datagram if there is room; 5 of the
//! writer from `lets_go` to `byte_ready`, perhaps one more.
//!
//! A datagram of three bytes, with both clocks equal:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8  9 10 11
//! byte_valid      /^^^^^^^^\__________________________
//! byte_ready      /^^^^^^^^\__/^^^^^^^^^^^^^^^^^^^^^^^
//! byte_data        50 51 52  .  .  .  .  .  .  .  .  .
//! byte_is_last    ______/^^\__________________________
//! holds           _______________/^^^^^^^^^^^\________
//! length            .  .  .  .  .  3  3  3  3  .  .  .
//! read_index        .  .  .  .  .  0  1  2  .  .  .  .
//! read_data         .  .  .  .  .  .  . 50 51 52  .  .
//! lets_go         ________________________/^^\________
//! ```
//!
//! Source: each side has a flag for each of the four places of datagrams that changes when the place is filled or
//! freed, and sees the other's flags through a synchroniser. A place is filled while they differ. Flags, the bytes in
//! the memory and the four lengths are all that crosses; bytes and lengths are stable before the flag is seen.

use super::types::{Byte, Place};
use crate::leaf::{DualClockMemory, Synchroniser};
use crate::prelude::*;
use incircle_protocol::MAX_DEVICE_DATAGRAM;

/// Number of bits of an address of the memory.
const ADDRESS_BITS: usize = 12;
/// Bytes of the addresses before the payload of a datagram.
const RECEIVER_BYTES: usize = 12;
/// Most bytes in the memory with which the longest datagram still finds room.
const MOST_USED: usize = (1 << ADDRESS_BITS) - RECEIVER_BYTES - MAX_DEVICE_DATAGRAM;

#[derive(LogicBlock, Default)]
pub struct DatagramQueue {
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
    memory: DualClockMemory<ADDRESS_BITS, 8>,
    filled_seen: Synchroniser<Bits<4>>,
    freed_seen: Synchroniser<Bits<4>>,
    filled: DFF<Bits<4>>,
    freed: DFF<Bits<4>>,
    /// Place of the datagram that is being written, and of the oldest one that the writer counts.
    write_place: DFF<Bits<2>>,
    oldest: DFF<Bits<2>>,
    read_place: DFF<Bits<2>>,
    /// Places whose datagrams the writer counts.
    counted: DFF<Bits<4>>,
    /// Bytes of those datagrams.
    used: DFF<Bits<13>>,
    has_room: DFF<Bit>,
    /// Address of the first byte and of the next one of the datagram that is being written, and its bytes so far.
    first_address: DFF<Bits<ADDRESS_BITS>>,
    next_address: DFF<Bits<ADDRESS_BITS>>,
    count: DFF<Place>,
    length0: DFF<Place>,
    length1: DFF<Place>,
    length2: DFF<Place>,
    length3: DFF<Place>,
    /// Address of the first byte of the oldest datagram.
    read_address: DFF<Bits<ADDRESS_BITS>>,
    takes: Signal<Local, Bit>,
    ends: Signal<Local, Bit>,
    after_byte: Signal<Local, Place>,
    after_address: Signal<Local, Bits<ADDRESS_BITS>>,
    one: Signal<Local, Place>,
    one_address: Signal<Local, Bits<ADDRESS_BITS>>,
    one_place: Signal<Local, Bits<2>>,
    write_mask: Signal<Local, Bits<4>>,
    oldest_mask: Signal<Local, Bits<4>>,
    oldest_length: Signal<Local, Place>,
    is_freed: Signal<Local, Bit>,
    most_used: Signal<Local, Bits<13>>,
    read_mask: Signal<Local, Bits<4>>,
    read_length: Signal<Local, Place>,
}

impl DatagramQueue {
    /// An empty queue.
    pub fn new() -> Self {
        Self { memory: DualClockMemory::new(ADDRESS_BITS, 8), ..Self::default() }
    }
}

// The kernel holds the number as a literal, because rust-hdl allows no constants there.
const _: () = assert!(MOST_USED == 2612, "the longest datagram must find room");

impl Logic for DatagramQueue {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, write_clock, filled, write_place, oldest, counted, used, has_room, first_address);
        dff_setup!(self, write_clock, next_address, count, length0, length1, length2, length3);
        dff_setup!(self, read_clock, freed, read_place, read_address);
        clock!(self, write_clock, freed_seen);
        clock!(self, read_clock, filled_seen);
        self.memory.write_clock.next = self.write_clock.val();
        self.memory.read_clock.next = self.read_clock.val();
        self.freed_seen.sent.next = self.freed.q.val();
        self.filled_seen.sent.next = self.filled.q.val();
        self.one.next = 1.into();
        self.one_address.next = 1.into();
        self.one_place.next = 1.into();
        self.most_used.next = 2612.into();

        self.write_mask.next = 1.into();
        match self.write_place.q.val().index() {
            1 => {
                self.write_mask.next = 2.into();
            }
            2 => {
                self.write_mask.next = 4.into();
            }
            3 => {
                self.write_mask.next = 8.into();
            }
            _ => {}
        }
        self.oldest_mask.next = 1.into();
        self.oldest_length.next = self.length0.q.val();
        match self.oldest.q.val().index() {
            1 => {
                self.oldest_mask.next = 2.into();
                self.oldest_length.next = self.length1.q.val();
            }
            2 => {
                self.oldest_mask.next = 4.into();
                self.oldest_length.next = self.length2.q.val();
            }
            3 => {
                self.oldest_mask.next = 8.into();
                self.oldest_length.next = self.length3.q.val();
            }
            _ => {}
        }
        self.byte_ready.next = self.has_room.q.val();
        self.takes.next = self.byte_valid.val() & self.has_room.q.val();
        self.ends.next = self.takes.val() & self.byte_is_last.val();
        self.after_byte.next = self.count.q.val() + self.one.val();
        self.after_address.next = self.next_address.q.val() + self.one_address.val();
        self.memory.write_address.next = self.next_address.q.val();
        self.memory.write_data.next = self.byte_data.val();
        self.memory.write_enable.next = self.takes.val();
        self.is_freed.next = (self.counted.q.val() & self.oldest_mask.val()).any()
            & (!((self.filled.q.val() ^ self.freed_seen.received.val()) & self.oldest_mask.val()).any());
        // Bytes are not counted off in a clock that ends a datagram, or `used` would have to change twice at once.
        // The bytes under way need no count: there was room for the longest datagram when the first of them came.
        self.has_room.d.next = self.has_room.q.val()
            | ((self.used.q.val() <= self.most_used.val()) & (!(self.counted.q.val() & self.write_mask.val()).any()));
        if self.takes.val() {
            self.count.d.next = self.after_byte.val();
            self.next_address.d.next = self.after_address.val();
        }
        if self.ends.val() {
            self.has_room.d.next = false;
            self.count.d.next = 0.into();
            self.first_address.d.next = self.after_address.val();
            self.filled.d.next = self.filled.q.val() ^ self.write_mask.val();
            self.counted.d.next = self.counted.q.val() | self.write_mask.val();
            self.used.d.next = self.used.q.val() + bit_cast::<13, 11>(self.after_byte.val());
            self.write_place.d.next = self.write_place.q.val() + self.one_place.val();
            match self.write_place.q.val().index() {
                1 => {
                    self.length1.d.next = self.after_byte.val();
                }
                2 => {
                    self.length2.d.next = self.after_byte.val();
                }
                3 => {
                    self.length3.d.next = self.after_byte.val();
                }
                _ => {
                    self.length0.d.next = self.after_byte.val();
                }
            }
        } else {
            if self.is_freed.val() {
                self.counted.d.next = self.counted.q.val() ^ self.oldest_mask.val();
                self.used.d.next = self.used.q.val() - bit_cast::<13, 11>(self.oldest_length.val());
                self.oldest.d.next = self.oldest.q.val() + self.one_place.val();
            }
        }
        if self.byte_drops.val() {
            self.count.d.next = 0.into();
            self.next_address.d.next = self.first_address.q.val();
        }
        if self.write_reset.val() {
            self.count.d.next = 0.into();
            self.filled.d.next = 0.into();
            self.counted.d.next = 0.into();
            self.used.d.next = 0.into();
            self.has_room.d.next = false;
            self.write_place.d.next = 0.into();
            self.oldest.d.next = 0.into();
            self.first_address.d.next = 0.into();
            self.next_address.d.next = 0.into();
        }

        self.read_mask.next = 1.into();
        self.read_length.next = self.length0.q.val();
        match self.read_place.q.val().index() {
            1 => {
                self.read_mask.next = 2.into();
                self.read_length.next = self.length1.q.val();
            }
            2 => {
                self.read_mask.next = 4.into();
                self.read_length.next = self.length2.q.val();
            }
            3 => {
                self.read_mask.next = 8.into();
                self.read_length.next = self.length3.q.val();
            }
            _ => {}
        }
        self.length.next = self.read_length.val();
        self.holds.next = ((self.freed.q.val() ^ self.filled_seen.received.val()) & self.read_mask.val()).any();
        self.memory.read_address.next = bit_cast::<12, 11>(self.read_index.val()) + self.read_address.q.val();
        self.memory.read_enable.next = true;
        self.read_data.next = self.memory.read_data.val();
        if self.lets_go.val() {
            self.freed.d.next = self.freed.q.val() ^ self.read_mask.val();
            self.read_place.d.next = self.read_place.q.val() + self.one_place.val();
            self.read_address.d.next = self.read_address.q.val() + bit_cast::<12, 11>(self.read_length.val());
        }
        if self.read_reset.val() {
            self.freed.d.next = 0.into();
            self.read_place.d.next = 0.into();
            self.read_address.d.next = 0.into();
        }
    }
}
