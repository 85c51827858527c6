//! The writes of one job of [`HoleWriter`](super::HoleWriter): a triangle of a hole with its links, or the marks of the
//! two records that become free.
//!
//! 1. The triangle takes the id of the star's record at its apex. Its neighbours across the two sides are the records
//!    outside; where another triangle will stand on a side, that one sets the link in its turn.
//! 2. The second write links the record on the base back to the triangle, and the third the record outside the side
//!    that begins the interval. A job without that side has no third write.
//! 3. A free record has the infinite vertex three times and names the record of the second place (M8). The end of a
//!    deletion marks two of them, in its first two writes.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{FillJob, RingWord, Slot, TriangleId, VertexId, Write};
use crate::engine::write::{LinkWrite, RecordWrite};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct HoleRecords {
    pub infinite: Signal<In, VertexId>,
    /// The job, and the edges of the ring that begin at the beginning, the apex and the end of its interval.
    pub job: Signal<In, FillJob>,
    pub edge_i: Signal<In, RingWord>,
    pub edge_m: Signal<In, RingWord>,
    pub edge_j: Signal<In, RingWord>,
    /// The writes, in their order.
    pub first: Signal<Out, Write>,
    pub second: Signal<Out, Write>,
    pub third: Signal<Out, Write>,
    record: RecordWrite,
    link: LinkWrite,
    side: LinkWrite,
    is_ring_base: Signal<Local, Bit>,
    is_end_base: Signal<Local, Bit>,
    ring_base: Signal<Local, Bits<2>>,
    end_base: Signal<Local, Bits<2>>,
    first_slot: Signal<Local, Slot>,
    second_slot: Signal<Local, Slot>,
    apex_id: Signal<Local, TriangleId>,
}

impl Logic for HoleRecords {
    #[hdl_gen]
    fn update(&mut self) {
        self.ring_base.next = 0.into();
        self.end_base.next = 1.into();
        self.first_slot.next = 0.into();
        self.second_slot.next = 1.into();
        self.apex_id.next = self.edge_m.val().record;
        self.is_ring_base.next = self.job.val().base == self.ring_base.val();
        self.is_end_base.next = self.job.val().base == self.end_base.val();
        self.record.id.next = self.apex_id.val();
        self.record.v0.next = self.edge_j.val().vertex;
        self.record.v1.next = self.edge_i.val().vertex;
        self.record.v2.next = self.edge_m.val().vertex;
        self.record.n0.next = self.edge_i.val().outside;
        self.record.n1.next = self.edge_m.val().outside;
        self.record.n2.next = self.edge_i.val().record;
        self.link.id.next = self.edge_i.val().record;
        self.link.slot.next = self.second_slot.val();
        if self.is_end_base.val() {
            self.record.n2.next = self.edge_j.val().record;
            self.link.id.next = self.edge_j.val().record;
            self.link.slot.next = self.first_slot.val();
        }
        if self.is_ring_base.val() {
            self.record.n2.next = self.edge_j.val().outside;
            self.link.id.next = self.edge_j.val().outside;
            self.link.slot.next = self.edge_j.val().slot;
        }
        self.link.value.next = self.apex_id.val();
        self.side.id.next = self.edge_i.val().outside;
        self.side.slot.next = self.edge_i.val().slot;
        self.side.value.next = self.apex_id.val();
        if self.job.val().ends {
            self.record.id.next = self.edge_i.val().record;
            self.record.v0.next = self.infinite.val();
            self.record.v1.next = self.infinite.val();
            self.record.v2.next = self.infinite.val();
            self.record.n0.next = self.apex_id.val();
            self.record.n1.next = self.apex_id.val();
            self.record.n2.next = self.apex_id.val();
        }
        self.first.next = self.record.write.val();
        self.second.next = self.link.write.val();
        self.third.next = self.side.write.val();
        self.third.next.valid = self.job.val().mends;
        if self.job.val().ends {
            self.second.next = self.record.write.val();
            self.second.next.id = self.edge_j.val().record;
            self.third.next.valid = false;
        }
    }
}
