//! Insertion alone, in constant state: locates the point, splits the triangle into three, then flips once round the star.
//!
//! 1. The mesh has changed since the attempt that overflowed, so the point is located again, from the triangle that held it then.
//! 2. Its visits set no locks, and at most one is out.
//! 3. While the triangle outside the star triangle at work is in conflict, the edge is flipped and the same position is tested again;
//!    otherwise the link that leads back is mended and the next star triangle is taken. It ends where the round began.
//! 4. All outputs come a clock later than they could: other blocks have their clock for themselves, and speed is no matter here.
//!
//! ```text
//!        apex                  apex
//!        /  \                  /| \            star triangle  (p, a, apex)
//!      a ---- b     ----->    a |  b           flipped        (p, apex, b)
//!        \  /                  \| /
//!         p                     p
//! ```
//! Latency, with `w` triangles walked through and `f` flips: `w + 3 f + 8` visits one after the other (2 mends, `f + 3` fetches,
//! `2 f + 3` tests), each two clocks more than the visit latency, and `3 f + 5` clocks. A duplicate takes `w` visits and
//! two clocks.
//!
//! A walk of two triangles, the split, and the first mend, with visits of two clocks:
//! ```text
//! starts          ___/^^\_________________________________________
//! is_at_work      _________/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
//! push            _________/^^\________/^^\_________________/^^\__
//! bundle.u          .  .  .  2  .  .  .  0  .  .  .  .  .  .  2  .
//! done            _______________/^^\________/^^\_________________
//! located           .  .  .  .  .___  .  .  ./^^  .  .  .  .  .  .
//! write.valid     ____________________________________/^^^^^^^^\__
//! write.id          .  .  .  .  .  .  .  .  .  .  .  .  0  4  5  .
//! ```
//!
//! Source: Lawson's flips, in the order of the star.

use super::solo_star::SoloStar;
use super::star_state::SoloPhase;
use crate::engine::types::{
    Completion, ContextId, Push, SoloProgress, SoloStart, TriangleId, Turned, Verdict, VertexId, Write,
};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What an insertion alone does.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum SoloState {
    /// Awaits an insertion.
    Idle,
    /// Walks to the triangle that holds the point.
    Locate,
    /// Writes the three records that replace it.
    Split,
    /// Mends the links of the outer neighbours of the second and third.
    Mend,
    /// Reads the star triangle at work.
    Fetch,
    /// Tests the triangle outside.
    Test,
    /// Flips the edge between the two.
    Flip,
}

/// Insertion alone; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Solo {
    pub clock: Signal<In, Clock>,
    /// Reset ends the insertion.
    pub reset: Signal<In, Bit>,
    /// Begin at this edge: no visit is out and no lock held; only while idle.
    pub start: Signal<In, SoloStart>,
    /// The next new id.
    pub records: Signal<In, TriangleId>,
    pub visit: Signal<In, Completion>,
    /// A visit to make; it bears the owner.
    pub push: Signal<Out, Push>,
    /// A record or a link, registered.
    pub write: Signal<Out, Write>,
    /// `is_at_work` from the clock after `start` has been taken to `ends`.
    pub progress: Signal<Out, SoloProgress>,
    state: DFF<SoloState>,
    step: DFF<Bits<2>>,
    awaits: DFF<Bit>,
    at_work_for: DFF<ContextId>,
    vertex: DFF<VertexId>,
    root_id: DFF<TriangleId>,
    root: DFF<Turned>,
    star: SoloStar,
    works: DFF<Bit>,
    asks: DFF<Bit>,
    ended: DFF<Bit>,
    inserted: DFF<Bit>,
    phase: Signal<Local, SoloPhase>,
    verdict: Signal<Local, Verdict>,
    is_visiting: Signal<Local, Bit>,
    is_last_step: Signal<Local, Bit>,
    is_duplicate: Signal<Local, Bit>,
    rests: Signal<Local, Bit>,
    inserts_now: Signal<Local, Bit>,
    ends_now: Signal<Local, Bit>,
    third_step: Signal<Local, Bits<2>>,
    one: Signal<Local, Bits<2>>,
}

