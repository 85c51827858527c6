//! Looks whether the vertex of an item can be inserted or deleted, before the item goes to its context: a bit for each
//! vertex says whether the vertex is in use, and another whether ids are kept for it.
//!
//! 1. A vertex at or beyond the capacity is refused with the outcome `Full`, and one in use with `InUse`. Every other
//!    vertex is in use from then on, so a second item of the run with the same vertex is refused.
//! 2. A point of an `Insert` is in use when its context takes it, and so are the first two vertices after a clear. A
//!    vertex whose point turns out to be that of another one is no longer in use (`unmarks`).
//! 3. Bits from `known` on are arbitrary. If an item has a higher vertex, the bits up to it are cleared first, one a
//!    clock. All ids that have come with an `Insert` are known.
//! 4. At most one of `marks` and `unmarks` is high. It has the write port first; the block's own read or write waits a
//!    clock.
//! 5. Items of a question go through without a look.
//! 6. A vertex to delete is refused with the outcome `Missing` if it is not in use. Otherwise it is not in use from then
//!    on, and owns ids that are kept for it. Its point is fetched and becomes the place of the item.
//! 7. A vertex that comes with an `Insert` owns none (`disowns`), and neither does one that was never known.
//!
//! Latency: 4 clocks from an item to its offer or refusal, and one more for each bit that is cleared; none for a
//! question.

use super::types::{DealtItem, Item};
use crate::commands::types::{VertexCount, Word};
use crate::engine::types::VertexId;
use crate::leaf::BlockMemory;
use crate::predicate::Point;
use crate::prelude::*;
use incircle_protocol::{vertex_id_bits, Config};

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
    pub is_delete: Signal<In, Bit>,
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
    /// A vertex comes into use, or falls out of use, at this edge.
    pub marks: Signal<In, Bit>,
    pub marked: Signal<In, VertexId>,
    pub disowns: Signal<In, Bit>,
    pub unmarks: Signal<In, Bit>,
    pub unmarked: Signal<In, VertexId>,
    /// A vertex whose point is wanted, unless the vertex memory is asked for another one (`fetches`), and its point two
    /// clocks later.
    pub wanted: Signal<Out, VertexId>,
    pub fetches: Signal<In, Bit>,
    pub fetched: Signal<In, Point>,
    state: DFF<CheckState>,
    known: DFF<VertexCount>,
    /// Number of vertices that are still to be marked after a clear.
    seeding: DFF<Bits<2>>,
    beyond: DFF<Bit>,
    in_use: BlockMemory<15, 1>,
    owners: BlockMemory<15, 1>,
    /// The bits and the point were asked for one clock ago, and two clocks ago.
    asked1: DFF<Bit>,
    asked2: DFF<Bit>,
    kept_use: DFF<Bit>,
    kept_place: DFF<Point>,
    owns: DFF<Bit>,
    is_used: Signal<Local, Bit>,
    dealt_item: Signal<Local, Item>,
    built: Signal<Local, Item>,
    is_taken: Signal<Local, Bit>,
    is_high: Signal<Local, Bit>,
    is_unknown: Signal<Local, Bit>,
    is_last: Signal<Local, Bit>,
    seeds: Signal<Local, Bit>,
    seed: Signal<Local, Bits<2>>,
    asked: Signal<Local, VertexId>,
    is_reached: Signal<Local, Bit>,
    wide_capacity: Signal<Local, Word>,
    one: Signal<Local, VertexCount>,
    one_seed: Signal<Local, Bits<2>>,
}

impl VertexCheck {
    /// The check of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        let bits = |of: Config| BlockMemory::new(vertex_id_bits(of.points) as usize - 1, 1);
        Self { in_use: bits(config), owners: bits(config), ..Self::default() }
    }
}

