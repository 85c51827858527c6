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
//! ```text
//!        +-----------------------------------------------------------+
//!        v                                                           |
//! Idle -> Walk -> Root -> Cavity ---- ring complete ----> Commit ----+
//!  |  ^     |                |                                       |
//!  v  |     | duplicate      +--- overflow --> Drain --> Solo -------+
//! Seed+     +--> Idle
//! ```
//! Latency: 1 clock from `done` to `push`.

use super::{Bundle, RootBundle, SeedWrites, Token, Turned, Verdict, Write};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What the context does.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum Phase {
    /// Awaits a point.
    Idle,
    /// Makes the first triangle.
    Seed,
    /// Locates the point.
    Walk,
    /// Opens the cavity.
    Root,
    /// Grows it.
    Cavity,
    /// The star is written.
    Commit,
    /// Visits run out after an overflow.
    Drain,
    /// The point is inserted alone.
    Solo,
}

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
    phase: DFF<Phase>,
    step: DFF<Bits<3>>,
    vertex: DFF<Bits<15>>,
    vertex_position: DFF<Bits<32>>,
    start: DFF<Bits<15>>,
    is_seeded: DFF<Bit>,
    is_collinear: DFF<Bit>,
    turns_left: DFF<Bit>,
    record_count: DFF<Bits<15>>,
    located_id: DFF<Bits<15>>,
    located: DFF<Turned>,
    pushes: DFF<Bit>,
    pushed: DFF<Bundle>,
    request: DFF<Write>,
    seed_writes: SeedWrites,
    root_bundle: RootBundle,
    look: Signal<Local, Bundle>,
    takes: Signal<Local, Bit>,
    walk_is_done: Signal<Local, Bit>,
    is_found: Signal<Local, Bit>,
    opens: Signal<Local, Bit>,
    is_last_root_step: Signal<Local, Bit>,
    is_look_step: Signal<Local, Bit>,
    is_last_seed_step: Signal<Local, Bit>,
    is_first_vertex: Signal<Local, Bit>,
    is_third_vertex: Signal<Local, Bit>,
    step0: Signal<Local, Bits<3>>,
    step2: Signal<Local, Bits<3>>,
    step4: Signal<Local, Bits<3>>,
    one_step: Signal<Local, Bits<3>>,
    vertex0: Signal<Local, Bits<15>>,
    vertex2: Signal<Local, Bits<15>>,
    one: Signal<Local, Bits<15>>,
    two: Signal<Local, Bits<15>>,
}

