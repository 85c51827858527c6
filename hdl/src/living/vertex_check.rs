//! Looks whether the vertex of an item can be inserted, deleted or moved, before the item goes to its context: a bit
//! for each vertex says whether the vertex is in use, and another whether ids are kept for it.
//!
//! 1. A vertex at or beyond the capacity is refused with the outcome `Full`, and one in use with `InUse`. Every other
//!    vertex is in use from then on, so a second item of the run with the same vertex is refused.
//! 2. A point of an `Insert` is in use when its context takes it, and so are the first two vertices after a clear. A
//!    vertex whose point turns out to be that of another one is no longer in use (`unmarks`).
//! 3. Bits from `known` on are arbitrary. If an item has a higher vertex, the bits up to it are cleared first, one a
//!    clock. All ids that have come with an `Insert` are known.
//! 4. At most one of `marks` and `unmarks` is high. It has the write port of the bits first, and the item waits a
//!    clock.
//! 5. Items of a question go through without a look.
//! 6. A vertex to delete or move is refused with the outcome `Missing` if it is not in use. Otherwise it is not in use
//!    from then on, and owns ids that are kept for it. Its point is fetched and becomes the place of the item. A vertex
//!    that has moved, or has to stay, is in use again when its part is given (`marks`).
//! 7. A vertex that comes with an `Insert` owns none, and neither does one that was never known. Of one that falls out
//!    of use, `unmarked_owns` says it.
//!
//! Latency: 4 clocks from an item to its offer or refusal, and one more for each bit that is cleared; none for a
//! question.

use super::checked_item::CheckedItem;
use super::types::DealtItem;
use super::vertex_bits::VertexBits;
use crate::commands::types::{VertexCount, Word};
use crate::engine::types::VertexId;
use crate::predicate::Point;
use crate::prelude::*;
use incircle_protocol::Config;

/// The next step for the item on offer.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum CheckState {
    /// No item of a change is on offer.
    Idle,
    /// The bit of the vertex is read, and comes out of the memory two clocks later.
    Look,
    Fetch,
    /// The bit is there.
    Judge,
    /// The bits up to the vertex are cleared.
    Raise,
    /// The item waits for its context; or its refusal waits for room in the answer.
    Offer,
    Refuse,
}

#[derive(LogicBlock, Default)]
pub struct VertexCheck {
    pub clock: Signal<In, Clock>,
    /// After a reset and after a clear, the first two vertices are in use, and no others are known.
    pub reset: Signal<In, Bit>,
    pub clears: Signal<In, Bit>,
    /// Number of vertices that the core holds, a constant; number of ids that have been used.
    pub capacity: Signal<In, VertexCount>,
    pub arrived: Signal<In, VertexCount>,
    /// The item on offer, whether it is one of a change, and its vertex; and whether this block is done with it at this
    /// edge (`taken`).
    pub dealt: Signal<In, DealtItem>,
    pub is_change: Signal<In, Bit>,
    /// The items delete or move their vertices.
    pub hole_runs: Signal<In, Bit>,
    pub vertex: Signal<In, Word>,
    pub taken: Signal<Out, Bit>,
    /// The item on offer to its context, and whether it is taken at this edge.
    pub offered: Signal<Out, DealtItem>,
    pub accepted: Signal<In, Bit>,
    /// The item is refused: because its vertex lies beyond the capacity (`is_beyond`), or because it is in use. The
    /// refusal stays until it is noted.
    pub refuses: Signal<Out, Bit>,
    pub is_beyond: Signal<Out, Bit>,
    pub is_noted: Signal<In, Bit>,
    /// A vertex comes into use, or falls out of use, at this edge; in the latter case it has ids that are kept for it
    /// or not.
    pub marks: Signal<In, Bit>,
    pub marked: Signal<In, VertexId>,
    pub unmarks: Signal<In, Bit>,
    pub unmarked: Signal<In, VertexId>,
    pub unmarked_owns: Signal<In, Bit>,
    /// A vertex whose point is wanted, unless the vertex memory is asked for another one (`fetches`), and its point two
    /// clocks later.
    pub wanted: Signal<Out, VertexId>,
    pub fetches: Signal<In, Bit>,
    pub fetched: Signal<In, Point>,
    state: DFF<CheckState>,
    known: DFF<VertexCount>,
    beyond: DFF<Bit>,
    /// The vertex on offer lies beyond the capacity; or its bit is arbitrary. Both are compared while the bit is read,
    /// in which time neither the vertex nor `known` changes.
    high: DFF<Bit>,
    unknown: DFF<Bit>,
    bits: VertexBits,
    item: CheckedItem,
    is_refused: Signal<Local, Bit>,
    is_high: Signal<Local, Bit>,
    is_unknown: Signal<Local, Bit>,
    is_last: Signal<Local, Bit>,
    asked: Signal<Local, VertexId>,
    wide_capacity: Signal<Local, Word>,
    one: Signal<Local, VertexCount>,
}

