//! The changes of a mesh that stands: runs of `InsertAs`, `Delete` and `Move`, and all points of an `Insert` that comes
//! after one.
//!
//! ```text
//! RunPort ----> VertexCheck --+--> ItemQueues -> launches: a context of the insertion engine starts
//! Insert -----> LatePoints ---+                                       |
//! PartQueue <-- ChangeEnds <--- LateEvents <--- events ---------------+
//! ```
//! 1. An item is an insertion of the insertion engine: its context walks, locks its root, grows its cavity, and hands
//!    its ring over; the rules L1 to L10 keep the contexts apart. An attempt that aborts is retried by the engine, and
//!    the item stays the one of its context until it ends.
//! 2. From the first item on until the next clear (`has_changed`), contexts take no points by themselves.
//! 3. From then on, a point of an `Insert` becomes an item too, and gets no part.
//!
//! Latency: that of the blocks in it.

use super::change_ends::ChangeEnds;
use super::late_points::LatePoints;
use super::types::{ContextEnd, DealtItem, Item, ItemNumber, Launch, PartCame};
use super::vertex_check::VertexCheck;
use crate::commands::types::{VertexCount, Word};
use crate::engine::types::{Arrival, ChangeEvents, ContextId, VertexId};
use crate::predicate::Point;
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct Changes {
    pub clock: Signal<In, Clock>,
    /// Reset drops all items; `clears` forgets the mesh.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// Number of vertices that the core holds, a constant; number of ids in use; number of contexts that work.
    pub capacity: Signal<In, VertexCount>,
    pub arrived: Signal<In, VertexCount>,
    pub contexts: Signal<In, ContextId>,
    /// A point of an `Insert` comes.
    pub arrival: Signal<In, Arrival>,
    /// A run is under way; it is one of changes, and which.
    pub is_active: Signal<In, Bit>,
    pub is_change: Signal<In, Bit>,
    pub is_delete: Signal<In, Bit>,
    pub is_move: Signal<In, Bit>,
    /// The item on offer, its vertex, and whether it is done with; the item for the queues, and whether they take it.
    pub dealt: Signal<In, DealtItem>,
    pub vertex: Signal<In, Word>,
    pub taken: Signal<Out, Bit>,
    pub queued: Signal<Out, DealtItem>,
    pub accepted: Signal<In, Bit>,
    /// No context has an item.
    pub queues_rest: Signal<In, Bit>,
    /// The events of the clock before; the context of the visit that completed then, the number of its item, and the
    /// corner that the visit has met.
    pub events: Signal<In, ChangeEvents>,
    pub context_id: Signal<In, ContextId>,
    pub number: Signal<In, ItemNumber>,
    pub corner: Signal<In, VertexId>,
    /// An item begins at this edge; there is room for the part of one that is refused, and no other part takes it.
    pub launches: Signal<In, Bit>,
    pub launch: Signal<In, Launch>,
    pub has_room: Signal<In, Bit>,
    pub ends: Signal<Out, ContextEnd>,
    pub came: Signal<Out, PartCame>,
    /// The part that comes is that of an item that has not begun.
    pub is_noted: Signal<Out, Bit>,
    /// A run of changes is under way; the mesh has been changed since the last clear.
    pub runs: Signal<Out, Bit>,
    pub has_changed: Signal<Out, Bit>,
    /// Some point of an `Insert` is not finished; the last one still waits for its context.
    pub is_pending: Signal<Out, Bit>,
    pub point_waits: Signal<Out, Bit>,
    /// A vertex is in the mesh; or one falls out of use, and no item may begin.
    pub raises: Signal<Out, Bit>,
    pub raised: Signal<Out, VertexId>,
    pub unmarks: Signal<Out, Bit>,
    /// For a `Delete` or a `Move`, as the ports of [`VertexCheck`] of these names.
    pub wanted: Signal<Out, VertexId>,
    pub fetches: Signal<In, Bit>,
    pub fetched: Signal<In, Point>,
    check: VertexCheck,
    step: ChangeEnds,
    late: LatePoints,
    changed: DFF<Bit>,
    /// An item that belongs to no run has begun, and its vertex is not marked yet.
    begun: DFF<Bit>,
    begun_vertex: DFF<VertexId>,
    marks_begun: Signal<Local, Bit>,
    hole_runs: Signal<Local, Bit>,
    item: Signal<Local, Item>,
    dealt_item: Signal<Local, Item>,
}

