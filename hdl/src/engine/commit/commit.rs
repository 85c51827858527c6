//! One pass over a finished ring writes the star of the new point; one ring follows the other without a pause.
//!
//! 1. Entry `i` writes the record `v = (p, a, b)`, `n = (u, id of i + 1, id of i - 1)`, then the link of `u` unless it is right.
//! 2. Its id is that of the cavity triangle behind it, unless the entry before or the first entry took it: then an inner
//!    triangle's, or a new one. Two new ones are taken in all. An id given so is never that of the triangle behind the entry.
//! 3. The first entry's record is written last, because it needs the last one's id.
//! 4. A ring has three entries or more. Its inner triangles are listed before its first entry is offered.
//! 5. `solo_inserts`, `seeds` and `clears` come only while nothing is at work.
//!
//! Latency: entries + links + 1 clocks from the first entry on the head to `ends`, and up to three more for each inner triangle
//! given back; `records` follows three clocks after `ends`.
//!
//! Four entries behind two triangles: ids 0, 10, 1, 11, of which 10 and 11 are new; 7 and 8 are triangles outside. The next
//! ring follows.
//! ```text
//! head_valid      ___/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\__
//! takes           ___/^^^^^^^^^^^\________/^^^^^^^^^^^\__
//! ends            ________________________/^^\___________
//! write.valid     ____________/^^^^^^^^^^^^^^^^^\__/^^^^^
//! write.vertices  ____________/^^^^^\__/^^\__/^^\__/^^^^^
//! write.id          .  .  .  .  1 10  7 11  8  0  .  1 12
//! fresh            10 10 10 10 11 12 12 12 12 12 12 13 14
//! records          10 10 10 10 10 10 10 10 10 10 10 12 12
//! ```

use super::fresh_ids::FreshIds;
use super::inner_list::InnerList;
use super::star_id::StarId;
use crate::engine::types::{CommitJob, Entry, Write};
use crate::engine::write::{LinkWrite, RecordWrite};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What the commit does.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum CommitState {
    /// Awaits a ring.
    Idle,
    /// Writes the record of the current entry, once the id of the one ahead is known.
    Record,
    /// Writes the link of the triangle outside it.
    Link,
    /// Writes the record of the first entry.
    Close,
}

/// The commit; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Commit {
    /// Reset drops the ring and forgets all records.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// An entry of the list, and whether it ends its ring.
    pub head_valid: Signal<In, Bit>,
    pub head: Signal<In, Entry>,
    pub head_is_last: Signal<In, Bit>,
    /// The same cavity triangle lies behind the entry before it or the first one; low with the first.
    pub head_shares: Signal<In, Bit>,
    /// Its ring; looked at with the first entry.
    pub head_job: Signal<In, CommitJob>,
    /// The entry is taken at this edge, if there is one.
    pub takes: Signal<Out, Bit>,
    /// An inner triangle joins the list of a context.
    pub inner_enable: Signal<In, Bit>,
    pub inner_owner: Signal<In, Bits<5>>,
    pub inner_place: Signal<In, Bits<6>>,
    pub inner_id: Signal<In, Bits<15>>,
    /// Two records are written alone; the first four; all are forgotten.
    pub solo_inserts: Signal<In, Bit>,
    pub seeds: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// A record or a link, registered; its data count while it is valid.
    pub write: Signal<Out, Write>,
    /// The last write of the ring is requested at this edge.
    pub ends: Signal<Out, Bit>,
    /// The ring, while `ends`.
    pub job: Signal<Out, CommitJob>,
    /// The record of its first entry, while `ends`.
    pub hint: Signal<Out, Bits<15>>,
    /// The next new id; ids from `records` on are not written yet.
    pub fresh: Signal<Out, Bits<15>>,
    pub records: Signal<Out, Bits<15>>,
    /// A ring is being written.
    pub is_at_work: Signal<Out, Bit>,
    state: DFF<CommitState>,
    /// The state is one that takes an entry, unless it must wait for an inner triangle.
    wants: DFF<Bit>,
    ring: DFF<CommitJob>,
    first: DFF<Entry>,
    current: DFF<Entry>,
    current_id: DFF<Bits<15>>,
    current_is_last: DFF<Bit>,
    /// The triangle outside the current entry must learn its id.
    needs_link: DFF<Bit>,
    /// The current entry is the first, before the last one's id is known.
    opens: DFF<Bit>,
    before_id: DFF<Bits<15>>,
    second_a: DFF<Bits<15>>,
    second_id: DFF<Bits<15>>,
    /// The ring closes after the link.
    closes: DFF<Bit>,
    link_u: DFF<Bits<15>>,
    link_slot: DFF<Bits<2>>,
    request: DFF<Write>,
    star_id: StarId,
    fresh_ids: FreshIds,
    inner_list: InnerList,
    record: RecordWrite,
    link: LinkWrite,
    is_record: Signal<Local, Bit>,
    is_close: Signal<Local, Bit>,
    awaits_ring: Signal<Local, Bit>,
    waits: Signal<Local, Bit>,
    loads: Signal<Local, Bit>,
    advances: Signal<Local, Bit>,
}

impl Commit {
    /// The commit of a configuration.
    pub fn new(config: Config) -> Self {
        Self { inner_list: InnerList::new(config), ..Self::default() }
    }
}