impl VertexCheck {
    /// The check of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        Self { bits: VertexBits::new(config), ..Self::default() }
    }
}

impl Logic for VertexCheck {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, known, beyond, high, unknown);
        clock!(self, clock, bits, item);
        self.one.next = 1.into();
        self.asked.next = self.vertex.val().get_bits::<15>(0);
        self.wide_capacity.next = bit_cast::<32, 15>(self.capacity.val());
        self.high.d.next = self.vertex.val() >= self.wide_capacity.val();
        self.unknown.d.next = self.asked.val() >= self.known.q.val();
        self.is_high.next = self.high.q.val();
        self.is_unknown.next = self.unknown.q.val();
        self.is_last.next = self.asked.val() == self.known.q.val();

        self.refuses.next = self.state.q.val() == CheckState::Refuse;
        self.is_beyond.next = self.beyond.q.val();
        self.wanted.next = self.asked.val();
        self.item.drops.next = self.reset.val() | self.clears.val();
        self.item.dealt.next = self.dealt.val();
        self.item.is_change.next = self.is_change.val();
        self.item.hole_runs.next = self.hole_runs.val();
        self.item.vertex.next = self.asked.val();
        self.item.asks.next = false;
        self.item.bit_in_use.next = self.bits.is_used.val();
        self.item.bit_has_ids.next = self.bits.has_ids.val();
        self.item.fetched.next = self.fetched.val();
        self.item.forgets.next = false;
        self.item.has_passed.next = self.state.q.val() == CheckState::Offer;
        self.offered.next = self.item.offered.val();
        self.taken.next = self.accepted.val() | ((self.state.q.val() == CheckState::Refuse) & self.is_noted.val());

        // Marks come while items wait, so an item can wait for them.
        self.bits.reset.next = self.reset.val();
        self.bits.clears.next = self.clears.val();
        self.bits.marks.next = self.marks.val();
        self.bits.marked.next = self.marked.val();
        self.bits.unmarks.next = self.unmarks.val();
        self.bits.unmarked.next = self.unmarked.val();
        self.bits.unmarked_owns.next = self.unmarked_owns.val();
        self.bits.asked.next = self.asked.val();
        self.bits.written.next = self.asked.val();
        self.bits.writes.next = false;
        self.bits.used.next = !self.hole_runs.val();
        self.bits.owns.next = self.hole_runs.val();
        self.is_refused.next = self.is_high.val() | (self.item.is_used.val() & (!self.is_unknown.val()));
        if self.hole_runs.val() {
            self.is_refused.next = self.is_high.val() | self.is_unknown.val() | (!self.item.is_used.val());
        }
        if self.known.q.val() < self.arrived.val() {
            self.known.d.next = self.arrived.val();
        }

        match self.state.q.val() {
            CheckState::Idle => {
                if self.dealt.val().valid & self.is_change.val() & (!self.bits.is_seeding.val()) {
                    self.state.d.next = CheckState::Look;
                }
            }
            CheckState::Look => {
                if (!self.bits.is_taken.val()) & (!self.fetches.val()) {
                    self.item.asks.next = true;
                    self.state.d.next = CheckState::Fetch;
                }
            }
            CheckState::Fetch => {
                self.state.d.next = CheckState::Judge;
            }
            CheckState::Judge => {
                self.beyond.d.next = self.is_high.val();
                if self.is_refused.val() {
                    self.state.d.next = CheckState::Refuse;
                } else if self.is_unknown.val() {
                    self.state.d.next = CheckState::Raise;
                } else if !self.bits.is_taken.val() {
                    self.bits.writes.next = true;
                    self.state.d.next = CheckState::Offer;
                }
            }
            CheckState::Raise => {
                if !self.bits.is_taken.val() {
                    self.item.forgets.next = true;
                    self.bits.writes.next = true;
                    self.bits.written.next = self.known.q.val();
                    self.bits.used.next = self.is_last.val();
                    self.known.d.next = self.known.q.val() + self.one.val();
                    if self.is_last.val() {
                        self.state.d.next = CheckState::Offer;
                    }
                }
            }
            // An item that is offered or refused stays until it is taken.
            _ => {
                if self.taken.val() {
                    self.state.d.next = CheckState::Idle;
                }
            }
        }
        if self.reset.val() | self.clears.val() {
            self.state.d.next = CheckState::Idle;
            self.known.d.next = 0.into();
        }
    }
}
