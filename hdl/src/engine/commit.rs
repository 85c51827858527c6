//! One pass over the finished ring writes the star of the new point.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset ends the commit |
//! | `starts` | in | 1 | the ring is complete; held until `ends` |
//! | `p` | in | 15 | the new vertex |
//! | `records` | in | 15 | the next new id |
//! | `inner_count` | in | 7 | inner triangles, whose ids are given back first |
//! | `entry_pointer`, `entry` | out, in | 6, Entry | the list, read at once |
//! | `inner_pointer`, `inner_id` | out, in | 6, 15 | the inner triangles, read at once |
//! | `takes_fresh` | out | 1 | a new id is taken at this edge |
//! | `ends` | out | 1 | the last write is made at this edge |
//! | `write` | out | Write | a record or a link, registered |
//!
//! 1. Entry `i` writes the record `v = (p, a, b)`, `n = (u, id of i + 1, id of i - 1)`, then the link of `u` unless it is right.
//! 2. Its id is that of the cavity triangle behind it, unless the entry before or the first entry took it: then an inner
//!    triangle's, or a new one. Two new ones are taken in all.
//! 3. The first entry's record is written last, because it needs the last one's id.
//!
//! Latency: entries + links + 3 clocks from `starts` to `ends`.
//!
//! Four entries behind two triangles: ids 0, 10, 1, 11, of which 10 and 11 are new; 7 and 8 are triangles outside.
//! ```text
//! starts          ___/^^^^^^^^^^^^^^^^^^^^^^^^^^\_____
//! takes_fresh     ____________/^^^^^\_________________
//! ends            ___________________________/^^\_____
//! write.valid     _______________/^^^^^^^^^^^^^^^^^\__
//! write.vertices  _______________/^^^^^\__/^^\__/^^\__
//! write.id          .  .  .  .  .  1 10  7 11  8  0  .
//! ```

use super::{Entry, LinkWrite, RecordWrite, StarId, Write};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What the commit does.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum CommitState {
    /// Awaits a ring.
    Idle,
    /// Has the first entry, fetches the second.
    Load,
    /// Writes the record of the current entry.
    Record,
    /// Writes the link of the triangle outside it.
    Link,
    /// Writes the record of the first entry.
    Close,
}

/// The commit; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Commit {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Ends the commit.
    pub reset: Signal<In, Bit>,
    /// The ring is complete.
    pub starts: Signal<In, Bit>,
    /// The new vertex.
    pub p: Signal<In, Bits<15>>,
    /// The next new id.
    pub records: Signal<In, Bits<15>>,
    /// Inner triangles.
    pub inner_count: Signal<In, Bits<7>>,
    /// Entry to read.
    pub entry_pointer: Signal<Out, Bits<6>>,
    /// It.
    pub entry: Signal<In, Entry>,
    /// Inner triangle to read.
    pub inner_pointer: Signal<Out, Bits<6>>,
    /// Its id.
    pub inner_id: Signal<In, Bits<15>>,
    /// A new id is taken.
    pub takes_fresh: Signal<Out, Bit>,
    /// The last write is made.
    pub ends: Signal<Out, Bit>,
    /// A record or a link.
    pub write: Signal<Out, Write>,
    state: DFF<CommitState>,
    pointer: DFF<Bits<6>>,
    first: DFF<Entry>,
    current: DFF<Entry>,
    current_id: DFF<Bits<15>>,
    /// The entry after the current one, and whether the ring has closed there.
    ahead: DFF<Entry>,
    ahead_is_first: DFF<Bit>,
    /// The current entry is the first, before the last one's id is known.
    opens: DFF<Bit>,
    before_id: DFF<Bits<15>>,
    second_a: DFF<Bits<15>>,
    second_id: DFF<Bits<15>>,
    inner_index: DFF<Bits<7>>,
    /// The ring closes after the link.
    closes: DFF<Bit>,
    link_u: DFF<Bits<15>>,
    link_slot: DFF<Bits<2>>,
    link_id: DFF<Bits<15>>,
    request: DFF<Write>,
    star_id: StarId,
    record: RecordWrite,
    link: LinkWrite,
    inner_is_used_up: Signal<Local, Bit>,
    needs_link: Signal<Local, Bit>,
    pointer_is_first: Signal<Local, Bit>,
    first_pointer: Signal<Local, Bits<6>>,
    one: Signal<Local, Bits<7>>,
}

