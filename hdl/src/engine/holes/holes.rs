//! The deletions of a run, and the moves up to the insertion of a vertex that has been put out of the mesh: from the
//! root of a star to the mark of the last free record, or to the point that a move in place writes.
//!
//! ```text
//! completed visits -> MovedVertex, StarCase, NamedVertex, KeptEdges
//!                                                |
//!                                                v
//!                                             StarStep -> StarVisits -> visits
//!                                                |  ^ |       ^
//!                                                |  | +-> StarOutcome -> entries, locks, releases
//!                                                v  StarStore | tests
//!                                             HoleStep -------+
//!                                                |
//!                         HoleRing <- entries    v
//!                             |              HoleFill -> tests, ends of items
//!                             v                  |
//!                         HoleWriter <-----------+
//!                             |
//!                             +-> records, links, marks, ids that a vertex keeps
//! ```
//! 1. In a run of deletions all visits that turn their record are this block's (`finds`), and in a run of moves those
//!    of a context whose vertex is in the mesh. Walks and roots are those of the attempts, which take a record that
//!    names the vertex for one that conflicts.
//! 2. An attempt that fails releases its locks: it has met a foreign lock (M4), or its ring is too long for the list,
//!    and then its item ends (`outcome.duplicate`).
//! 3. The item of a hole that is full ends when its last triangle is on its way; the locks are due at the last write
//!    (M6).
//! 4. A move in place ends its item when the test of its last edge completes, and gives its point to `LatePoint` then
//!    (M12).
//!
//! Latency: none (combinational) from a completed visit to `follow`, `outcome`, `lock` and `releases`.

use super::hole_fill::HoleFill;
use super::hole_ring::HoleRing;
use super::hole_step::HoleStep;
use super::hole_writer::HoleWriter;
use super::kept_edges::KeptEdges;
use super::moved_vertex::MovedVertex;
use super::named_vertex::NamedVertex;
use super::star_case::StarCase;
use super::star_outcome::StarOutcome;
use super::star_step::StarStep;
use super::star_store::StarStore;
use super::star_visits::StarVisits;
use super::test_visit::TestVisit;
use crate::engine::types::{
    Arrival, Bundle, Carried, Committed, Completion, FillEnd, Follow, KeptWrite, LockWrite, Moving, Outcome,
    ReleaseRequest, RingCount, RingEntry, Start, TestVertices, Turned, Upcoming, Verdict, VertexId, Visit, Write,
};
use crate::predicate::Sides;
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct Holes {
    pub clock: Signal<In, Clock>,
    /// Reset drops all deletions.
    pub reset: Signal<In, Bit>,
    /// A run of deletions is under way; or one of moves, and the item that begins.
    pub deletes: Signal<In, Bit>,
    pub moving: Signal<In, Moving>,
    pub infinite: Signal<In, VertexId>,
    pub ring_capacity: Signal<In, RingCount>,
    /// A context that starts and may take a vertex at this edge.
    pub start: Signal<In, Start>,
    /// The visit that completes in the next clock, with the priority of its context; and the one that completes in this
    /// clock, and whether the first two corners of its record and the third turn left.
    pub early: Signal<In, Upcoming>,
    pub holds_priority: Signal<In, Bit>,
    pub completion: Signal<In, Completion>,
    pub turns_left: Signal<In, Bit>,
    pub sides: Signal<In, Sides>,
    /// The visit that reads its record, and the vertices of its test two clocks later.
    pub issued: Signal<In, Visit>,
    pub vertices: Signal<Out, TestVertices>,
    /// The record of the completed visit names the vertex of its context; or is free.
    pub names: Signal<Out, Bit>,
    pub is_free: Signal<Out, Bit>,
    /// Whether the visit that completes in the next clock belongs to a deletion, or to a move whose vertex is in the
    /// mesh (`early_finds`); and the same of the visit that completes in this clock (`finds`).
    pub early_finds: Signal<Out, Bit>,
    pub finds: Signal<Out, Bit>,
    /// The completed visit is this block's, or a root that opens a star (`opens_star`).
    pub is_done: Signal<Out, Bit>,
    pub opens_star: Signal<Out, Bit>,
    /// The visits that follow, the consequences, and a lock and a release.
    pub follow: Signal<Out, Follow>,
    pub outcome: Signal<Out, Outcome>,
    pub lock: Signal<Out, LockWrite>,
    pub releases: Signal<Out, ReleaseRequest>,
    /// The completed visit may end a star or a move in place; known sooner than `outcome` and `releases`.
    pub may_settle: Signal<Out, Bit>,
    /// A test that is asked for, and whether it enters the queue at this edge.
    pub push: Signal<Out, Bundle>,
    pub push_valid: Signal<Out, Bit>,
    pub pushes: Signal<In, Bit>,
    /// The item that ends, if `may_end`.
    pub ending: Signal<Out, FillEnd>,
    pub may_end: Signal<In, Bit>,
    pub write: Signal<Out, Write>,
    /// A write comes in the next clock.
    pub writes_next: Signal<Out, Bit>,
    pub erased: Signal<Out, Committed>,
    pub kept: Signal<Out, KeptWrite>,
    /// A run of deletions or moves is under way. The point of a move in place, if one ends; and the vertices that
    /// chains carry.
    pub runs: Signal<Out, Bit>,
    pub moved: Signal<Out, Arrival>,
    pub carried: Signal<Out, Carried>,
    mover: MovedVertex,
    edges: KeptEdges,
    named: NamedVertex,
    kind: StarCase,
    store: StarStore,
    step: StarStep,
    visits: StarVisits,
    effects: StarOutcome,
    first_test: TestVisit,
    hole: HoleStep,
    fill: HoleFill,
    ring: HoleRing,
    writer: HoleWriter,
    early_visit: Signal<Local, Visit>,
    visit: Signal<Local, Visit>,
    early_turned: Signal<Local, Turned>,
    early_entry: Signal<Local, RingEntry>,
    turned: Signal<Local, Turned>,
    opens: Signal<Local, Bit>,
    names_it: Signal<Local, Bit>,
    ends_in_place: Signal<Local, Bit>,
    is_found: Signal<Local, Bit>,
    verdict: Signal<Local, Verdict>,
}

