//! The check sum of all payload that was taken in a session.
//!
//! 1. `push`, and `commits` after it, come at least 9 clocks apart; so do `begins` and what follows it, or it follows the next clock.
//!
//! Latency: 1 clock from `commits`.

use super::crc32::Crc32;
use super::types::Byte;
use crate::commands::types::Word;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The digest of a session; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct PayloadDigest {
    pub clock: Signal<In, Clock>,
    /// Reset begins anew.
    pub reset: Signal<In, Bit>,
    /// Forget the bytes that do not count yet.
    pub begins: Signal<In, Bit>,
    /// One more byte, which does not count yet.
    pub push: Signal<In, Bit>,
    pub push_data: Signal<In, Byte>,
    /// All bytes count.
    pub commits: Signal<In, Bit>,
    /// State of the check sum over all bytes that count.
    pub state: Signal<Out, Word>,
    committed: DFF<Word>,
    crc: Crc32,
    first_state: Signal<Local, Word>,
}

const _: () = assert!(Crc32::FIRST == 0xffff_ffff, "the literal of this block follows the check sum");

impl Logic for PayloadDigest {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, committed);
        clock!(self, clock, crc);
        self.first_state.next = 0xffff_ffffu64.into();
        self.state.next = self.committed.q.val();
        self.crc.takes.next = self.push.val();
        self.crc.byte_data.next = self.push_data.val();
        self.crc.sets.next = self.begins.val() | self.reset.val();
        self.crc.start.next = self.committed.q.val();
        if self.commits.val() & (!self.crc.is_busy.val()) {
            self.committed.d.next = self.crc.state.val();
        }
        if self.reset.val() {
            self.crc.start.next = self.first_state.val();
            self.committed.d.next = self.first_state.val();
        }
    }
}
