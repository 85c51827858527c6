//! Decides what follows a visit of a question: another visit, or the end of the item.
//!
//! 1. A walk goes on until it has reached the record that holds the place. That is a triangle with the place on the
//!    right of no side, or a ghost triangle whose hull edge has the place strictly beyond.
//! 2. In a triangle, [`NamedVertices`] says what the place is.
//! 3. From a ghost triangle the search goes on to the ghost triangle before it on the hull, as long as that one sees
//!    the place too. The answer is the hull edge of the last ghost triangle that does, counter-clockwise on the hull. A
//!    visit of this search has 1 as `entry`, and as `cavity_record` the end of the hull edge of the ghost triangle that
//!    was visited before. The start of that edge is a corner of both ghost triangles, so the visit need not carry it.
//! 4. In a run of `Nearest`, [`NearSearch`] goes round vertices as soon as the walk has ended. Of the finding of a
//!    `Nearest`, only the outcome and the first vertex count.
//! 5. Visits of questions take no lock, and those of walks and of the search along the hull turn no record.
//!
//! Latency: none (combinational) from a completed visit to all outputs.

use super::named_vertices::NamedVertices;
use super::near_search::NearSearch;
use super::types::Finding;
use crate::engine::types::{Bundle, Completion, NearVerdict, RingEntry, TriangleId, Turned, Verdict, VertexId, Visit};
use crate::predicate::Sides;
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct QuestionStep {
    pub clock: Signal<In, Clock>,
    /// The run is one of `Nearest`.
    pub is_nearest: Signal<In, Bit>,
    /// The visit that completes, with signs and values of its three orient2d, for the corners as stored, and with the
    /// search for the nearest vertex.
    pub completion: Signal<In, Completion>,
    pub sides: Signal<In, Sides>,
    pub nearest: Signal<In, NearVerdict>,
    /// Another visit follows, and that visit.
    pub asks: Signal<Out, Bit>,
    pub bundle: Signal<Out, Bundle>,
    /// The walk has reached the record that holds the place.
    pub arrives: Signal<Out, Bit>,
    /// The item ends, with this finding.
    pub ends: Signal<Out, Bit>,
    pub finding: Signal<Out, Finding>,
    /// The corner at which the place lies, if it lies at one.
    pub corner: Signal<Out, VertexId>,
    met: Signal<Local, Finding>,
    named: NamedVertices,
    search: NearSearch,
    visit: Signal<Local, Visit>,
    turned: Signal<Local, Turned>,
    verdict: Signal<Local, Verdict>,
    entry: Signal<Local, RingEntry>,
    is_search: Signal<Local, Bit>,
    is_chain: Signal<Local, Bit>,
    looks: Signal<Local, Bit>,
    is_walk: Signal<Local, Bit>,
    is_near: Signal<Local, Bit>,
    is_ghost: Signal<Local, Bit>,
    located: Signal<Local, Bit>,
    sees: Signal<Local, Bit>,
    stands: Signal<Local, Bit>,
    passes_by: Signal<Local, Bit>,
    hull_end: Signal<Local, VertexId>,
    hull_before: Signal<Local, TriangleId>,
}

impl QuestionStep {
    /// The rules of a configuration, which must be a valid one.
    pub fn new(config: Config) -> Self {
        Self { search: NearSearch::new(config), ..Self::default() }
    }
}

impl Logic for QuestionStep {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, search);
        self.visit.next = self.completion.val().visit;
        self.turned.next = self.completion.val().turned;
        self.verdict.next = self.completion.val().verdict;
        self.entry.next = self.visit.val().entry;
        self.is_search.next = self.entry.val().get_bit(0);
        self.is_chain.next = self.entry.val().get_bit(1);
        self.looks.next = self.entry.val().get_bit(3);
        self.is_walk.next = (!self.is_search.val()) & (!self.is_chain.val()) & (!self.looks.val());
        self.is_ghost.next = self.turned.val().infinite0 | self.turned.val().infinite1 | self.turned.val().infinite2;
        // M8: a free record leads on.
        self.located.next = self.verdict.val().located
            & (!(self.turned.val().infinite0 & self.turned.val().infinite1 & self.turned.val().infinite2));
        self.sees.next = self.is_ghost.val() & self.located.val();
        self.stands.next = (!self.is_ghost.val()) & self.located.val() & (!self.is_search.val());
        self.passes_by.next = self.is_search.val() & (!self.located.val());

        // Counter-clockwise, a ghost triangle has the infinite vertex, the end and the start of its hull edge. The
        // ghost triangle before it lies opposite the end.
        self.hull_end.next = self.turned.val().v1;
        self.hull_before.next = self.turned.val().n1;
        if self.turned.val().infinite1 {
            self.hull_end.next = self.turned.val().v2;
            self.hull_before.next = self.turned.val().n2;
        }
        if self.turned.val().infinite2 {
            self.hull_end.next = self.turned.val().v0;
            self.hull_before.next = self.turned.val().n0;
        }

        self.bundle.next.is_pair = false;
        self.bundle.next.is_triple = false;
        self.bundle.next.context = self.visit.val().context;
        self.bundle.next.rotates = false;
        self.bundle.next.locks = false;
        self.bundle.next.entry = 0.into();
        self.bundle.next.after = 0.into();
        self.bundle.next.cavity_entry = 0.into();
        self.bundle.next.cavity_record = self.hull_end.val();
        self.bundle.next.record = self.verdict.val().walk_next;
        self.bundle.next.second_after = 0.into();
        self.bundle.next.second_record = 0.into();
        self.bundle.next.third_record = 0.into();
        if self.sees.val() {
            self.bundle.next.entry = 1.into();
            self.bundle.next.record = self.hull_before.val();
        }
        self.ends.next = self.completion.val().done & (self.stands.val() | self.passes_by.val());
        self.asks.next = self.completion.val().done & (!self.stands.val()) & (!self.passes_by.val());
        self.arrives.next = self.completion.val().done & self.located.val() & self.is_walk.val();

        self.search.completion.next = self.completion.val();
        self.search.nearest.next = self.nearest.val();
        self.search.follows.next = self.completion.val().done & self.is_chain.val();
        self.search.begins.next =
            (self.completion.val().done & self.looks.val()) | (self.is_nearest.val() & self.arrives.val());
        self.is_near.next = self.is_chain.val() | self.looks.val() | (self.is_nearest.val() & self.located.val());
        if self.is_near.val() {
            self.ends.next = self.search.ends.val();
            self.asks.next = self.search.asks.val();
            self.bundle.next = self.search.bundle.val();
        }

        self.named.turned.next = self.turned.val();
        self.named.sides.next = self.sides.val();
        self.met.next = self.named.finding.val();
        self.corner.next = self.met.val().v0;
        self.finding.next = self.met.val();
        if self.is_search.val() {
            self.finding.next.outcome = 4.into();
            self.finding.next.v0 = self.hull_end.val();
            self.finding.next.v1 = self.visit.val().cavity_record;
            self.finding.next.v2 = 0.into();
            self.finding.next.w0 = 0.into();
            self.finding.next.w1 = 0.into();
            self.finding.next.w2 = 0.into();
        }
        if self.is_near.val() {
            self.finding.next.outcome = 1.into();
            self.finding.next.v0 = self.search.vertex.val();
        }
    }
}