impl Holes {
    pub fn new(config: Config) -> Self {
        Self {
            mover: MovedVertex::new(config),
            named: NamedVertex::new(config),
            visits: StarVisits::new(config),
            store: StarStore::new(config),
            step: StarStep::new(config),
            hole: HoleStep::new(config),
            fill: HoleFill::new(config),
            ring: HoleRing::new(config),
            ..Self::default()
        }
    }
}

impl Logic for Holes {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, mover, named, kind, store, hole, fill, ring, writer);
        self.fill.reset.next = self.reset.val();
        self.writer.reset.next = self.reset.val();
        self.early_visit.next = self.early.val().visit;
        self.visit.next = self.completion.val().visit;
        self.turned.next = self.completion.val().turned;
        self.verdict.next = self.completion.val().verdict;
        self.named.start.next = self.start.val();
        self.named.early.next = self.early.val();
        self.names_it.next = self.named.names0.val() | self.named.names1.val() | self.named.names2.val();
        self.names.next = self.names_it.val();
        self.is_free.next = self.named.is_free.val();
        self.mover.deletes.next = self.deletes.val();
        self.mover.moving.next = self.moving.val();
        self.mover.start.next = self.start.val();
        self.mover.early.next = self.early.val();
        self.early_finds.next = self.mover.early_finds.val();
        self.is_found.next = self.mover.finds.val();
        self.finds.next = self.is_found.val();
        self.kind.finds.next = self.mover.early_finds.val();
        self.kind.early.next = self.early.val();
        self.kind.holds_priority.next = self.holds_priority.val();
        self.opens.next = self.kind.is_root.val() & self.names_it.val();
        self.opens_star.next = self.opens.val();
        self.is_done.next = self.kind.is_star.val() | self.kind.is_test.val() | self.kind.is_last_edge.val();

        self.store.early_visit.next = self.early_visit.val();
        self.store.visit.next = self.visit.val();
        self.step.visit.next = self.visit.val();
        self.step.turned.next = self.turned.val();
        self.step.is_star.next = self.kind.is_star.val();
        self.step.is_outside.next = self.kind.is_outside.val();
        self.step.is_foreign.next = self.kind.is_foreign.val();
        self.step.is_awaited.next = self.kind.is_awaited.val();
        self.step.moves.next = self.mover.moves.val();
        self.step.stays.next = self.mover.stays.val();
        self.step.keeps.next = self.edges.keeps.val();
        self.step.ring_capacity.next = self.ring_capacity.val();
        self.edges.visit.next = self.visit.val();
        self.edges.turned.next = self.turned.val();
        self.edges.opens.next = self.opens.val();
        self.edges.names1.next = self.named.names1.val();
        self.edges.names2.next = self.named.names2.val();
        self.edges.is_outside.next = self.kind.is_outside.val();
        self.edges.is_last_edge.next = self.kind.is_last_edge.val();
        self.edges.goes_round.next = self.step.goes_round.val();
        self.edges.flags.next = self.sides.val().flags;
        self.edges.conflict.next = self.verdict.val().conflict;
        self.edges.turns_left.next = self.turns_left.val();
        self.carried.next = self.edges.carried.val();
        self.ends_in_place.next = self.kind.is_last_edge.val() & (self.mover.stays.val() | self.edges.keeps.val());
        self.mover.ends_in_place.next = self.ends_in_place.val();
        self.moved.next = self.mover.arrival.val();
        self.runs.next = self.deletes.val() | self.moving.val().runs;
        self.store.keeps.next = self.edges.keeps.val();
        self.step.held.next = self.store.held.val();
        self.step.meets.next = self.store.meets.val();
        self.early_turned.next = self.early.val().turned;
        self.early_entry.next = self.early_visit.val().entry;
        self.store.early_next.next = self.early_turned.val().n2;
        if self.early_entry.val().get_bit(5) {
            self.store.early_next.next = self.early_turned.val().n1;
        }
        self.store.onward.next = self.step.onward.val();
        self.store.goes.next = self.step.goes_on.val();
        self.store.ring_capacity.next = self.ring_capacity.val();
        self.may_settle.next = self.step.may_settle.val() | self.kind.is_last_edge.val();
        self.store.opens.next = self.opens.val();
        self.store.left.next = self.visits.left.val();
        self.store.right.next = self.visits.right.val();
        self.store.changes.next = self.kind.is_star.val();
        self.store.after.next = self.step.after.val();

        self.hole.early_visit.next = self.early_visit.val();
        self.hole.visit.next = self.visit.val();
        self.hole.turned.next = self.turned.val();
        self.hole.verdict.next = self.verdict.val();
        self.hole.best_is_left.next = self.turns_left.val();
        self.hole.is_test.next = self.kind.is_test.val();
        self.hole.opens.next = self.step.opens.val() | (self.kind.is_last_edge.val() & (!self.ends_in_place.val()));
        self.hole.star.next = self.step.after.val();
        self.fill.came.next = self.hole.came.val();
        self.fill.pushes.next = self.pushes.val();
        self.fill.may_end.next = self.may_end.val();
        self.fill.takes.next = self.start.val().takes;
        self.fill.taker.next = self.start.val().context;
        self.fill.taken.next = self.start.val().id;
        self.fill.is_full.next = self.writer.is_full.val();
        self.writer.job.next = self.fill.job.val();
        self.ending.next = self.fill.ending.val();
        self.hole.stores.next = self.fill.asks.val() & self.pushes.val();
        self.hole.stored.next = self.fill.hole.val();

        self.visits.visit.next = self.visit.val();
        self.visits.turned.next = self.turned.val();
        self.visits.names1.next = self.named.names1.val();
        self.visits.names2.next = self.named.names2.val();
        self.visits.opens.next = self.opens.val();
        self.visits.looks_outside.next = self.step.looks_outside.val();
        self.visits.goes_on.next = self.step.goes_on.val();
        self.visits.onward.next = self.step.onward.val();
        self.visits.outside.next = self.step.outside.val();
        self.visits.next_place.next = self.step.next_place.val();
        self.visits.tests.next = self.kind.is_test.val();
        self.visits.closes.next = self.step.closes.val();
        self.visits.star.next = self.step.after.val();
        self.visits.hole.next = self.hole.tested.val();
        self.follow.next.asks = self.opens.val()
            | self.step.revisits.val()
            | self.step.looks_outside.val()
            | self.step.closes.val()
            | self.hole.asks.val();
        self.follow.next.may_ask = self.kind.may_ask.val() | self.step.may_close.val();
        self.follow.next.bundle = self.visits.bundle.val();

        self.first_test.asked.next = self.fill.hole.val();
        self.push_valid.next = self.fill.asks.val();
        self.push.next = self.first_test.bundle.val();

        self.effects.visit.next = self.visit.val();
        self.effects.turned.next = self.turned.val();
        self.effects.is_star.next = self.kind.is_star.val();
        self.effects.held.next = self.store.held.val();
        self.effects.after.next = self.step.after.val();
        self.effects.settles.next = self.step.settles.val();
        self.effects.waits.next = self.step.waits.val();
        self.effects.aborts.next = self.step.aborts.val();
        self.effects.fails.next = self.step.fails.val();
        self.effects.ends_in_place.next = self.ends_in_place.val();
        self.ring.entry.next = self.effects.entry.val();
        self.lock.next = self.effects.lock.val();
        self.releases.next = self.effects.releases.val();
        self.outcome.next = self.effects.outcome.val();

        self.ring.visit.next = self.issued.val();
        self.vertices.next = self.ring.vertices.val();
        self.ring.reader.next = self.writer.reader.val();
        self.ring.place.next = self.writer.place.val();
        self.writer.word.next = self.ring.word.val();
        self.writer.infinite.next = self.infinite.val();
        self.write.next = self.writer.write.val();
        self.writes_next.next = self.writer.writes_next.val();
        self.erased.next = self.writer.erased.val();
        self.kept.next = self.writer.kept.val();
    }
}
