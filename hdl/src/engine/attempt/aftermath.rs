//! The consequences of a completed visit for its context: whether the context falls asleep, keeps its point,
//! or needs the priority.
//!
//! 1. A context falls asleep when its last visit completes. The context keeps its point, unless its ring is complete or
//!    the point equals a vertex (L1).
//! 2. A context asks for the priority when it aborts, and returns it with a complete ring or a duplicate point (L2).
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{Case, Outcome, Step, TriangleId, Visit};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct Aftermath {
    /// The completed visit, its case, and the step of its attempt.
    pub visit: Signal<In, Visit>,
    pub found: Signal<In, Case>,
    pub step: Signal<In, Step>,
    /// The neighbour to which a walk through this record would go on.
    pub walk_next: Signal<In, TriangleId>,
    /// A commit or a release of the context becomes due with this visit.
    pub hands_over: Signal<In, Bit>,
    pub outcome: Signal<Out, Outcome>,
    /// An aborted attempt is over; or a root visit that locked the root ends the attempt (`stops_at_root`). Either way
    /// the locks are due for release.
    pub fails: Signal<Out, Bit>,
    pub stops_at_root: Signal<Out, Bit>,
    is_failure: Signal<Local, Bit>,
    is_duplicate: Signal<Local, Bit>,
    ends_at_root: Signal<Local, Bit>,
}

impl Logic for Aftermath {
    #[hdl_gen]
    fn update(&mut self) {
        self.is_failure.next = self.step.val().is_over & (!self.step.val().succeeds);
        self.is_duplicate.next = self.found.val().walk_duplicate | self.found.val().root_duplicate;
        self.ends_at_root.next = self.found.val().root_duplicate | self.found.val().root_changed;
        self.fails.next = self.is_failure.val();
        self.stops_at_root.next = self.ends_at_root.val();
        self.outcome.next.context = self.visit.val().context;
        self.outcome.next.sleeps = self.found.val().looks
            | self.found.val().walk_duplicate
            | self.found.val().aborts_root
            | self.ends_at_root.val()
            | self.step.val().is_over;
        self.outcome.next.will_retry =
            self.found.val().aborts_root | self.found.val().root_changed | self.is_failure.val();
        self.outcome.next.hands_over = self.hands_over.val();
        self.outcome.next.asks_for_priority = self.found.val().aborts_root | self.found.val().aborts;
        self.outcome.next.waits = self.found.val().waits;
        self.outcome.next.returns_priority =
            self.is_duplicate.val() | self.step.val().succeeds | self.found.val().overflows;
        self.outcome.next.overflows = self.found.val().overflows;
        self.outcome.next.duplicate = self.is_duplicate.val();
        self.outcome.next.root_enable = self.found.val().is_root;
        self.outcome.next.root = self.visit.val().record;
        if self.found.val().root_changed {
            self.outcome.next.root = self.walk_next.val();
        }
    }
}