impl Changes {
    /// The changes of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        Self { check: VertexCheck::new(config), step: ChangeEnds::new(config), ..Self::default() }
    }
}

impl Logic for Changes {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, changed, begun, begun_vertex);
        clock!(self, clock, check, step, late);
        self.check.reset.next = self.reset.val();
        self.step.reset.next = self.reset.val();
        self.late.reset.next = self.reset.val();
        self.check.clears.next = self.clears.val();
        self.late.clears.next = self.clears.val();
        self.hole_runs.next = self.is_delete.val() | self.is_move.val();
        self.runs.next = self.is_change.val();
        self.has_changed.next = self.changed.q.val();
        self.item.next = self.launch.val().item;
        self.dealt_item.next = self.dealt.val().item;

        self.check.capacity.next = self.capacity.val();
        self.check.arrived.next = self.arrived.val();
        self.check.dealt.next = self.dealt.val();
        self.check.is_change.next = self.is_change.val();
        self.check.vertex.next = self.vertex.val();
        self.check.accepted.next = self.accepted.val() & self.is_active.val();
        self.check.is_noted.next = self.step.is_noted.val();
        self.check.hole_runs.next = self.hole_runs.val();
        self.check.fetches.next = self.fetches.val();
        self.check.fetched.next = self.fetched.val();
        self.wanted.next = self.check.wanted.val();
        // The vertex of an item of a run has been marked by its check. That of another item waits for a clock in which
        // none falls out of use. The next item begins in such a clock at the earliest, so one place is enough.
        self.begun.d.next =
            (self.launches.val() & (!self.is_active.val())) | (self.begun.q.val() & self.step.unmarks.val());
        if self.launches.val() {
            self.begun_vertex.d.next = self.item.val().vertex;
        }
        self.marks_begun.next = self.begun.q.val() & (!self.step.unmarks.val());
        self.check.marks.next = self.marks_begun.val() | self.events.val().takes | self.step.remarks.val();
        self.check.marked.next = self.events.val().taken;
        if self.begun.q.val() {
            self.check.marked.next = self.begun_vertex.q.val();
        }
        if self.step.remarks.val() {
            self.check.marked.next = self.step.remarked.val();
        }
        self.unmarks.next = self.step.unmarks.val();
        self.check.unmarks.next = self.step.unmarks.val();
        self.check.unmarked.next = self.step.unmarked.val();
        self.check.unmarked_owns.next = self.events.val().owns;
        self.taken.next = self.check.taken.val();

        self.late.has_changed.next = self.changed.q.val();
        self.late.contexts.next = self.contexts.val();
        self.late.arrival.next = self.arrival.val();
        self.late.taken.next = self.accepted.val() & (!self.is_active.val());
        self.point_waits.next = self.late.holds.val();
        self.is_pending.next =
            (!self.is_active.val()) & (self.arrival.val().came | self.late.holds.val() | (!self.queues_rest.val()));
        self.queued.next = self.late.dealt.val();
        if self.is_active.val() {
            self.queued.next = self.check.offered.val();
        }

        self.step.hole_runs.next = self.hole_runs.val();
        self.step.is_move.next = self.is_move.val();
        self.step.runs.next = self.is_change.val();
        self.step.events.next = self.events.val();
        self.step.context_id.next = self.context_id.val();
        self.step.number.next = self.number.val();
        self.step.corner.next = self.corner.val();
        self.step.refuses.next = self.check.refuses.val();
        self.step.is_beyond.next = self.check.is_beyond.val();
        self.step.refused_number.next = self.dealt_item.val().number;
        self.step.refused_vertex.next = self.vertex.val();
        self.step.has_room.next = self.has_room.val();
        self.is_noted.next = self.step.is_noted.val();
        self.ends.next.valid = self.step.ends.val().valid & self.changed.q.val();
        self.ends.next.context = self.step.ends.val().context;
        self.came.next = self.step.came.val();
        self.raises.next = self.step.raises.val();
        self.raised.next = self.step.raised.val();

        if self.launches.val() {
            self.changed.d.next = true;
        }
        if self.reset.val() | self.clears.val() {
            self.changed.d.next = false;
            self.begun.d.next = false;
        }
    }
}
