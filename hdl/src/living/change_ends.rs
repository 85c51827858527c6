//! Decides how the items of a change end, and gives their parts.
//!
//! 1. An item of a context ends, so that the next one can begin, when its attempt hands its ring over, when a vertex
//!    turns out to have its point, or with its solo insertion.
//! 2. A part with the outcome `Done` is given when the last write of the commit is on its way. At most one part is
//!    given in a clock. The part of a commit waits for those of duplicates and solo insertions, and goes before a
//!    refusal.
//! 3. The item of a move in place ends when its last visit completes; that of any other move ends as an insertion does.
//!    A vertex that has moved is in use again when its part is given.
//! 4. Outside a run no part is given: the items are then the points of an `Insert`.
//!
//! Latency: none (combinational) from an event to `ends` and `came`, unless the part waits.

use super::types::{ContextEnd, DoneItem, Finding, ItemNumber, Part, PartCame, DONE_BITS};
use crate::commands::types::Word;
use crate::engine::types::{context_bits, ChangeEvents, ContextId, VertexId, CONTEXT_BITS};
use crate::leaf::{Fifo, LutMemory, Unpack};
use crate::prelude::*;
use incircle_protocol::{Config, Outcome};

#[derive(LogicBlock, Default)]
pub struct ChangeEnds {
    pub clock: Signal<In, Clock>,
    /// Reset drops all parts.
    pub reset: Signal<In, Bit>,
    /// A run of changes is under way.
    pub runs: Signal<In, Bit>,
    /// The events of the clock before. The context of the visit that completed then, the number of its item, and the
    /// corner that it met.
    pub events: Signal<In, ChangeEvents>,
    pub context_id: Signal<In, ContextId>,
    pub number: Signal<In, ItemNumber>,
    pub corner: Signal<In, VertexId>,
    /// The run is one of `Delete` or `Move`; it is one of `Move`.
    pub hole_runs: Signal<In, Bit>,
    pub is_move: Signal<In, Bit>,
    /// An item is refused, because its vertex lies beyond the capacity or is in use; its number and its vertex. There
    /// is room for its part (`has_room`), and the part is given (`is_noted`).
    pub refuses: Signal<In, Bit>,
    pub is_beyond: Signal<In, Bit>,
    pub refused_number: Signal<In, ItemNumber>,
    pub refused_vertex: Signal<In, Word>,
    pub has_room: Signal<In, Bit>,
    pub is_noted: Signal<Out, Bit>,
    pub ends: Signal<Out, ContextEnd>,
    pub came: Signal<Out, PartCame>,
    /// A vertex is in the mesh (`raises`); or its point is that of another vertex (`unmarks`).
    pub raises: Signal<Out, Bit>,
    pub raised: Signal<Out, VertexId>,
    pub unmarks: Signal<Out, Bit>,
    pub unmarked: Signal<Out, VertexId>,
    /// A vertex cannot be deleted or moved, and stays in use; or it has moved.
    pub remarks: Signal<Out, Bit>,
    pub remarked: Signal<Out, VertexId>,
    /// Number of the item that each context has handed over. A context hands its next item over only after the commit
    /// of this one, because its next root visit waits for that (L6).
    handed: LutMemory<CONTEXT_BITS, 24>,
    /// The commits that are over and whose parts are not given.
    done: Fifo<CONTEXT_BITS, DONE_BITS>,
    first: Unpack<DoneItem, DONE_BITS>,
    /// Vertex, number and corner of the visit that completed a clock before that, for the end of a solo insertion.
    last_vertex: DFF<VertexId>,
    last_number: DFF<ItemNumber>,
    last_corner: DFF<VertexId>,
    pushed: Signal<Local, DoneItem>,
    pushed_bits: Signal<Local, Bits<DONE_BITS>>,
    part: Signal<Local, Part>,
    finding: Signal<Local, Finding>,
    is_early: Signal<Local, Bit>,
    own_context: Signal<Local, ContextId>,
    gives: Signal<Local, Bit>,
    hands_over: Signal<Local, Bit>,
    is_refused: Signal<Local, Bit>,
    is_flat: Signal<Local, Bit>,
    is_moved: Signal<Local, Bit>,
    stays: Signal<Local, VertexId>,
    pops: Signal<Local, Bit>,
}

// The kernel holds the outcomes as literals, because rust-hdl allows no constants there.
const _: () = assert!(
    Outcome::Done as u8 == 0
        && Outcome::Duplicate as u8 == 5
        && Outcome::Missing as u8 == 6
        && Outcome::InUse as u8 == 7
        && Outcome::Full as u8 == 8
        && Outcome::ManyNeighbors as u8 == 10
        && Outcome::Flat as u8 == 11,
    "the outcomes of this block follow the protocol"
);

impl ChangeEnds {
    /// The block of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        let bits = context_bits(config);
        Self { handed: LutMemory::new(bits, 24), done: Fifo::new(bits, DONE_BITS), ..Self::default() }
    }
}

