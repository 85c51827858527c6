//! The phases of an insertion: what the context does, and the bundle it pushes.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset forgets the mesh |
//! | `infinite` | in | 15 | the infinite vertex, a constant |
//! | `clears` | in | 1 | forget the mesh at this edge |
//! | `point_valid`, `point_id`, `point` | in | 1, 15, 32 | the point that waits |
//! | `takes_point` | out | 1 | it is taken at this edge |
//! | `done`, `token`, `turned`, `verdict` | in | | the visit that completes |
//! | `split`, `split_bundle`, `overflows`, `nothing_is_out` | in | | the cavity |
//! | `commit_ends`, `takes_fresh` | in | 1 | the commit |
//! | `solo_push`, `solo_bundle`, `solo_ends` | in | | the insertion alone |
//! | `locks_are_held` | in | 1 | locks are being released |
//! | `is_idle` ... `is_solo` | out | 1 | phase |
//! | `root_visits` | out | 2 | visits that `Root` pushes at this edge |
//! | `p`, `position` | out | 15, 32 | the point at work |
//! | `root_id`, `root` | out | 15, Turned | where it was located |
//! | `records` | out | 15 | records of the mesh: the next new id |
//! | `seeded`, `collinear` | out | 1 | the first triangle stands; the first three points are collinear |
//! | `seeds`, `drained`, `walk_visit`, `duplicate` | out | 1 | events at this edge |
//! | `push`, `bundle` | out | 1, Bundle | visits to make, registered |
//! | `write` | out | Write | a record of the first triangle, registered |
//!
//! 1. A walk may start while the locks of the insertion before are being released; its cavity waits for them.
//! 2. The next walk starts at the root of the last insertion, or where a duplicate was found.
//!
//! Latency: 1 clock from `done` to `push`.

