//! The writes of an insertion alone, by what it does.
//!
//! Latency: none (combinational).

use crate::engine::types::{Turned, Write};
use crate::engine::write::{LinkWrite, RecordWrite};
use rust_hdl_core::prelude::*;

/// Writes of an insertion alone; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct SoloWrites {
    /// The split writes its first, second, third record.
    pub split1: Signal<In, Bit>,
    pub split2: Signal<In, Bit>,
    pub split3: Signal<In, Bit>,
    /// The flip writes its first, second record.
    pub flip1: Signal<In, Bit>,
    pub flip2: Signal<In, Bit>,
    /// A link is mended: the first or second after the split, or one after a test.
    pub mend1: Signal<In, Bit>,
    pub mend2: Signal<In, Bit>,
    pub is_test: Signal<In, Bit>,
    pub p: Signal<In, Bits<15>>,
    pub second: Signal<In, Bits<15>>,
    pub third: Signal<In, Bits<15>>,
    pub root_id: Signal<In, Bits<15>>,
    pub root: Signal<In, Turned>,
    /// The star triangle at work.
    pub id: Signal<In, Bits<15>>,
    pub a: Signal<In, Bits<15>>,
    pub b: Signal<In, Bits<15>>,
    pub outer: Signal<In, Bits<15>>,
    pub after: Signal<In, Bits<15>>,
    pub preceding: Signal<In, Bits<15>>,
    /// The triangle outside it, and its links beyond `a` and `b`.
    pub apex: Signal<In, Bits<15>>,
    pub apex_after_a: Signal<In, Bits<15>>,
    pub apex_before_b: Signal<In, Bits<15>>,
    /// The record visited and its slot that leads back.
    pub visited: Signal<In, Bits<15>>,
    pub slot: Signal<In, Bits<2>>,
    /// The write.
    pub write: Signal<Out, Write>,
    record: RecordWrite,
    link: LinkWrite,
}

impl Logic for SoloWrites {
    #[hdl_gen]
    fn update(&mut self) {
        // Records: the last of the split, unless something else is asked for.
        self.record.id.next = self.third.val();
        self.record.v0.next = self.p.val();
        self.record.v1.next = self.root.val().v0;
        self.record.v2.next = self.root.val().v1;
        self.record.n0.next = self.root.val().n2;
        self.record.n1.next = self.root_id.val();
        self.record.n2.next = self.second.val();
        if self.split1.val() {
            self.record.id.next = self.root_id.val();
            self.record.v1.next = self.root.val().v1;
            self.record.v2.next = self.root.val().v2;
            self.record.n0.next = self.root.val().n0;
            self.record.n1.next = self.second.val();
            self.record.n2.next = self.third.val();
        }
        if self.split2.val() {
            self.record.id.next = self.second.val();
            self.record.v1.next = self.root.val().v2;
            self.record.v2.next = self.root.val().v0;
            self.record.n0.next = self.root.val().n1;
            self.record.n1.next = self.third.val();
            self.record.n2.next = self.root_id.val();
        }
        if self.flip1.val() {
            self.record.id.next = self.id.val();
            self.record.v1.next = self.a.val();
            self.record.v2.next = self.apex.val();
            self.record.n0.next = self.apex_after_a.val();
            self.record.n1.next = self.outer.val();
            self.record.n2.next = self.preceding.val();
        }
        if self.flip2.val() {
            self.record.id.next = self.outer.val();
            self.record.v1.next = self.apex.val();
            self.record.v2.next = self.b.val();
            self.record.n0.next = self.apex_before_b.val();
            self.record.n1.next = self.after.val();
            self.record.n2.next = self.id.val();
        }

        // Links: that of the next star triangle to the flipped one, unless one is mended.
        self.link.id.next = self.after.val();
        self.link.slot.next = 2.into();
        self.link.value.next = self.outer.val();
        if self.is_test.val() {
            self.link.id.next = self.visited.val();
            self.link.slot.next = self.slot.val();
            self.link.value.next = self.id.val();
        }
        if self.mend1.val() {
            self.link.id.next = self.visited.val();
            self.link.slot.next = self.slot.val();
            self.link.value.next = self.second.val();
        }
        if self.mend2.val() {
            self.link.id.next = self.visited.val();
            self.link.slot.next = self.slot.val();
            self.link.value.next = self.third.val();
        }

        self.write.next = self.link.write.val();
        if self.split1.val() | self.split2.val() | self.split3.val() | self.flip1.val() | self.flip2.val() {
            self.write.next = self.record.write.val();
        }
    }
}
