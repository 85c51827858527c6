//! The events that end items of changes, one clock after they have happened, with what [`ChangeEnds`] has to know of
//! the visit that completed in their clock.
//!
//! 1. The events follow from a visit that completes, and settle late in their clock. What comes of them can wait:
//!    parts, items that begin, marks of vertices, and vertices that go back into the mesh.
//! 2. `is_root`, `may_launch` and `all_rest` belong to the clock in which they are used, so they do not pass here.
//!
//! Latency: 1 clock.
//!
//! [`ChangeEnds`]: super::ChangeEnds

use crate::engine::types::{ChangeEvents, ContextId, VertexId};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct LateEvents {
    pub clock: Signal<In, Clock>,
    /// Reset drops the events.
    pub reset: Signal<In, Bit>,
    pub events: Signal<In, ChangeEvents>,
    /// The context of the visit that completes, and the corner that the visit has met.
    pub context_id: Signal<In, ContextId>,
    pub corner: Signal<In, VertexId>,
    /// All of these, a clock later.
    pub late: Signal<Out, ChangeEvents>,
    pub late_context: Signal<Out, ContextId>,
    pub late_corner: Signal<Out, VertexId>,
    kept: DFF<ChangeEvents>,
    kept_context: DFF<ContextId>,
    kept_corner: DFF<VertexId>,
}

impl Logic for LateEvents {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, kept, kept_context, kept_corner);
        self.kept.d.next = self.events.val();
        self.kept.d.next.is_root = false;
        self.kept.d.next.may_launch = false;
        self.kept.d.next.all_rest = false;
        self.kept_context.d.next = self.context_id.val();
        self.kept_corner.d.next = self.corner.val();
        self.late.next = self.kept.q.val();
        self.late_context.next = self.kept_context.q.val();
        self.late_corner.next = self.kept_corner.q.val();
        if self.reset.val() {
            self.kept.d.next.hands_over = false;
            self.kept.d.next.duplicate = false;
            self.kept.d.next.commit_ends = false;
            self.kept.d.next.solo_ends = false;
            self.kept.d.next.solo_inserts = false;
            self.kept.d.next.takes = false;
            self.kept.d.next.fill_ends = false;
            self.kept.d.next.fill_is_flat = false;
            self.kept.d.next.moves_in_place = false;
            self.kept.d.next.puts_out = false;
        }
    }
}