impl Logic for VertexCheck {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, known, seeding, beyond, asked1, asked2, kept_use, kept_place, owns);
        clock!(self, clock, in_use, owners);
        self.one.next = 1.into();
        self.one_seed.next = 1.into();
        self.asked.next = self.vertex.val().get_bits::<15>(0);
        self.wide_capacity.next = bit_cast::<32, 15>(self.capacity.val());
        self.is_high.next = self.vertex.val() >= self.wide_capacity.val();
        self.is_unknown.next = self.asked.val() >= self.known.q.val();
        self.is_last.next = self.asked.val() == self.known.q.val();

        self.refuses.next = self.state.q.val() == CheckState::Refuse;
        self.is_beyond.next = self.beyond.q.val();
        self.is_reached.next = self.state.q.val() == CheckState::Offer;
        self.wanted.next = self.asked.val();
        self.asked1.d.next = false;
        self.asked2.d.next = self.asked1.q.val();
        self.is_used.next = self.kept_use.q.val();
        if self.asked2.q.val() {
            self.is_used.next = self.in_use.read_data.val().any();
            self.kept_use.d.next = self.in_use.read_data.val().any();
            self.kept_place.d.next = self.fetched.val();
            self.owns.d.next = self.owners.read_data.val().any();
        }
        self.dealt_item.next = self.dealt.val().item;
        self.built.next = self.dealt_item.val();
        if self.is_change.val() {
            self.built.next.vertex = self.asked.val();
            self.built.next.owns = self.owns.q.val();
        }
        if self.is_delete.val() {
            self.built.next.place = self.kept_place.q.val();
        }
        self.offered.next.context = self.dealt.val().context;
        self.offered.next.item = self.built.val();
        self.offered.next.valid = self.dealt.val().valid & (self.is_reached.val() | (!self.is_change.val()));
        self.taken.next = self.accepted.val() | ((self.state.q.val() == CheckState::Refuse) & self.is_noted.val());

        // The memory has one write port. Marks come while items wait, so the rest can wait for them.
        self.seed.next = self.seeding.q.val() - self.one_seed.val();
        self.is_taken.next = self.marks.val() | self.unmarks.val();
        self.seeds.next = self.seeding.q.val().any() & (!self.is_taken.val());
        self.in_use.read_address.next = self.asked.val();
        self.in_use.write_address.next = self.unmarked.val();
        self.in_use.write_data.next = 0.into();
        self.in_use.write_enable.next = self.unmarks.val();
        self.owners.read_address.next = self.asked.val();
        self.owners.write_address.next = self.marked.val();
        self.owners.write_data.next = 0.into();
        self.owners.write_enable.next = self.marks.val() & self.disowns.val();
        if self.marks.val() {
            self.in_use.write_address.next = self.marked.val();
            self.in_use.write_data.next = 1.into();
            self.in_use.write_enable.next = true;
        }
        if self.seeds.val() {
            self.in_use.write_address.next = bit_cast::<15, 2>(self.seed.val());
            self.in_use.write_data.next = 1.into();
            self.in_use.write_enable.next = true;
            self.owners.write_address.next = bit_cast::<15, 2>(self.seed.val());
            self.owners.write_enable.next = true;
            self.seeding.d.next = self.seed.val();
        }
        if self.known.q.val() < self.arrived.val() {
            self.known.d.next = self.arrived.val();
        }

        match self.state.q.val() {
            CheckState::Idle => {
                if self.dealt.val().valid & self.is_change.val() & (!self.seeding.q.val().any()) {
                    self.state.d.next = CheckState::Look;
                }
            }
            CheckState::Look => {
                if (!self.is_taken.val()) & (!(self.fetches.val())) {
                    self.asked1.d.next = true;
                    self.state.d.next = CheckState::Fetch;
                }
            }
            CheckState::Fetch => {
                self.state.d.next = CheckState::Judge;
            }
            CheckState::Judge => {
                self.beyond.d.next = self.is_high.val();
                if self.is_delete.val() {
                    if self.is_high.val() | self.is_unknown.val() | (!self.is_used.val()) {
                        self.state.d.next = CheckState::Refuse;
                    } else if !self.is_taken.val() {
                        self.in_use.write_address.next = self.asked.val();
                        self.in_use.write_data.next = 0.into();
                        self.in_use.write_enable.next = true;
                        self.owners.write_address.next = self.asked.val();
                        self.owners.write_data.next = 1.into();
                        self.owners.write_enable.next = true;
                        self.state.d.next = CheckState::Offer;
                    }
                } else if self.is_high.val() {
                    self.state.d.next = CheckState::Refuse;
                } else if self.is_unknown.val() {
                    self.state.d.next = CheckState::Raise;
                } else if self.is_used.val() {
                    self.state.d.next = CheckState::Refuse;
                } else if !self.is_taken.val() {
                    self.in_use.write_address.next = self.asked.val();
                    self.in_use.write_data.next = 1.into();
                    self.in_use.write_enable.next = true;
                    self.state.d.next = CheckState::Offer;
                }
            }
            CheckState::Raise => {
                if !self.is_taken.val() {
                    self.owns.d.next = false;
                    self.owners.write_address.next = self.known.q.val();
                    self.owners.write_enable.next = true;
                    self.in_use.write_address.next = self.known.q.val();
                    self.in_use.write_data.next = 0.into();
                    self.in_use.write_enable.next = true;
                    self.known.d.next = self.known.q.val() + self.one.val();
                    if self.is_last.val() {
                        self.in_use.write_data.next = 1.into();
                        self.state.d.next = CheckState::Offer;
                    }
                }
            }
            CheckState::Offer => {
                if self.accepted.val() {
                    self.state.d.next = CheckState::Idle;
                }
            }
            CheckState::Refuse => {
                if self.is_noted.val() {
                    self.state.d.next = CheckState::Idle;
                }
            }
            _ => {
                self.state.d.next = CheckState::Idle;
            }
        }
        if self.reset.val() | self.clears.val() {
            self.state.d.next = CheckState::Idle;
            self.asked1.d.next = false;
            self.asked2.d.next = false;
            self.known.d.next = 0.into();
            self.seeding.d.next = 2.into();
        }
    }
}
