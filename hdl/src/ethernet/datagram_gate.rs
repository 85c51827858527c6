//! Passes the datagrams for this device into the FIFO that carries them to the core's clock.
//!
//! 1. A datagram is 12 bytes of its sender (Ethernet address, IPv4 address, UDP port, each highest byte first), its
//!    payload, and an entry that ends it. An entry is a byte, or an end if bit 8 is set.
//! 2. Bytes pass before the frame is known to be sound and for this device. So the end says in bit 0 whether the
//!    datagram counts: if not, the reader forgets its bytes, which may be any number from 1. In bit 1 the end says that
//!    the datagram came to all devices.
//! 3. A frame of which no byte passed has no end.
//! 4. If the FIFO is full, the datagram loses the rest of its bytes and does not count. Its end waits for room, and
//!    what comes before there is room is lost as a whole.
//!
//! 5. What comes between a reset and the next frame that begins does not pass.
//!
//! Latency: none from a byte to its entry; 1 clock from the end of a frame to the entry that ends it.
//!
//! A byte of the sender, one that does not count, the one byte of the payload, and a byte behind it. The end waits for
//! room:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8  9
//! begins          /^^\__________________________
//! head_valid      ___/^^^^^^^^\__/^^\___________
//! is_peer           ./^^\_____  .___  .  .  .  .
//! is_payload        .______/^^  ./^^  .  .  .  .
//! has_more          ./^^^^^^^^  .___  .  .  .  .
//! ends            __________________/^^\________
//! is_full         __________________/^^^^^\_____
//! push            ___/^^\__/^^\________/^^^^^\__
//! entry[8]          .___  .___  .  .  ./^^^^^  .
//! entry[7:0]        . 25  . 70  .  .  .  1  1  .
//! ```

use super::types::{DatagramState, HeadByte, Kinds, Roles};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct DatagramGate {
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// A frame begins.
    pub begins: Signal<In, Bit>,
    /// A byte of the frame, and what is known of the frame before this byte.
    pub head_valid: Signal<In, Bit>,
    pub head: Signal<In, HeadByte>,
    pub kinds: Signal<In, Kinds>,
    pub state: Signal<In, DatagramState>,
    /// The frame has ended.
    pub ends: Signal<In, Bit>,
    pub is_sound: Signal<In, Bit>,
    /// An entry, which is taken unless `is_full` is high.
    pub push: Signal<Out, Bit>,
    pub entry: Signal<Out, Bits<9>>,
    pub is_full: Signal<In, Bit>,
    has_passed: DFF<Bit>,
    is_lost: DFF<Bit>,
    owes_end: DFF<Bit>,
    verdict: DFF<Bits<9>>,
    roles: Signal<Local, Roles>,
    passes: Signal<Local, Bit>,
    end_bit: Signal<Local, Bits<9>>,
    count_bit: Signal<Local, Bits<9>>,
    all_bit: Signal<Local, Bits<9>>,
}

impl Logic for DatagramGate {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, has_passed, is_lost, owes_end, verdict);
        self.roles.next = self.head.val().roles;
        self.passes.next = self.head_valid.val()
            & self.kinds.val().is_udp
            & (!self.is_lost.q.val())
            & (self.roles.val().is_peer | (self.roles.val().is_payload & self.state.val().has_more));
        self.push.next = self.passes.val() | self.owes_end.q.val();
        self.entry.next = bit_cast::<9, 8>(self.head.val().data);
        if self.owes_end.q.val() {
            self.entry.next = self.verdict.q.val();
            self.owes_end.d.next = self.is_full.val();
        }
        if self.passes.val() {
            self.has_passed.d.next = !self.is_full.val() | self.has_passed.q.val();
            self.is_lost.d.next = self.is_full.val();
        }
        self.end_bit.next = 0x100.into();
        self.count_bit.next = 0.into();
        self.all_bit.next = 0.into();
        if self.is_sound.val()
            & self.kinds.val().is_udp
            & self.state.val().header_is_right
            & self.state.val().is_whole
            & self.state.val().udp_is_right
            & (!self.is_lost.q.val())
        {
            self.count_bit.next = 1.into();
        }
        if self.kinds.val().is_to_all {
            self.all_bit.next = 2.into();
        }
        if self.ends.val() {
            if self.has_passed.q.val() {
                self.owes_end.d.next = true;
                self.verdict.d.next = self.end_bit.val() | self.count_bit.val() | self.all_bit.val();
            }
            self.has_passed.d.next = false;
        }
        if self.begins.val() {
            self.has_passed.d.next = false;
            self.is_lost.d.next = self.owes_end.q.val() & self.is_full.val();
        }
        if self.reset.val() {
            self.has_passed.d.next = false;
            self.owes_end.d.next = false;
            self.is_lost.d.next = true;
        }
    }
}
