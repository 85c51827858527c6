//! Contexts, their points, and what the engine is at.

use super::widths::{Clocks, ContextId, ContextSet, RingCount, TriangleId, VertexId};
use crate::predicate::Point;
use rust_hdl_core::prelude::*;

/// Bits of [`Plan`].
pub const PLAN_BITS: usize = Plan::BITS;

crate::packed! {
    /// What a context takes next.
    pub struct Plan {
        /// The vertex.
        pub id: VertexId,
        /// It is the third of the context's own first triangle, in a batch.
        pub is_seed: bool,
    }

    /// How points are dealt to contexts.
    pub struct Deal {
        /// Contexts that work.
        pub contexts: ContextId,
        /// Each of them has a mesh of its own.
        pub is_batch: bool,
        /// The first vertex of those that are dealt in turn: 16, or three for each context in a batch.
        pub dealt_from: Bits<7>,
    }

    /// A context starts to walk.
    pub struct Start {
        pub valid: bool,
        pub context: ContextId,
        /// The record at which it starts.
        pub record: TriangleId,
        /// It takes this new point.
        pub takes: bool,
        pub id: VertexId,
    }

    /// The coordinates of the point that a context has taken stand on the vertex memory's port.
    pub struct Fetched {
        pub valid: bool,
        pub context: ContextId,
    }

    /// A context starts to insert its point alone.
    pub struct SoloStart {
        pub valid: bool,
        pub context: ContextId,
        pub vertex: VertexId,
        /// The record at which its walk starts.
        pub record: TriangleId,
    }

    /// The insertion alone.
    pub struct SoloProgress {
        /// Every visit that completes is its own.
        pub is_at_work: bool,
        /// It was over at the last edge; it has inserted its point, which is no duplicate.
        pub ends: bool,
        pub inserts: bool,
        /// A test or a flip of it was finished at the last edge.
        pub tests: bool,
        pub flips: bool,
    }

    /// The first triangles.
    pub struct SeedProgress {
        /// Every first triangle stands.
        pub seeded: bool,
        /// No first triangle is being made, and none can be from the points that have come.
        pub has_no_start: bool,
        /// The last record of one is written at this edge.
        pub seeds: bool,
    }

    /// What each context is at, a bit each; who waits, and who wants to be alone.
    pub struct ContextState {
        /// No visit is out.
        pub asleep: ContextSet,
        /// The point is tried again.
        pub retrying: ContextSet,
        /// A commit or a release is due.
        pub busy: ContextSet,
        /// There has been a point; a commit.
        pub began: ContextSet,
        pub hinted: ContextSet,
        /// Somebody holds the priority; who; it has waited for long: nobody else may try again.
        pub priority_is_held: bool,
        pub priority_context: ContextId,
        pub is_urgent: bool,
        /// Somebody wants to be alone: nobody starts; who.
        pub solo_valid: bool,
        pub solo_context: ContextId,
        /// No visit is out and no lock held; said a clock after it has come true.
        pub all_rest: bool,
    }

    /// What stays as the core was built.
    pub struct Limits {
        /// The infinite vertex.
        pub infinite: VertexId,
        /// Entries of a boundary list.
        pub ring_capacity: RingCount,
        /// The highest record id.
        pub last_id: TriangleId,
        /// Contexts that are built, a bit each.
        pub built_contexts: ContextSet,
        /// Clocks without a finished point before the watchdog speaks.
        pub patience: Clocks,
    }

    /// A point that is stored at this edge.
    pub struct Arrival {
        /// There is one; the others mean nothing without it.
        pub came: bool,
        pub id: VertexId,
        pub point: Point,
    }

    /// What the link sees of the engine.
    pub struct EngineState {
        /// Three points for the first triangle that is due have come, and it does not stand yet.
        pub start_is_open: bool,
        /// Such three are collinear, and no more triangles will be made.
        pub collinear: bool,
        /// Every point is finished, and no lock is held.
        pub is_quiet: bool,
        /// Nothing is finished any more.
        pub stuck: bool,
        /// The lock memory is being cleared after reset.
        pub sweeps: bool,
        /// Records of the mesh.
        pub records: TriangleId,
    }
}