impl Logic for Solo {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, step, awaits, at_work_for, vertex, root_id, root, works, asks, ended, inserted);
        clock!(self, clock, star);
        self.one.next = 1.into();
        self.third_step.next = 2.into();
        self.verdict.next = self.visit.val().verdict;
        self.phase.next.is_locate = self.state.q.val() == SoloState::Locate;
        self.phase.next.is_split = self.state.q.val() == SoloState::Split;
        self.phase.next.is_mend = self.state.q.val() == SoloState::Mend;
        self.phase.next.is_fetch = self.state.q.val() == SoloState::Fetch;
        self.phase.next.is_test = self.state.q.val() == SoloState::Test;
        self.phase.next.is_flip = self.state.q.val() == SoloState::Flip;
        self.is_last_step.next = self.step.q.val() == self.third_step.val();
        self.works.d.next = (self.state.q.val() != SoloState::Idle) & (!self.reset.val());

        self.star.reset.next = self.reset.val();
        self.star.owner.next = self.at_work_for.q.val();
        self.star.phase.next = self.phase.val();
        self.star.step.next = self.step.q.val();
        self.star.p.next = self.vertex.q.val();
        self.star.records.next = self.records.val();
        self.star.root_id.next = self.root_id.q.val();
        self.star.root.next = self.root.q.val();
        self.star.visit.next = self.visit.val();
        self.write.next = self.star.write.val();

        self.is_visiting.next = self.phase.val().is_locate
            | self.phase.val().is_mend
            | self.phase.val().is_fetch
            | self.phase.val().is_test;
        self.asks.d.next = self.is_visiting.val() & (!self.awaits.q.val()) & (!self.reset.val());
        self.push.next.valid = self.asks.q.val();
        self.push.next.bundle = self.star.bundle.val();
        self.awaits.d.next = self.is_visiting.val() & (!self.visit.val().done);

        self.rests.next = self.phase.val().is_test & self.visit.val().done & (!self.verdict.val().conflict);
        self.inserts_now.next = self.rests.val() & self.star.is_round.val();
        self.is_duplicate.next = self.verdict.val().located & self.verdict.val().falls_onto_corner;
        self.ends_now.next =
            self.inserts_now.val() | (self.phase.val().is_locate & self.visit.val().done & self.is_duplicate.val());
        self.inserted.d.next = self.inserts_now.val() & (!self.reset.val());
        self.ended.d.next = self.ends_now.val() & (!self.reset.val());
        self.progress.next.is_at_work = self.works.q.val();
        self.progress.next.tests = self.star.tests.val();
        self.progress.next.flips = self.star.flips.val();
        self.progress.next.inserts = self.inserted.q.val();
        self.progress.next.ends = self.ended.q.val();

        match self.state.q.val() {
            SoloState::Locate => {
                self.step.d.next = 0.into();
                if self.visit.val().done {
                    self.root.d.next = self.visit.val().turned;
                    if self.verdict.val().located {
                        self.state.d.next = SoloState::Split;
                    } else {
                        self.root_id.d.next = self.verdict.val().walk_next;
                    }
                    if self.is_duplicate.val() {
                        self.state.d.next = SoloState::Idle;
                    }
                }
            }
            SoloState::Split => {
                self.step.d.next = self.step.q.val() + self.one.val();
                if self.is_last_step.val() {
                    self.step.d.next = 0.into();
                    self.state.d.next = SoloState::Mend;
                }
            }
            SoloState::Mend => {
                if self.visit.val().done {
                    self.step.d.next = 1.into();
                    if self.step.q.val() == self.one.val() {
                        self.state.d.next = SoloState::Fetch;
                    }
                }
            }
            SoloState::Fetch => {
                if self.visit.val().done {
                    self.state.d.next = SoloState::Test;
                }
            }
            SoloState::Test => {
                self.step.d.next = 0.into();
                if self.visit.val().done {
                    self.state.d.next = SoloState::Flip;
                }
                if self.rests.val() {
                    self.state.d.next = SoloState::Fetch;
                }
                if self.inserts_now.val() {
                    self.state.d.next = SoloState::Idle;
                }
            }
            SoloState::Flip => {
                self.step.d.next = self.step.q.val() + self.one.val();
                if self.is_last_step.val() {
                    self.state.d.next = SoloState::Test;
                }
            }
            _ => {
                self.state.d.next = SoloState::Idle;
                if self.start.val().valid {
                    self.at_work_for.d.next = self.start.val().owner;
                    self.vertex.d.next = self.start.val().p;
                    self.root_id.d.next = self.start.val().u;
                    self.state.d.next = SoloState::Locate;
                }
            }
        }
        if self.reset.val() {
            self.state.d.next = SoloState::Idle;
            self.awaits.d.next = false;
        }
    }
}