impl Logic for Commit {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, wants, ring, first, current, current_id, current_is_last, needs_link, opens);
        dff_setup!(self, clock, before_id, second_a, second_id, closes, link_u, link_slot, request);
        clock!(self, clock, fresh_ids, inner_list);
        self.is_record.next = self.state.q.val() == CommitState::Record;
        self.is_close.next = self.state.q.val() == CommitState::Close;
        self.awaits_ring.next = (self.state.q.val() == CommitState::Idle) | self.is_close.val();
        self.write.next = self.request.q.val();
        self.ends.next = self.is_close.val();
        self.job.next = self.ring.q.val();
        self.hint.next = self.first.q.val().f;
        self.fresh.next = self.fresh_ids.fresh.val();
        self.records.next = self.fresh_ids.records.val();
        self.is_at_work.next = self.state.q.val() != CommitState::Idle;

        // The entry ahead and its id.
        self.inner_list.enable.next = self.inner_enable.val();
        self.inner_list.owner.next = self.inner_owner.val();
        self.inner_list.place.next = self.inner_place.val();
        self.inner_list.id.next = self.inner_id.val();
        self.inner_list.reader.next = self.head_job.val().owner;
        self.inner_list.inners.next = self.head_job.val().inners;
        self.star_id.head.next = self.head.val();
        self.star_id.head_shares.next = self.head_shares.val();
        self.star_id.first.next = self.first.q.val();
        self.star_id.current_is_last.next = self.current_is_last.q.val();
        self.star_id.inner_id.next = self.inner_list.inner_id.val();
        self.star_id.inner_is_used_up.next = self.inner_list.is_used_up.val();
        self.star_id.fresh.next = self.fresh_ids.fresh.val();
        self.waits.next = self.head_shares.val() & self.inner_list.is_awaited.val();
        self.takes.next = self.wants.q.val() & (!self.waits.val());
        self.loads.next = self.awaits_ring.val() & self.head_valid.val();
        self.advances.next =
            self.is_record.val() & (self.current_is_last.q.val() | (self.head_valid.val() & (!self.waits.val())));
        self.inner_list.restarts.next = self.loads.val();
        self.inner_list.steps.next = self.advances.val() & self.star_id.is_inner.val();
        self.fresh_ids.reset.next = self.reset.val();
        self.fresh_ids.takes.next = self.advances.val() & self.star_id.is_fresh.val();
        self.fresh_ids.ends.next = self.is_close.val();
        self.fresh_ids.solo_inserts.next = self.solo_inserts.val();
        self.fresh_ids.seeds.next = self.seeds.val();
        self.fresh_ids.clears.next = self.clears.val();

        // The writes; when the ring closes, the current entry is the first again.
        self.record.id.next = self.current_id.q.val();
        self.record.v0.next = self.ring.q.val().p;
        self.record.v1.next = self.current.q.val().a;
        self.record.v2.next = self.star_id.ahead.val().a;
        self.record.n0.next = self.current.q.val().u;
        self.record.n1.next = self.star_id.id.val();
        self.record.n2.next = self.before_id.q.val();
        if self.is_close.val() {
            self.record.v2.next = self.second_a.q.val();
            self.record.n1.next = self.second_id.q.val();
        }
        self.link.id.next = self.link_u.q.val();
        self.link.slot.next = self.link_slot.q.val();
        self.link.value.next = self.before_id.q.val();
        self.request.d.next = self.record.write.val();
        self.request.d.next.valid = self.is_close.val() | (self.advances.val() & (!self.opens.q.val()));

        if self.advances.val() {
            if self.opens.q.val() {
                self.second_a.d.next = self.star_id.ahead.val().a;
                self.second_id.d.next = self.star_id.id.val();
            }
            self.link_u.d.next = self.current.q.val().u;
            self.link_slot.d.next = self.current.q.val().slot;
            self.opens.d.next = false;
            self.closes.d.next = self.current_is_last.q.val();
            self.before_id.d.next = self.current_id.q.val();
            self.current.d.next = self.star_id.ahead.val();
            self.current_id.d.next = self.star_id.id.val();
            self.current_is_last.d.next = (!self.current_is_last.q.val()) & self.head_is_last.val();
            self.needs_link.d.next = self.star_id.is_inner.val() | self.star_id.is_fresh.val();
        }
        if self.loads.val() {
            self.ring.d.next = self.head_job.val();
            self.first.d.next = self.head.val();
            self.current.d.next = self.head.val();
            self.current_id.d.next = self.head.val().f;
            self.current_is_last.d.next = false;
            self.opens.d.next = true;
            self.needs_link.d.next = false;
        }
        match self.state.q.val() {
            CommitState::Record => {
                if self.advances.val() {
                    self.wants.d.next = self.current_is_last.q.val() | (!self.head_is_last.val());
                    if self.current_is_last.q.val() {
                        self.state.d.next = CommitState::Close;
                    }
                    if self.needs_link.q.val() {
                        self.state.d.next = CommitState::Link;
                        self.wants.d.next = false;
                    }
                }
            }
            CommitState::Link => {
                self.request.d.next = self.link.write.val();
                self.state.d.next = CommitState::Record;
                self.wants.d.next = self.closes.q.val() | (!self.current_is_last.q.val());
                if self.closes.q.val() {
                    self.state.d.next = CommitState::Close;
                }
            }
            _ => {
                self.state.d.next = CommitState::Idle;
                self.wants.d.next = true;
                if self.loads.val() {
                    self.state.d.next = CommitState::Record;
                }
            }
        }
        if self.reset.val() {
            self.state.d.next = CommitState::Idle;
            self.wants.d.next = true;
            self.request.d.next.valid = false;
        }
    }
}