use super::{Bundle, PhaseMachine, PushChoice, RootBundle, Seeder, Token, Turned, Verdict, Write};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The context; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct Context {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Forgets the mesh and the point.
    pub reset: Signal<In, Bit>,
    /// The infinite vertex.
    pub infinite: Signal<In, Bits<15>>,
    /// Forgets the mesh.
    pub clears: Signal<In, Bit>,
    /// A point waits.
    pub point_valid: Signal<In, Bit>,
    /// Its vertex id.
    pub point_id: Signal<In, Bits<15>>,
    /// Its coordinates.
    pub point: Signal<In, Bits<32>>,
    /// It is taken.
    pub takes_point: Signal<Out, Bit>,
    /// A visit completes.
    pub done: Signal<In, Bit>,
    /// The visit.
    pub token: Signal<In, Token>,
    /// Its record.
    pub turned: Signal<In, Turned>,
    /// What it found out.
    pub verdict: Signal<In, Verdict>,
    /// A test passed through its edge.
    pub split: Signal<In, Bit>,
    /// The visits behind it.
    pub split_bundle: Signal<In, Bundle>,
    /// The list overflows.
    pub overflows: Signal<In, Bit>,
    /// Every visit has completed.
    pub nothing_is_out: Signal<In, Bit>,
    /// The commit ends.
    pub commit_ends: Signal<In, Bit>,
    /// It takes a new id.
    pub takes_fresh: Signal<In, Bit>,
    /// The insertion alone wants a visit.
    pub solo_push: Signal<In, Bit>,
    /// The visit.
    pub solo_bundle: Signal<In, Bundle>,
    /// It ends.
    pub solo_ends: Signal<In, Bit>,
    /// Locks are being released.
    pub locks_are_held: Signal<In, Bit>,
    /// Phase.
    pub is_idle: Signal<Out, Bit>,
    /// Phase.
    pub is_root: Signal<Out, Bit>,
    /// Phase.
    pub is_cavity: Signal<Out, Bit>,
    /// Phase.
    pub is_drain: Signal<Out, Bit>,
    /// Phase.
    pub is_commit: Signal<Out, Bit>,
    /// Phase.
    pub is_solo: Signal<Out, Bit>,
    /// Visits pushed by `Root`.
    pub root_visits: Signal<Out, Bits<2>>,
    /// The vertex at work.
    pub p: Signal<Out, Bits<15>>,
    /// Its coordinates.
    pub position: Signal<Out, Bits<32>>,
    /// Where it was located.
    pub root_id: Signal<Out, Bits<15>>,
    /// The record there.
    pub root: Signal<Out, Turned>,
    /// Records of the mesh.
    pub records: Signal<Out, Bits<15>>,
    /// The first triangle stands.
    pub seeded: Signal<Out, Bit>,
    /// The first three points are collinear.
    pub collinear: Signal<Out, Bit>,
    /// The first triangle is finished.
    pub seeds: Signal<Out, Bit>,
    /// An overflowed attempt has no visit out.
    pub drained: Signal<Out, Bit>,
    /// A visit of a walk completes.
    pub walk_visit: Signal<Out, Bit>,
    /// It found a duplicate.
    pub duplicate: Signal<Out, Bit>,
    /// Visits to make.
    pub push: Signal<Out, Bit>,
    /// The visits.
    pub bundle: Signal<Out, Bundle>,
    /// A record of the first triangle.
    pub write: Signal<Out, Write>,
    phases: PhaseMachine,
    step: DFF<Bits<3>>,
    vertex: DFF<Bits<15>>,
    vertex_position: DFF<Bits<32>>,
    start: DFF<Bits<15>>,
    record_count: DFF<Bits<15>>,
    located_id: DFF<Bits<15>>,
    located: DFF<Turned>,
    pushes: DFF<Bit>,
    pushed: DFF<Bundle>,
    seeder: Seeder,
    root_bundle: RootBundle,
    choice: PushChoice,
    takes: Signal<Local, Bit>,
    takes_third: Signal<Local, Bit>,
    takes_for_walk: Signal<Local, Bit>,
    walk_is_done: Signal<Local, Bit>,
    is_found: Signal<Local, Bit>,
    opens: Signal<Local, Bit>,
    is_last_root_step: Signal<Local, Bit>,
    vertex0: Signal<Local, Bits<15>>,
    vertex2: Signal<Local, Bits<15>>,
    last_root_step: Signal<Local, Bits<3>>,
    one_step: Signal<Local, Bits<3>>,
    one: Signal<Local, Bits<15>>,
    two: Signal<Local, Bits<15>>,
}

