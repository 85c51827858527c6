//! A record as the three words of an answer.
//!
//! Latency: none (combinational).

use crate::mesh::Record;
use rust_hdl_core::prelude::*;

/// Words of a record; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct RecordWords {
    pub record: Signal<In, Record>,
    /// `v[k]` in bits 0 to 14, `n[k]` in bits 15 to 29; bit 31 of word 0 is the lock bit.
    pub word0: Signal<Out, Bits<32>>,
    pub word1: Signal<Out, Bits<32>>,
    pub word2: Signal<Out, Bits<32>>,
    lock: Signal<Local, Bits<32>>,
    vertex0: Signal<Local, Bits<32>>,
    vertex1: Signal<Local, Bits<32>>,
    vertex2: Signal<Local, Bits<32>>,
    link0: Signal<Local, Bits<32>>,
    link1: Signal<Local, Bits<32>>,
    link2: Signal<Local, Bits<32>>,
    high0: Signal<Local, Bits<32>>,
    high1: Signal<Local, Bits<32>>,
    high2: Signal<Local, Bits<32>>,
    link_shift: Signal<Local, Bits<32>>,
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
