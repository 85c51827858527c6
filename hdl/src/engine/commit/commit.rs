//! Writes the star of a new point in one pass over its ring; one ring follows another without a pause.
//!
//! 1. Entry `i` writes the record of the new vertex, the first vertex of entry `i` and that of entry `i + 1`. The
//!    neighbours of this record are the outside record and the records of entries `i + 1` and `i - 1`. Then the entry
//!    writes the link of the outside record back to the star, unless that link is right already.
//! 2. The record takes the id of the cavity record behind its entry, unless the entry before or the first entry has
//!    taken that id. Otherwise the record takes the id of an inner record, or a new one: two new ids for each ring. An
//!    id given in this way is never that of the cavity record behind the entry.
//! 3. The record of the first entry is written last, because it needs the id of the last one.
//! 4. A ring has three entries or more. Its inner records are listed before its first entry is offered.
//!
//! Latency: entries + links + 1 clocks from the first entry on `head` to `committed`, and up to three more for each
//! inner record whose id is used.
//!
//! Four entries lie along two cavity records. The star has the ids 0, 10, 1, 11, of which 10 and 11 are new; 7 and 8
//! are records outside. The next ring follows.
//! ```text
//! head_valid      ___/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\__
//! takes           ___/^^^^^^^^^^^\________/^^^^^^^^^^^\__
//! ends            ________________________/^^\___________
//! write.valid     ____________/^^^^^^^^^^^^^^^^^\__/^^^^^
//! write.vertices  ____________/^^^^^\__/^^\__/^^\__/^^^^^
//! write.id          .  .  .  .  1 10  7 11  8  0  .  1 12
//! fresh            10 10 10 10 11 12 12 12 12 12 12 13 14
//! ```

use super::commit_steps::CommitSteps;
use super::inner_list::InnerList;
use super::star_id::StarId;
use crate::engine::types::{CommitJob, Committed, Entry, InnerWrite, RingHead, Slot, TriangleId, VertexId, Write};
use crate::engine::write::{LinkWrite, RecordWrite};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct Commit {
    pub clock: Signal<In, Clock>,
    /// Reset drops the ring.
    pub reset: Signal<In, Bit>,
    /// The next entry of the ring reader, and the job of its ring, which counts with the first entry.
    pub head: Signal<In, RingHead>,
    pub head_job: Signal<In, CommitJob>,
    /// The entry is taken at this edge, if there is one.
    pub takes: Signal<Out, Bit>,
    /// An inner record joins the list of a context.
    pub inner: Signal<In, InnerWrite>,
    /// The next new id; the commit takes it at this edge (`takes_fresh`).
    pub fresh: Signal<In, TriangleId>,
    pub takes_fresh: Signal<Out, Bit>,
    /// A record or a link, from a register; the data count while it is valid.
    pub write: Signal<Out, Write>,
    /// The last write of a ring is requested at this edge.
    pub committed: Signal<Out, Committed>,
    /// A ring is being written.
    pub is_at_work: Signal<Out, Bit>,
    /// In a core with deletions: the first entry of a ring is taken at this edge; and the write port is taken at the
    /// next edge, so that the commit waits (`holds`).
    pub loads: Vec<Signal<Out, Bit>>,
    pub holds: Vec<Signal<In, Bit>>,
    ring: DFF<CommitJob>,
    first: DFF<Entry>,
    current: DFF<Entry>,
    current_id: DFF<TriangleId>,
    before_id: DFF<TriangleId>,
    second_vertex: DFF<VertexId>,
    second_id: DFF<TriangleId>,
    link_record: DFF<TriangleId>,
    link_slot: DFF<Slot>,
    request: DFF<Write>,
    steps: CommitSteps,
    star_id: StarId,
    inner_list: InnerList,
    record: RecordWrite,
    link: LinkWrite,
    entry: Signal<Local, Entry>,
}

impl Commit {
    pub fn new(config: Config) -> Self {
        Self { inner_list: InnerList::new(config), ..Self::default() }
    }

