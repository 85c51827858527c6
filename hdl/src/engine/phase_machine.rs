//! The phases of an insertion.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset awaits a point |
//! | `takes_for_walk`, `takes_for_seed` | in | 1 | a point is taken, to be located or to complete the first triangle |
//! | `seed_ends` | in | 1 | the first triangle stands, or the points are collinear |
//! | `finds`, `finds_duplicate` | in | 1 | a visit ends the walk, on a corner |
//! | `opened` | in | 1 | the last of the root's visits is pushed |
//! | `nothing_is_out`, `overflows` | in | 1 | every visit has completed; the list overflows |
//! | `commit_ends`, `solo_ends` | in | 1 | the insertion is finished |
//! | `is_idle` ... `is_solo` | out | 1 | the phase |
//!
//! ```text
//!        +-----------------------------------------------------------+
//!        v                                                           |
//! Idle -> Walk -> Root -> Cavity ---- ring complete ----> Commit ----+
//!  |  ^     |                |                                       |
//!  v  |     | duplicate      +--- overflow --> Drain --> Solo -------+
//! Seed+     +--> Idle
//! ```
//! Latency: 1 clock.

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

/// The phases; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct PhaseMachine {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Awaits a point.
    pub reset: Signal<In, Bit>,
    /// A point is taken, to be located.
    pub takes_for_walk: Signal<In, Bit>,
    /// A point is taken that completes the first triangle.
    pub takes_for_seed: Signal<In, Bit>,
    /// The seed is over.
    pub seed_ends: Signal<In, Bit>,
    /// A visit locates the point.
    pub finds: Signal<In, Bit>,
    /// On a corner.
    pub finds_duplicate: Signal<In, Bit>,
    /// The root's visits are pushed.
    pub opened: Signal<In, Bit>,
    /// Every visit has completed.
    pub nothing_is_out: Signal<In, Bit>,
    /// The list overflows.
    pub overflows: Signal<In, Bit>,
    /// The commit ends.
    pub commit_ends: Signal<In, Bit>,
    /// The insertion alone ends.
    pub solo_ends: Signal<In, Bit>,
    /// Phase.
    pub is_idle: Signal<Out, Bit>,
    /// Phase.
    pub is_seed: Signal<Out, Bit>,
    /// Phase.
    pub is_walk: Signal<Out, Bit>,
    /// Phase.
    pub is_root: Signal<Out, Bit>,
    /// Phase.
    pub is_cavity: Signal<Out, Bit>,
    /// Phase.
    pub is_commit: Signal<Out, Bit>,
    /// Phase.
    pub is_drain: Signal<Out, Bit>,
    /// Phase.
    pub is_solo: Signal<Out, Bit>,
    phase: DFF<Phase>,
}

impl Logic for PhaseMachine {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, phase);
        self.is_idle.next = self.phase.q.val() == Phase::Idle;
        self.is_seed.next = self.phase.q.val() == Phase::Seed;
        self.is_walk.next = self.phase.q.val() == Phase::Walk;
        self.is_root.next = self.phase.q.val() == Phase::Root;
        self.is_cavity.next = self.phase.q.val() == Phase::Cavity;
        self.is_commit.next = self.phase.q.val() == Phase::Commit;
        self.is_drain.next = self.phase.q.val() == Phase::Drain;
        self.is_solo.next = self.phase.q.val() == Phase::Solo;
        match self.phase.q.val() {
            Phase::Idle => {
                if self.takes_for_walk.val() {
                    self.phase.d.next = Phase::Walk;
                }
                if self.takes_for_seed.val() {
                    self.phase.d.next = Phase::Seed;
                }
            }
            Phase::Seed => {
                if self.seed_ends.val() {
                    self.phase.d.next = Phase::Idle;
                }
            }
            Phase::Walk => {
                if self.finds.val() {
                    self.phase.d.next = Phase::Root;
                }
                if self.finds_duplicate.val() {
                    self.phase.d.next = Phase::Idle;
                }
            }
            Phase::Root => {
                if self.opened.val() {
                    self.phase.d.next = Phase::Cavity;
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
                    self.phase.d.next = Phase::Idle;
                }
            }
            _ => {
                self.phase.d.next = Phase::Idle;
            }
        }
        if self.reset.val() {
            self.phase.d.next = Phase::Idle;
        }
    }
}
