//! The two forms of a write into the triangle memory: a whole record of the new vertex's star, and one link. Several
//! blocks make such writes, so the columns are filled in here.
//!
//! Latency: none, the blocks are combinational.

use crate::engine::types::{Slot, TriangleId, VertexId, Write};
use rust_hdl_core::prelude::*;

/// The request that writes a whole record.
#[derive(LogicBlock, Default)]
pub struct RecordWrite {
    /// The id of the record, its vertices, and its neighbours.
    pub id: Signal<In, TriangleId>,
    pub v0: Signal<In, VertexId>,
    pub v1: Signal<In, VertexId>,
    pub v2: Signal<In, VertexId>,
    pub n0: Signal<In, TriangleId>,
    pub n1: Signal<In, TriangleId>,
    pub n2: Signal<In, TriangleId>,
    /// The write of the whole record.
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

/// The request that writes one link of a record.
#[derive(LogicBlock, Default)]
pub struct LinkWrite {
    /// The record, and the slot of the link that is written.
    pub id: Signal<In, TriangleId>,
    pub slot: Signal<In, Slot>,
    /// The neighbour that the link names from now on.
    pub value: Signal<In, TriangleId>,
    /// The write of this slot alone; `value` is in all three slots, because the enables choose one.
    pub write: Signal<Out, Write>,
    slot0: Signal<Local, Slot>,
    slot1: Signal<Local, Slot>,
    slot2: Signal<Local, Slot>,
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