impl Logic for Commit {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, pointer, first, current, current_id, ahead, ahead_is_first, opens);
        dff_setup!(
            self,
            clock,
            before_id,
            second_a,
            second_id,
            inner_index,
            closes,
            link_u,
            link_slot,
            link_id,
            request
        );
        self.first_pointer.next = 0.into();
        self.one.next = 1.into();
        self.entry_pointer.next = self.pointer.q.val();
        self.pointer_is_first.next = self.pointer.q.val() == self.first_pointer.val();
        self.inner_pointer.next = self.inner_index.q.val().get_bits::<6>(0);
        self.write.next = self.request.q.val();

        // The id of the entry ahead.
        self.inner_is_used_up.next = self.inner_index.q.val() == self.inner_count.val();
        self.star_id.ahead.next = self.ahead.q.val();
        self.star_id.ahead_is_first.next = self.ahead_is_first.q.val();
        self.star_id.current.next = self.current.q.val();
        self.star_id.first.next = self.first.q.val();
        self.star_id.inner_id.next = self.inner_id.val();
        self.star_id.inner_is_used_up.next = self.inner_is_used_up.val();
        self.star_id.records.next = self.records.val();
        self.takes_fresh.next =
            (self.state.q.val() == CommitState::Record) & self.star_id.shares.val() & self.inner_is_used_up.val();
        self.needs_link.next = (!self.opens.q.val()) & (self.current_id.q.val() != self.current.q.val().f);
        self.ends.next = self.state.q.val() == CommitState::Close;

        // The writes; when the ring closes, the current entry is the first again.
        self.record.id.next = self.current_id.q.val();
        self.record.v0.next = self.p.val();
        self.record.v1.next = self.current.q.val().a;
        self.record.v2.next = self.ahead.q.val().a;
        self.record.n0.next = self.current.q.val().u;
        self.record.n1.next = self.star_id.id.val();
        self.record.n2.next = self.before_id.q.val();
        if self.state.q.val() == CommitState::Close {
            self.record.v2.next = self.second_a.q.val();
            self.record.n1.next = self.second_id.q.val();
        }
        self.link.id.next = self.link_u.q.val();
        self.link.slot.next = self.link_slot.q.val();
        self.link.value.next = self.link_id.q.val();
        self.request.d.next.valid = false;

        if (self.state.q.val() == CommitState::Load) | (self.state.q.val() == CommitState::Record) {
            self.ahead.d.next = self.entry.val();
            self.ahead_is_first.d.next = self.pointer_is_first.val();
            self.pointer.d.next = self.entry.val().after;
        }
        match self.state.q.val() {
            CommitState::Idle => {
                if self.starts.val() {
                    self.ahead.d.next = self.entry.val();
                    self.pointer.d.next = self.entry.val().after;
                    self.inner_index.d.next = 0.into();
                    self.state.d.next = CommitState::Load;
                }
            }
            CommitState::Load => {
                self.first.d.next = self.ahead.q.val();
                self.current.d.next = self.ahead.q.val();
                self.current_id.d.next = self.ahead.q.val().f;
                self.opens.d.next = true;
                self.state.d.next = CommitState::Record;
            }
            CommitState::Record => {
                if self.star_id.shares.val() & (!self.inner_is_used_up.val()) {
                    self.inner_index.d.next = self.inner_index.q.val() + self.one.val();
                }
                if self.opens.q.val() {
                    self.second_a.d.next = self.ahead.q.val().a;
                    self.second_id.d.next = self.star_id.id.val();
                } else {
                    self.request.d.next = self.record.write.val();
                    self.link_u.d.next = self.current.q.val().u;
                    self.link_slot.d.next = self.current.q.val().slot;
                    self.link_id.d.next = self.current_id.q.val();
                }
                self.opens.d.next = false;
                self.closes.d.next = self.ahead_is_first.q.val();
                self.before_id.d.next = self.current_id.q.val();
                self.current.d.next = self.ahead.q.val();
                self.current_id.d.next = self.star_id.id.val();
                if self.needs_link.val() {
                    self.state.d.next = CommitState::Link;
                } else {
                    if self.ahead_is_first.q.val() {
                        self.state.d.next = CommitState::Close;
                    }
                }
            }
            CommitState::Link => {
                self.request.d.next = self.link.write.val();
                self.state.d.next = CommitState::Record;
                if self.closes.q.val() {
                    self.state.d.next = CommitState::Close;
                }
            }
            CommitState::Close => {
                self.request.d.next = self.record.write.val();
                self.pointer.d.next = 0.into();
                self.state.d.next = CommitState::Idle;
            }
            _ => {
                self.state.d.next = CommitState::Idle;
            }
        }
        if self.reset.val() {
            self.state.d.next = CommitState::Idle;
            self.pointer.d.next = 0.into();
            self.request.d.next.valid = false;
        }
    }
}