impl Logic for ChangeEnds {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, last_vertex, last_number, last_corner);
        clock!(self, clock, handed, done);
        self.last_vertex.d.next = self.events.val().vertex;
        self.last_number.d.next = self.number.val();
        self.last_corner.d.next = self.corner.val();

        self.is_flat.next = self.events.val().fill_is_flat;
        self.hands_over.next =
            self.events.val().hands_over | (self.events.val().fill_ends & (!self.events.val().fill_is_flat));
        self.is_moved.next = self.events.val().moves_in_place;
        self.is_refused.next =
            self.is_flat.val() | (self.events.val().finds & self.events.val().duplicate & (!self.is_moved.val()));
        self.ends.next.valid = self.events.val().hands_over
            | self.events.val().duplicate
            | self.events.val().solo_ends
            | self.events.val().fill_ends;
        self.own_context.next = self.context_id.val();
        if self.events.val().fill_ends {
            self.own_context.next = self.events.val().fill_context;
        }
        self.ends.next.context = self.own_context.val();
        if self.events.val().solo_ends {
            self.ends.next.context = self.events.val().solo_context;
        }
        self.raises.next = self.events.val().commit_ends | self.events.val().solo_inserts;
        self.raised.next = self.events.val().committed_vertex;
        self.unmarks.next = ((self.events.val().duplicate & (!self.hole_runs.val()))
            | (self.events.val().solo_ends & (!self.events.val().solo_inserts)))
            & (!self.is_move.val());
        self.unmarked.next = self.events.val().vertex;
        if self.events.val().solo_ends {
            self.raised.next = self.last_vertex.q.val();
            self.unmarked.next = self.last_vertex.q.val();
        }

        // The next item of the context may begin before the commit of this one is over, so its number is kept.
        self.handed.write_address.next = self.own_context.val();
        self.handed.write_data.next = self.number.val();
        self.handed.write_enable.next = self.hands_over.val();
        self.handed.read_address.next = self.events.val().committed_context;
        self.pushed.next.number = self.handed.read_data.val();
        self.pushed.next.vertex = self.events.val().committed_vertex;
        self.pushed_bits.next = self.pushed.val().into();
        self.done.reset.next = self.reset.val();
        self.done.push.next = self.events.val().commit_ends & self.runs.val();
        self.done.push_data.next = self.pushed_bits.val();
        self.first.bits.next = self.done.data.val();

        self.stays.next = self.events.val().vertex;
        if self.is_flat.val() {
            self.stays.next = self.events.val().fill_vertex;
        }
        self.is_early.next = self.events.val().duplicate | self.events.val().solo_ends | self.is_flat.val();
        self.pops.next = self.done.valid.val() & (!self.is_early.val());
        self.done.pop.next = self.pops.val();
        // A vertex that moves is in use again when its part is given, so that at most one is marked at an edge.
        self.remarks.next = self.is_refused.val()
            | self.is_moved.val()
            | (self.is_move.val() & self.pops.val())
            | (self.is_move.val() & self.events.val().solo_ends & self.events.val().solo_inserts);
        self.remarked.next = self.first.value.val().vertex;
        if self.is_refused.val() | self.is_moved.val() {
            self.remarked.next = self.stays.val();
        }
        if self.events.val().solo_ends {
            self.remarked.next = self.last_vertex.q.val();
        }
        self.gives.next = self.refuses.val() & self.has_room.val() & (!self.is_early.val()) & (!self.done.valid.val());
        self.is_noted.next = self.gives.val();
        self.part.next.number = self.first.value.val().number;
        self.finding.next.outcome = 0.into();
        self.finding.next.v0 = self.first.value.val().vertex;
        self.finding.next.v1 = 0.into();
        self.finding.next.v2 = 0.into();
        self.finding.next.w0 = self.refused_vertex.val();
        self.finding.next.w1 = 0.into();
        self.finding.next.w2 = 0.into();
        if self.gives.val() {
            self.part.next.number = self.refused_number.val();
            self.finding.next.outcome = 7.into();
            self.finding.next.v0 = self.refused_vertex.val().get_bits::<15>(0);
            if self.is_beyond.val() {
                self.finding.next.outcome = 8.into();
            }
            if self.hole_runs.val() {
                self.finding.next.outcome = 6.into();
            }
        }
        if self.events.val().duplicate {
            self.part.next.number = self.number.val();
            self.finding.next.outcome = 5.into();
            self.finding.next.v0 = self.corner.val();
        }
        if self.is_refused.val() {
            self.part.next.number = self.number.val();
            self.finding.next.outcome = 10.into();
            self.finding.next.v0 = self.stays.val();
            if self.is_flat.val() {
                self.finding.next.outcome = 11.into();
            }
        }
        if self.is_moved.val() {
            self.part.next.number = self.number.val();
            self.finding.next.outcome = 0.into();
            self.finding.next.v0 = self.stays.val();
        }
        if self.events.val().solo_ends {
            self.part.next.number = self.last_number.q.val();
            self.finding.next.v0 = self.last_vertex.q.val();
            self.finding.next.outcome = 0.into();
            if !self.events.val().solo_inserts {
                self.finding.next.outcome = 5.into();
                self.finding.next.v0 = self.last_corner.q.val();
            }
        }
        self.part.next.finding = self.finding.val();
        self.came.next.valid = self.runs.val() & (self.is_early.val() | self.done.valid.val() | self.gives.val());
        self.came.next.part = self.part.val();
    }
}
