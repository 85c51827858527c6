//! Solo insertion in constant state: locates the point, splits its triangle into three, then goes once round the
//! star and flips edges.
//!
//! 1. The mesh has changed since the attempt that overflowed. So the point is located again, from the root
//!    that held it then.
//! 2. Visits of a solo insertion take no locks, and at most one is in flight.
//! 3. While the record outside the star record at work conflicts with the point, the edge between them is flipped and
//!    the same position is tested again. Otherwise the link from outside is mended, and the next star record is at
//!    work. The insertion ends where the round began.
//! 4. All outputs come a clock later than they could. The other blocks then have the whole clock for themselves, and
//!    the speed of a solo insertion does not matter.
//!
//! ```text
//!        apex                  apex
//!        /  \                  /| \            star record    (p, a, apex)
//!      a ---- b     ----->    a |  b           flipped        (p, apex, b)
//!        \  /                  \| /
//!         p                     p
//! ```
//! Latency, with `w` records in the walk and `f` flips: `w + 3 f + 8` visits one after the other (2 mends, `f + 3`
//! fetches, `2 f + 3` tests), each two clocks longer than the visit latency, and `3 f + 5` clocks besides. A duplicate
//! takes `w` visits and two clocks.
//!
//! A walk of two records, the split, and the first mend, with visits of two clocks:
//! ```text
//! starts          ___/^^\_________________________________________
//! is_at_work      _________/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
//! push            _________/^^\________/^^\_________________/^^\__
//! bundle.record     .  .  .  2  .  .  .  0  .  .  .  .  .  .  2  .
//! done            _______________/^^\________/^^\_________________
//! located           .  .  .  .  .___  .  .  ./^^  .  .  .  .  .  .
//! write.valid     ____________________________________/^^^^^^^^\__
//! write.id          .  .  .  .  .  .  .  .  .  .  .  .  0  4  5  .
//! ```
//!
//! Source: Lawson's flips, in the order of the star.

use super::solo_star::SoloStar;
use super::solo_steps::SoloSteps;
use crate::engine::types::{
    Completion, ContextId, Push, SoloProgress, SoloStart, TriangleId, Turned, Verdict, VertexId, Write,
};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct Solo {
    pub clock: Signal<In, Clock>,
    /// Reset ends the insertion.
    pub reset: Signal<In, Bit>,
    /// A solo insertion begins at this edge, with no visit in flight and no lock held; only while none is at work.
    pub start: Signal<In, SoloStart>,
    /// The next new id.
    pub records: Signal<In, TriangleId>,
    /// The visit that completes in this clock.
    pub completion: Signal<In, Completion>,
    /// A visit to make, for the context of the insertion.
    pub push: Signal<Out, Push>,
    /// A record or a link, from a register.
    pub write: Signal<Out, Write>,
    /// The progress; `is_at_work` is high from the clock after `start` has been taken to the clock of `ends`.
    pub progress: Signal<Out, SoloProgress>,
    /// In a core with deletions: the second new id.
    pub own_third: Vec<Signal<In, TriangleId>>,
    awaits: DFF<Bit>,
    at_work_for: DFF<ContextId>,
    vertex: DFF<VertexId>,
    root_id: DFF<TriangleId>,
    root: DFF<Turned>,
    works: DFF<Bit>,
    asks: DFF<Bit>,
    ended: DFF<Bit>,
    inserted: DFF<Bit>,
    steps: SoloSteps,
    star: SoloStar,
    verdict: Signal<Local, Verdict>,
    is_visiting: Signal<Local, Bit>,
}

impl Solo {
    /// The block of a core with deletions.
    pub fn with_deletions() -> Self {
        Self { own_third: vec![Signal::default()], star: SoloStar::with_deletions(), ..Self::default() }
    }
}

impl Logic for Solo {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, awaits, at_work_for, vertex, root_id, root, works, asks, ended, inserted);
        clock!(self, clock, steps, star);
        self.verdict.next = self.completion.val().verdict;
        self.steps.reset.next = self.reset.val();
        self.steps.starts.next = self.start.val().valid;
        self.steps.done.next = self.completion.val().done;
        self.steps.verdict.next = self.verdict.val();
        self.steps.is_round.next = self.star.is_round.val();
        self.works.d.next = (!self.steps.is_idle.val()) & (!self.reset.val());

        self.star.reset.next = self.reset.val();
        self.star.context_id.next = self.at_work_for.q.val();
        self.star.phase.next = self.steps.phase.val();
        self.star.step.next = self.steps.step.val();
        self.star.vertex.next = self.vertex.q.val();
        self.star.records.next = self.records.val();
        self.star.root_id.next = self.root_id.q.val();
        self.star.root.next = self.root.q.val();
        self.star.completion.next = self.completion.val();
        self.write.next = self.star.write.val();
        for i in 0..self.own_third.len() {
            self.star.own_third[i].next = self.own_third[i].val();
        }

        self.is_visiting.next = self.steps.phase.val().is_locate
            | self.steps.phase.val().is_mend
            | self.steps.phase.val().is_fetch
            | self.steps.phase.val().is_test;
        self.asks.d.next = self.is_visiting.val() & (!self.awaits.q.val()) & (!self.reset.val());
        self.awaits.d.next = self.is_visiting.val() & (!self.completion.val().done) & (!self.reset.val());
        self.push.next.valid = self.asks.q.val();
        self.push.next.bundle = self.star.bundle.val();

        self.inserted.d.next = self.steps.inserts.val() & (!self.reset.val());
        self.ended.d.next = self.steps.ends.val() & (!self.reset.val());
        self.progress.next.is_at_work = self.works.q.val();
        self.progress.next.context = self.at_work_for.q.val();
        self.progress.next.tests = self.star.tests.val();
        self.progress.next.flips = self.star.flips.val();
        self.progress.next.inserts = self.inserted.q.val();
        self.progress.next.ends = self.ended.q.val();

        if self.steps.is_idle.val() & self.start.val().valid {
            self.at_work_for.d.next = self.start.val().context;
            self.vertex.d.next = self.start.val().vertex;
            self.root_id.d.next = self.start.val().record;
        }
        if self.steps.phase.val().is_locate & self.completion.val().done {
            self.root.d.next = self.completion.val().turned;
            if !self.verdict.val().located {
                self.root_id.d.next = self.verdict.val().walk_next;
            }
        }
    }
}
