//! The digest of a session: the check sum over all payload that the device has taken, by which the host finds a
//! fault beyond the line.
//!
//! 1. At least 9 clocks lie between two `push`, between the last `push` and `commits`, and between `begins` and either
//!    of them; but a `push` or `commits` may follow `begins` in the next clock.
//! 2. At least 2 clocks lie between a reset and the first `push`: the check sum takes the first state from the register
//!    of the bytes that count, which spares a choice of two values for each of 32 bits.
//!
//! Latency: 1 clock from `commits`.

use super::crc32::Crc32;
use super::types::Byte;
use crate::commands::types::Word;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct PayloadDigest {
    pub clock: Signal<In, Clock>,
    /// A reset begins the digest anew.
    pub reset: Signal<In, Bit>,
    /// Forget the bytes that do not count yet.
    pub begins: Signal<In, Bit>,
    /// Take one more byte, which does not count until `commits`.
    pub push: Signal<In, Bit>,
    pub push_data: Signal<In, Byte>,
    /// All bytes that were pushed count.
    pub commits: Signal<In, Bit>,
    /// State of the check sum over all bytes that count.
    pub state: Signal<Out, Word>,
    committed: DFF<Word>,
    was_reset: DFF<Bit>,
    crc: Crc32,
    first_state: Signal<Local, Word>,
}

const _: () = assert!(Crc32::FIRST == 0xffff_ffff, "the literal of this block follows the check sum");

impl Logic for PayloadDigest {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, committed, was_reset);
        clock!(self, clock, crc);
        self.first_state.next = 0xffff_ffffu64.into();
        self.state.next = self.committed.q.val();
        self.crc.takes.next = self.push.val();
        self.crc.byte_data.next = self.push_data.val();
        self.was_reset.d.next = self.reset.val();
        self.crc.sets.next = self.begins.val() | self.was_reset.q.val();
        self.crc.start.next = self.committed.q.val();
        if self.commits.val() & (!self.crc.is_busy.val()) {
            self.committed.d.next = self.crc.state.val();
        }
        if self.reset.val() {
            self.committed.d.next = self.first_state.val();
        }
    }
}
