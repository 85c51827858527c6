//! Collects the events that end the items of a run of changes, and says whether an item can begin.
//!
//! 1. An item can begin in a clock in which no completed visit may ask for visits, no other context would start, no
//!    hole asks for a test, and no context asks for a solo insertion or is at one. So the queue of visits takes one
//!    bundle a clock. While the point of a move in place waits, no item begins whose vertex goes back into the mesh.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{
    Arrival, ChangeEvents, CommitJob, CommitRequest, Committed, ContextState, FillEnd, Moving, Outcome, SoloProgress,
    Start, VertexId,
};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct ChangeView {
    /// The consequences of the visit that completes, the ring that it completes, and the vertex of its context.
    pub outcome: Signal<In, Outcome>,
    pub commit: Signal<In, CommitRequest>,
    pub vertex: Signal<In, VertexId>,
    /// Ids are kept for that vertex, or for that of a solo insertion at work.
    pub owns: Signal<In, Bit>,
    /// The completed visit may ask for visits.
    pub may_ask: Signal<In, Bit>,
    pub committed: Signal<In, Committed>,
    pub solo: Signal<In, SoloProgress>,
    pub contexts: Signal<In, ContextState>,
    /// A context that starts without an item, for the vertex that it takes.
    pub start: Signal<In, Start>,
    /// Such a context starts in this clock if the queue is free; a hole asks for a test.
    pub wishes: Signal<In, Bit>,
    pub fill_asks: Signal<In, Bit>,
    /// The visit that completes is one of a deletion, or of a move whose vertex is in the mesh; it ends a move in
    /// place; and a run of moves is under way.
    pub finds: Signal<In, Bit>,
    pub moved: Signal<In, Arrival>,
    pub moving: Signal<In, Moving>,
    /// The point of a move in place waits to be written, see [`LatePoint`](crate::engine::LatePoint), so no vertex may
    /// go back into the mesh.
    pub late_waits: Signal<In, Bit>,
    /// A deletion whose last write is requested; and a hole that is full, which ends no item of a move, or flat.
    pub erased: Signal<In, Committed>,
    pub fill_end: Signal<In, FillEnd>,
    pub events: Signal<Out, ChangeEvents>,
    job: Signal<Local, CommitJob>,
    erased_job: Signal<Local, CommitJob>,
}

impl Logic for ChangeView {
    #[hdl_gen]
    fn update(&mut self) {
        self.job.next = self.committed.val().job;
        self.events.next.hands_over = self.commit.val().valid;
        self.events.next.duplicate = self.outcome.val().duplicate;
        self.events.next.owns = self.owns.val();
        self.events.next.is_root = self.outcome.val().root_enable;
        self.events.next.vertex = self.vertex.val();
        self.events.next.commit_ends = self.committed.val().valid;
        self.events.next.committed_context = self.job.val().context;
        self.events.next.committed_vertex = self.job.val().vertex;
        self.erased_job.next = self.erased.val().job;
        self.events.next.finds = self.finds.val();
        self.events.next.moves_in_place = self.moved.val().came;
        self.events.next.puts_out = self.erased.val().valid & self.moving.val().runs;
        self.events.next.put_out_context = self.erased_job.val().context;
        if self.erased.val().valid & (!self.moving.val().runs) {
            self.events.next.commit_ends = true;
            self.events.next.committed_context = self.erased_job.val().context;
            self.events.next.committed_vertex = self.erased_job.val().vertex;
        }
        self.events.next.fill_ends =
            self.fill_end.val().valid & (self.fill_end.val().is_flat | (!self.moving.val().runs));
        self.events.next.fill_is_flat = self.fill_end.val().valid & self.fill_end.val().is_flat;
        self.events.next.fill_context = self.fill_end.val().context;
        self.events.next.fill_vertex = self.fill_end.val().vertex;
        self.events.next.solo_ends = self.solo.val().ends;
        self.events.next.solo_inserts = self.solo.val().inserts;
        self.events.next.solo_context = self.solo.val().context;
        self.events.next.takes = self.start.val().takes;
        self.events.next.taken = self.start.val().id;
        self.events.next.may_launch = (!self.may_ask.val())
            & (!self.wishes.val())
            & (!self.fill_asks.val())
            & (!(self.late_waits.val() & self.moving.val().returns))
            & (!self.contexts.val().solo_valid)
            & (!self.solo.val().is_at_work);
        self.events.next.all_rest = self.contexts.val().all_rest;
    }
}