    /// The commit of a core with deletions.
    pub fn with_deletions(config: Config) -> Self {
        Self {
            loads: vec![Signal::default()],
            holds: vec![Signal::default()],
            steps: CommitSteps::with_deletions(),
            ..Self::new(config)
        }
    }
}

impl Logic for Commit {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, ring, first, current, current_id, before_id, second_vertex, second_id);
        dff_setup!(self, clock, link_record, link_slot, request);
        clock!(self, clock, steps, inner_list);
        self.entry.next = self.head.val().entry;
        self.write.next = self.request.q.val();
        self.committed.next.valid = self.steps.is_close.val();
        self.committed.next.job = self.ring.q.val();
        self.is_at_work.next = self.steps.is_at_work.val();

        // The id of the next record must be known before the current one is written, which names it as neighbour.
        self.steps.reset.next = self.reset.val();
        self.steps.head.next = self.head.val();
        self.steps.awaits_id.next = self.inner_list.is_awaited.val();
        self.steps.changes_id.next = self.star_id.is_inner.val() | self.star_id.is_fresh.val();
        self.takes.next = self.steps.takes.val();
        self.takes_fresh.next = self.steps.advances.val() & self.star_id.is_fresh.val();
        self.inner_list.inner.next = self.inner.val();
        self.inner_list.reader.next = self.head_job.val().context;
        self.inner_list.inners.next = self.head_job.val().inners;
        self.inner_list.restarts.next = self.steps.loads.val();
        self.inner_list.steps.next = self.steps.advances.val() & self.star_id.is_inner.val();
        self.star_id.head.next = self.head.val();
        self.star_id.first.next = self.first.q.val();
        self.star_id.current_is_last.next = self.steps.is_last.val();
        self.star_id.inner_id.next = self.inner_list.inner_id.val();
        self.star_id.inner_is_used_up.next = self.inner_list.is_used_up.val();
        self.star_id.fresh.next = self.fresh.val();

        // When the ring closes, the current entry is the first one again. The second entry has long left the head, so
        // its vertex and id come from registers.
        self.record.id.next = self.current_id.q.val();
        self.record.v0.next = self.ring.q.val().vertex;
        self.record.v1.next = self.current.q.val().first_vertex;
        self.record.v2.next = self.star_id.ahead.val().first_vertex;
        self.record.n0.next = self.current.q.val().outside_record;
        self.record.n1.next = self.star_id.id.val();
        self.record.n2.next = self.before_id.q.val();
        if self.steps.is_close.val() {
            self.record.v2.next = self.second_vertex.q.val();
            self.record.n1.next = self.second_id.q.val();
        }
        self.link.id.next = self.link_record.q.val();
        self.link.slot.next = self.link_slot.q.val();
        self.link.value.next = self.before_id.q.val();
        self.request.d.next = self.record.write.val();
        self.request.d.next.valid = self.steps.is_close.val() | (self.steps.advances.val() & (!self.steps.opens.val()));
        if self.steps.is_link.val() {
            self.request.d.next = self.link.write.val();
        }

        if self.steps.advances.val() {
            if self.steps.opens.val() {
                self.second_vertex.d.next = self.star_id.ahead.val().first_vertex;
                self.second_id.d.next = self.star_id.id.val();
            }
            self.link_record.d.next = self.current.q.val().outside_record;
            self.link_slot.d.next = self.current.q.val().slot;
            self.before_id.d.next = self.current_id.q.val();
            self.current.d.next = self.star_id.ahead.val();
            self.current_id.d.next = self.star_id.id.val();
        }
        if self.steps.loads.val() {
            self.ring.d.next = self.head_job.val();
            self.first.d.next = self.entry.val();
            self.current.d.next = self.entry.val();
            self.current_id.d.next = self.entry.val().cavity_record;
        }
        for i in 0..self.loads.len() {
            self.loads[i].next = self.steps.loads.val();
            self.steps.holds[i].next = self.holds[i].val();
        }
        if self.reset.val() {
            self.request.d.next.valid = false;
        }
    }
}
