//! Packs a record into the three words of an answer.
//!
//! Latency: none (combinational) from a record to its words.

use super::types::Word;
use crate::mesh::Record;
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct RecordWords {
    pub record: Signal<In, Record>,
    /// Word `k`: `v[k]` in bits 0 to 14, `n[k]` in bits 15 to 29; bit 31 of word 0 is the lock bit.
    pub word0: Signal<Out, Word>,
    pub word1: Signal<Out, Word>,
    pub word2: Signal<Out, Word>,
    lock: Signal<Local, Word>,
    vertex0: Signal<Local, Word>,
    vertex1: Signal<Local, Word>,
    vertex2: Signal<Local, Word>,
    link0: Signal<Local, Word>,
    link1: Signal<Local, Word>,
    link2: Signal<Local, Word>,
    high0: Signal<Local, Word>,
    high1: Signal<Local, Word>,
    high2: Signal<Local, Word>,
    link_shift: Signal<Local, Word>,
}

impl Logic for RecordWords {
    #[hdl_gen]
    fn update(&mut self) {
        self.link_shift.next = 15.into();
        self.lock.next = 0.into();
        if self.record.val().was_set {
            self.lock.next = 0x8000_0000u64.into();
        }
        self.vertex0.next = bit_cast::<32, 15>(self.record.val().v0);
        self.vertex1.next = bit_cast::<32, 15>(self.record.val().v1);
        self.vertex2.next = bit_cast::<32, 15>(self.record.val().v2);
        self.link0.next = bit_cast::<32, 15>(self.record.val().n0);
        self.link1.next = bit_cast::<32, 15>(self.record.val().n1);
        self.link2.next = bit_cast::<32, 15>(self.record.val().n2);
        self.high0.next = self.link0.val() << self.link_shift.val();
        self.high1.next = self.link1.val() << self.link_shift.val();
        self.high2.next = self.link2.val() << self.link_shift.val();
        self.word0.next = self.vertex0.val() | self.high0.val() | self.lock.val();
        self.word1.next = self.vertex1.val() | self.high1.val();
        self.word2.next = self.vertex2.val() | self.high2.val();
    }
}
