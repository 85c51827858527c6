//! The write that a solo insertion makes in each phase.
//!
//! Latency: none, the block is combinational.

use super::star_state::{Beyond, SoloTurn, StarTriangle};
use crate::engine::types::{Slot, TriangleId, Turned, VertexId, Write};
use crate::engine::write::{LinkWrite, RecordWrite};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct SoloWrites {
    /// The write that is due. If none is, `write` is a link: from the visited record to the star record at work
    /// (`is_test`), or else from the following star record to the outside record.
    pub turn: Signal<In, SoloTurn>,
    pub is_test: Signal<In, Bit>,
    /// The new vertex, which is in every record of the star.
    pub vertex: Signal<In, VertexId>,
    /// The two new ids.
    pub second: Signal<In, TriangleId>,
    pub third: Signal<In, TriangleId>,
    /// The located record: its id and its content.
    pub root_id: Signal<In, TriangleId>,
    pub root: Signal<In, Turned>,
    /// The star record at work, and the record outside it.
    pub triangle: Signal<In, StarTriangle>,
    pub beyond: Signal<In, Beyond>,
    /// The record visited, and its slot that leads back.
    pub visited: Signal<In, TriangleId>,
    pub slot: Signal<In, Slot>,
    /// The record or the link to write.
    pub write: Signal<Out, Write>,
    record: RecordWrite,
    link: LinkWrite,
}

impl Logic for SoloWrites {
    #[hdl_gen]
    fn update(&mut self) {
        // The third record of the split is the default, so that the other cases change only what differs.
        self.record.id.next = self.third.val();
        self.record.v0.next = self.vertex.val();
        self.record.v1.next = self.root.val().v0;
        self.record.v2.next = self.root.val().v1;
        self.record.n0.next = self.root.val().n2;
        self.record.n1.next = self.root_id.val();
        self.record.n2.next = self.second.val();
        if self.turn.val().split1 {
            self.record.id.next = self.root_id.val();
            self.record.v1.next = self.root.val().v1;
            self.record.v2.next = self.root.val().v2;
            self.record.n0.next = self.root.val().n0;
            self.record.n1.next = self.second.val();
            self.record.n2.next = self.third.val();
        }
        if self.turn.val().split2 {
            self.record.id.next = self.second.val();
            self.record.v1.next = self.root.val().v2;
            self.record.v2.next = self.root.val().v0;
            self.record.n0.next = self.root.val().n1;
            self.record.n1.next = self.third.val();
            self.record.n2.next = self.root_id.val();
        }
        if self.turn.val().flip1 {
            self.record.id.next = self.triangle.val().id;
            self.record.v1.next = self.triangle.val().a;
            self.record.v2.next = self.beyond.val().apex;
            self.record.n0.next = self.beyond.val().apex_after_a;
            self.record.n1.next = self.triangle.val().outer;
            self.record.n2.next = self.triangle.val().preceding;
        }
        if self.turn.val().flip2 {
            self.record.id.next = self.triangle.val().outer;
            self.record.v1.next = self.beyond.val().apex;
            self.record.v2.next = self.triangle.val().b;
            self.record.n0.next = self.beyond.val().apex_before_b;
            self.record.n1.next = self.triangle.val().after;
            self.record.n2.next = self.triangle.val().id;
        }

        // A flip gives the second star record the id of the outside record, so the following star record must learn
        // that id as its neighbour.
        self.link.id.next = self.triangle.val().after;
        self.link.slot.next = 2.into();
        self.link.value.next = self.triangle.val().outer;
        if self.is_test.val() {
            self.link.id.next = self.visited.val();
            self.link.slot.next = self.slot.val();
            self.link.value.next = self.triangle.val().id;
        }
        if self.turn.val().mend1 {
            self.link.id.next = self.visited.val();
            self.link.slot.next = self.slot.val();
            self.link.value.next = self.second.val();
        }
        if self.turn.val().mend2 {
            self.link.id.next = self.visited.val();
            self.link.slot.next = self.slot.val();
            self.link.value.next = self.third.val();
        }

        self.write.next = self.link.write.val();
        if self.turn.val().split1
            | self.turn.val().split2
            | self.turn.val().split3
            | self.turn.val().flip1
            | self.turn.val().flip2
        {
            self.write.next = self.record.write.val();
        }
    }
}