impl Logic for Context {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, step, vertex, vertex_position, start);
        dff_setup!(self, clock, record_count, located_id, located, pushes, pushed);
        clock!(self, clock, phases, seeder);
        self.vertex0.next = 0.into();
        self.vertex2.next = 2.into();
        self.last_root_step.next = 2.into();
        self.one_step.next = 1.into();
        self.one.next = 1.into();
        self.two.next = 2.into();

        self.is_idle.next = self.phases.is_idle.val();
        self.is_root.next = self.phases.is_root.val();
        self.is_cavity.next = self.phases.is_cavity.val();
        self.is_commit.next = self.phases.is_commit.val();
        self.is_drain.next = self.phases.is_drain.val();
        self.is_solo.next = self.phases.is_solo.val();
        self.p.next = self.vertex.q.val();
        self.position.next = self.vertex_position.q.val();
        self.root_id.next = self.located_id.q.val();
        self.root.next = self.located.q.val();
        self.records.next = self.record_count.q.val();
        self.push.next = self.pushes.q.val();
        self.bundle.next = self.pushed.q.val();

        // What happens at this edge.
        self.takes.next = self.phases.is_idle.val() & self.point_valid.val();
        self.takes_for_walk.next = self.takes.val() & self.seeder.seeded.val();
        self.takes_third.next =
            self.takes.val() & (!self.seeder.seeded.val()) & (self.point_id.val() == self.vertex2.val());
        self.takes_point.next = self.takes.val();
        self.walk_is_done.next = self.phases.is_walk.val() & self.done.val();
        self.walk_visit.next = self.walk_is_done.val();
        self.is_found.next = self.verdict.val().located & self.verdict.val().falls_onto_corner;
        self.duplicate.next = self.walk_is_done.val() & self.is_found.val();
        self.drained.next = self.phases.is_drain.val() & self.nothing_is_out.val();
        self.opens.next = self.phases.is_root.val() & (!self.locks_are_held.val());
        self.is_last_root_step.next = self.step.q.val() == self.last_root_step.val();
        self.root_visits.next = 0.into();
        if self.opens.val() {
            self.root_visits.next = self.root_bundle.visits.val();
        }

        self.phases.reset.next = self.reset.val();
        self.phases.takes_for_walk.next = self.takes_for_walk.val();
        self.phases.takes_for_seed.next = self.takes_third.val();
        self.phases.seed_ends.next = self.seeder.ends.val();
        self.phases.finds.next = self.walk_is_done.val() & self.verdict.val().located;
        self.phases.finds_duplicate.next = self.walk_is_done.val() & self.is_found.val();
        self.phases.opened.next = self.opens.val() & self.is_last_root_step.val();
        self.phases.nothing_is_out.next = self.nothing_is_out.val();
        self.phases.overflows.next = self.overflows.val();
        self.phases.commit_ends.next = self.commit_ends.val();
        self.phases.solo_ends.next = self.solo_ends.val();

        // The first triangle.
        self.seeder.reset.next = self.reset.val();
        self.seeder.clears.next = self.clears.val();
        self.seeder.infinite.next = self.infinite.val();
        self.seeder.prepares.next =
            self.takes.val() & (!self.seeder.seeded.val()) & (self.point_id.val() == self.vertex0.val());
        self.seeder.is_seed.next = self.phases.is_seed.val();
        self.seeder.done.next = self.done.val();
        self.seeder.verdict.next = self.verdict.val();
        self.seeded.next = self.seeder.seeded.val();
        self.collinear.next = self.seeder.collinear.val();
        self.seeds.next = self.seeder.seeds.val();
        self.write.next = self.seeder.write.val();

        // The visits pushed.
        self.root_bundle.step.next = self.step.q.val();
        self.root_bundle.root_id.next = self.located_id.q.val();
        self.root_bundle.root.next = self.located.q.val();
        self.choice.looks.next = self.takes_for_walk.val()
            | self.takes_third.val()
            | (self.walk_is_done.val() & (!self.verdict.val().located));
        self.choice.look_id.next = self.verdict.val().walk_next;
        if self.phases.is_idle.val() {
            self.choice.look_id.next = self.start.q.val();
        }
        self.choice.opens.next = self.opens.val();
        self.choice.root_bundle.next = self.root_bundle.bundle.val();
        self.choice.split.next = self.split.val();
        self.choice.split_bundle.next = self.split_bundle.val();
        self.choice.solo_push.next = self.solo_push.val();
        self.choice.solo_bundle.next = self.solo_bundle.val();
        self.pushes.d.next = self.choice.push.val();
        self.pushed.d.next = self.choice.bundle.val();

        if self.takes.val() {
            self.vertex.d.next = self.point_id.val();
            self.vertex_position.d.next = self.point.val();
        }
        if self.walk_is_done.val() {
            self.located_id.d.next = self.token.val().u;
            self.located.d.next = self.turned.val();
            self.start.d.next = self.token.val().u;
        }
        if self.opens.val() {
            self.step.d.next = self.step.q.val() + self.one_step.val();
        } else {
            self.step.d.next = 0.into();
        }
        if self.takes_fresh.val() {
            self.record_count.d.next = self.record_count.q.val() + self.one.val();
        }
        if self.solo_ends.val() {
            self.record_count.d.next = self.record_count.q.val() + self.two.val();
        }
        if self.seeder.seeds.val() {
            self.record_count.d.next = 4.into();
        }

        if self.clears.val() | self.reset.val() {
            self.record_count.d.next = 0.into();
            self.start.d.next = 0.into();
        }
        if self.reset.val() {
            self.pushes.d.next = false;
        }
    }
}
