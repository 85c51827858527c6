//! The two forms of a write into the triangle memory: a whole record of the new point's star, and one link.
//!
//! `RecordWrite`
//!
//! `LinkWrite`
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `id`, `slot` | in | 15, 2 | the record and the column of the link |
//! | `value` | in | 15 | the record it leads to |
//! | `write` | out | Write | writes this column alone; `value` stands on all three |
//!
//! Latency: none (combinational).

use crate::engine::types::Write;
use rust_hdl_core::prelude::*;

/// A whole record; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct RecordWrite {
    /// The record and the column of the link.
    pub id: Signal<In, Bits<15>>,
    /// Its columns.
    pub v0: Signal<In, Bits<15>>,
    pub v1: Signal<In, Bits<15>>,
    pub v2: Signal<In, Bits<15>>,
    pub n0: Signal<In, Bits<15>>,
    pub n1: Signal<In, Bits<15>>,
    pub n2: Signal<In, Bits<15>>,
    /// Writes this column alone; `value` stands on all three.
    pub write: Signal<Out, Write>,
}

impl Logic for RecordWrite {
    #[hdl_gen]
    fn update(&mut self) {
        self.write.next.valid = true;
        self.write.next.id = self.id.val();
        self.write.next.vertices = true;
        self.write.next.link0 = true;
        self.write.next.link1 = true;
        self.write.next.link2 = true;
        self.write.next.v0 = self.v0.val();
        self.write.next.v1 = self.v1.val();
        self.write.next.v2 = self.v2.val();
        self.write.next.n0 = self.n0.val();
        self.write.next.n1 = self.n1.val();
        self.write.next.n2 = self.n2.val();
    }
}

/// One link; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct LinkWrite {
    /// The record.
    pub id: Signal<In, Bits<15>>,
    /// The column.
    pub slot: Signal<In, Bits<2>>,
    /// The link.
    pub value: Signal<In, Bits<15>>,
    /// The write.
    pub write: Signal<Out, Write>,
    slot0: Signal<Local, Bits<2>>,
    slot1: Signal<Local, Bits<2>>,
    slot2: Signal<Local, Bits<2>>,
}

impl Logic for LinkWrite {
    #[hdl_gen]
    fn update(&mut self) {
        self.slot0.next = 0.into();
        self.slot1.next = 1.into();
        self.slot2.next = 2.into();
        self.write.next.valid = true;
        self.write.next.id = self.id.val();
        self.write.next.vertices = false;
        self.write.next.link0 = self.slot.val() == self.slot0.val();
        self.write.next.link1 = self.slot.val() == self.slot1.val();
        self.write.next.link2 = self.slot.val() == self.slot2.val();
        self.write.next.v0 = 0.into();
        self.write.next.v1 = 0.into();
        self.write.next.v2 = 0.into();
        self.write.next.n0 = self.value.val();
        self.write.next.n1 = self.value.val();
        self.write.next.n2 = self.value.val();
    }
}
