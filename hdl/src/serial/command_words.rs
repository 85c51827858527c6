//! Joins the bytes of the payload into the words of the core's command stream, the low byte first.
//!
//! 1. A word on offer stays until the core takes it.
//!
//! Latency: 1 clock from the fourth byte.
//!
//! A word that has to wait; `takes` is high where a byte is taken:
//! ```text
//! byte_valid      ___/^^^^^^^^^^^^^^^^^^^^^^^^^^
//! byte_data         5  5  0  0  0  7  7  7  7  0
//! takes           ___/^^^^^^^^^^^\________/^^^^^
//! word_valid      _______________/^^^^^^^^\_____
//! word_ready      _____________________/^^^^^^^^
//! word              .  .  .  .  .  5  5  5  .  .
//! ```

use super::types::Byte;
use crate::commands::types::Word;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct CommandWords {
    pub clock: Signal<In, Clock>,
    /// A reset forgets the bytes of an unfinished word.
    pub reset: Signal<In, Bit>,
    /// A byte of the payload; the block takes the byte at the edge at which `takes` is high.
    pub byte_valid: Signal<In, Bit>,
    pub byte_data: Signal<In, Byte>,
    pub takes: Signal<Out, Bit>,
    /// A word for the core.
    pub word_valid: Signal<Out, Bit>,
    pub word_ready: Signal<In, Bit>,
    pub word: Signal<Out, Word>,
    bytes: DFF<Word>,
    count: DFF<Bits<2>>,
    is_full: DFF<Bit>,
    takes_byte: Signal<Local, Bit>,
    older: Signal<Local, Word>,
    wide: Signal<Local, Word>,
    newest: Signal<Local, Word>,
    eight: Signal<Local, Word>,
    three_bytes: Signal<Local, Word>,
    one: Signal<Local, Bits<2>>,
    last: Signal<Local, Bits<2>>,
}

impl Logic for CommandWords {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, bytes, count, is_full);
        self.eight.next = 8.into();
        self.three_bytes.next = 24.into();
        self.one.next = 1.into();
        self.last.next = 3.into();
        self.word_valid.next = self.is_full.q.val();
        self.word.next = self.bytes.q.val();
        self.takes_byte.next = self.byte_valid.val() & (!self.is_full.q.val());
        self.takes.next = self.takes_byte.val();
        self.older.next = self.bytes.q.val() >> self.eight.val();
        self.wide.next = bit_cast::<32, 8>(self.byte_data.val());
        self.newest.next = self.wide.val() << self.three_bytes.val();
        if self.word_ready.val() {
            self.is_full.d.next = false;
        }
        if self.takes_byte.val() {
            self.bytes.d.next = self.older.val() | self.newest.val();
            self.count.d.next = self.count.q.val() + self.one.val();
            self.is_full.d.next = self.count.q.val() == self.last.val();
        }
        if self.reset.val() {
            self.count.d.next = 0.into();
            self.is_full.d.next = false;
        }
    }
}