impl Logic for Context {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            phase,
            step,
            vertex,
            vertex_position,
            start,
            is_seeded,
            is_collinear
        );
        dff_setup!(
            self,
            clock,
            turns_left,
            record_count,
            located_id,
            located,
            pushes,
            pushed,
            request
        );
        self.step0.next = 0.into();
        self.step2.next = 2.into();
        self.step4.next = 4.into();
        self.one_step.next = 1.into();
        self.vertex0.next = 0.into();
        self.vertex2.next = 2.into();
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.is_look_step.next = self.step.q.val() == self.step0.val();
        self.is_last_root_step.next = self.step.q.val() == self.step2.val();
        self.is_last_seed_step.next = self.step.q.val() == self.step4.val();
        self.is_first_vertex.next = self.point_id.val() == self.vertex0.val();
        self.is_third_vertex.next = self.point_id.val() == self.vertex2.val();

        self.is_idle.next = self.phase.q.val() == Phase::Idle;
        self.is_root.next = self.phase.q.val() == Phase::Root;
        self.is_cavity.next = self.phase.q.val() == Phase::Cavity;
        self.is_commit.next = self.phase.q.val() == Phase::Commit;
        self.is_drain.next = self.phase.q.val() == Phase::Drain;
        self.is_solo.next = self.phase.q.val() == Phase::Solo;
        self.p.next = self.vertex.q.val();
        self.position.next = self.vertex_position.q.val();
        self.root_id.next = self.located_id.q.val();
        self.root.next = self.located.q.val();
        self.records.next = self.record_count.q.val();
        self.seeded.next = self.is_seeded.q.val();
        self.collinear.next = self.is_collinear.q.val();
        self.push.next = self.pushes.q.val();
        self.bundle.next = self.pushed.q.val();
        self.write.next = self.request.q.val();

        self.takes.next = (self.phase.q.val() == Phase::Idle) & self.point_valid.val();
        self.takes_point.next = self.takes.val();
        self.walk_is_done.next = (self.phase.q.val() == Phase::Walk) & self.done.val();
        self.walk_visit.next = self.walk_is_done.val();
        self.is_found.next = self.verdict.val().located & self.verdict.val().falls_onto_corner;
        self.duplicate.next = self.walk_is_done.val() & self.is_found.val();
        self.drained.next = (self.phase.q.val() == Phase::Drain) & self.nothing_is_out.val();
        self.seeds.next = (self.phase.q.val() == Phase::Seed) & self.is_last_seed_step.val();
        self.opens.next = (self.phase.q.val() == Phase::Root) & (!self.locks_are_held.val());
        self.root_visits.next = 0.into();
        if self.opens.val() {
            self.root_visits.next = self.root_bundle.visits.val();
        }

        // What can be pushed: a look, the root's visits, a split, or what an insertion alone wants.
        self.look.next.is_pair = false;
        self.look.next.rotates = false;
        self.look.next.locks = false;
        self.look.next.x = 0.into();
        self.look.next.after = 0.into();
        self.look.next.f_entry = 0.into();
        self.look.next.f = 0.into();
        self.look.next.u = self.verdict.val().walk_next;
        self.look.next.second_x = 0.into();
        self.look.next.second_after = 0.into();
        self.look.next.second_u = 0.into();
        self.root_bundle.step.next = self.step.q.val();
        self.root_bundle.root_id.next = self.located_id.q.val();
        self.root_bundle.root.next = self.located.q.val();
        self.pushes.d.next = self.split.val() | self.solo_push.val();
        self.pushed.d.next = self.split_bundle.val();
        if self.solo_push.val() {
            self.pushed.d.next = self.solo_bundle.val();
        }
        self.seed_writes.step.next = self.step.q.val();
        self.seed_writes.turns_left.next = self.turns_left.q.val();
        self.seed_writes.infinite.next = self.infinite.val();
        if self.phase.q.val() == Phase::Idle {
            self.seed_writes.step.next = 0.into();
            self.look.next.u = self.start.q.val();
        }
        self.request.d.next = self.seed_writes.write.val();
        self.request.d.next.valid = false;
        if self.takes_fresh.val() {
            self.record_count.d.next = self.record_count.q.val() + self.one.val();
        }

        match self.phase.q.val() {
            Phase::Idle => {
                self.step.d.next = 0.into();
                if self.takes.val() {
                    self.vertex.d.next = self.point_id.val();
                    self.vertex_position.d.next = self.point.val();
                    self.pushed.d.next = self.look.val();
                    if self.is_seeded.q.val() {
                        self.pushes.d.next = true;
                        self.phase.d.next = Phase::Walk;
                    } else {
                        self.request.d.next.valid = self.is_first_vertex.val();
                        if self.is_third_vertex.val() {
                            self.pushes.d.next = true;
                            self.phase.d.next = Phase::Seed;
                        }
                    }
                }
            }
            Phase::Seed => {
                if self.is_look_step.val() {
                    self.turns_left.d.next = self.verdict.val().is_left;
                    if self.done.val() {
                        self.step.d.next = self.step.q.val() + self.one_step.val();
                        if self.verdict.val().is_straight {
                            self.is_collinear.d.next = true;
                            self.phase.d.next = Phase::Idle;
                        }
                    }
                } else {
                    self.request.d.next.valid = true;
                    self.step.d.next = self.step.q.val() + self.one_step.val();
                    if self.is_last_seed_step.val() {
                        self.is_seeded.d.next = true;
                        self.record_count.d.next = 4.into();
                        self.phase.d.next = Phase::Idle;
                    }
                }
            }
            Phase::Walk => {
                self.pushed.d.next = self.look.val();
                if self.done.val() {
                    self.pushes.d.next = !self.verdict.val().located;
                    self.located_id.d.next = self.token.val().u;
                    self.located.d.next = self.turned.val();
                    self.start.d.next = self.token.val().u;
                    if self.verdict.val().located {
                        self.phase.d.next = Phase::Root;
                        if self.verdict.val().falls_onto_corner {
                            self.phase.d.next = Phase::Idle;
                        }
                    }
                }
            }
            Phase::Root => {
                self.pushed.d.next = self.root_bundle.bundle.val();
                self.pushes.d.next = self.opens.val();
                if self.opens.val() {
                    self.step.d.next = self.step.q.val() + self.one_step.val();
                    if self.is_last_root_step.val() {
                        self.phase.d.next = Phase::Cavity;
                    }
                }
            }
            Phase::Cavity => {
                if self.nothing_is_out.val() {
                    self.phase.d.next = Phase::Commit;
                }
                if self.overflows.val() {
                    self.phase.d.next = Phase::Drain;
                }
            }
            Phase::Commit => {
                if self.commit_ends.val() {
                    self.phase.d.next = Phase::Idle;
                }
            }
            Phase::Drain => {
                if self.nothing_is_out.val() {
                    self.phase.d.next = Phase::Solo;
                }
            }
            Phase::Solo => {
                if self.solo_ends.val() {
                    self.record_count.d.next = self.record_count.q.val() + self.two.val();
                    self.phase.d.next = Phase::Idle;
                }
            }
            _ => {
                self.phase.d.next = Phase::Idle;
            }
        }
        if self.clears.val() | self.reset.val() {
            self.is_seeded.d.next = false;
            self.is_collinear.d.next = false;
            self.record_count.d.next = 0.into();
            self.start.d.next = 0.into();
        }
        if self.reset.val() {
            self.phase.d.next = Phase::Idle;
            self.pushes.d.next = false;
            self.request.d.next.valid = false;
        }
    }
}
