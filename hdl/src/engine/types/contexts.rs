//! The contexts and their points, and the state of the engine as a whole.

use super::widths::{Clocks, ContextId, ContextSet, RingCount, TriangleId, VertexId};
use crate::predicate::Point;
use rust_hdl_core::prelude::*;

/// Width of [`Plan`] in bits.
pub const PLAN_BITS: usize = Plan::BITS;
/// Width of [`Priority`] in bits.
pub const PRIORITY_BITS: usize = Priority::BITS;

crate::packed! {
    /// The vertex that a context takes next.
    pub struct Plan {
        pub id: VertexId,
        /// The vertex is the third one of the job's first triangle.
        pub is_seed: bool,
    }

    /// The rule by which points are dealt to contexts.
    pub struct Deal {
        /// The number of contexts that work.
        pub contexts: ContextId,
        /// The number of jobs side by side, each with a mesh and a team of contexts; 1 outside a batch. It divides
        /// that of the contexts.
        pub jobs: ContextId,
        /// The first vertex behind the first triangles: three for each job.
        pub dealt_from: Bits<7>,
    }

    /// The state of the priority of a team.
    pub struct Priority {
        /// The priority is held, by this context.
        pub is_held: bool,
        pub context: ContextId,
        /// The number of foreign locks that the context has met since it took the priority, up to 8.
        pub waits: Bits<4>,
    }

    /// A context starts to walk at this edge.
    pub struct Start {
        pub valid: bool,
        pub context: ContextId,
        /// The record at which the walk starts.
        pub record: TriangleId,
        /// The context takes the new point `id`; without this flag it retries the point that it has.
        pub takes: bool,
        pub id: VertexId,
    }

    /// The coordinates of the point that the context has taken are at the port of the vertex memory.
    pub struct Fetched {
        pub valid: bool,
        pub context: ContextId,
    }

    /// The events that end the items of a run of changes, and whether an item can begin.
    pub struct ChangeEvents {
        /// The visit that completes ends the attempt of its context with a complete ring (`hands_over`), or finds that
        /// a vertex has the point (`duplicate`); the vertex that its context inserts. A root visit completes
        /// (`is_root`).
        pub hands_over: bool,
        pub duplicate: bool,
        pub is_root: bool,
        pub vertex: VertexId,
        /// The last write of a commit is requested; its context and its new vertex.
        pub commit_ends: bool,
        pub committed_context: ContextId,
        pub committed_vertex: VertexId,
        /// A solo insertion has ended, with its point in the mesh or not; its context.
        pub solo_ends: bool,
        pub solo_inserts: bool,
        pub solo_context: ContextId,
        /// A context takes a point of an `Insert` that is dealt to it, and that vertex.
        pub takes: bool,
        pub taken: VertexId,
        /// An item can begin at this edge.
        pub may_launch: bool,
        /// No visit is in flight and no lock is held; the flag rises a clock after both hold.
        pub all_rest: bool,
        /// The item of a deletion ends with its hole: the hole is full, or no triangle would be left; its context and
        /// vertex.
        pub fill_ends: bool,
        pub fill_is_flat: bool,
        pub fill_context: ContextId,
        pub fill_vertex: VertexId,
        /// The visit that completes is one of a deletion, or of a move whose vertex is in the mesh (`finds`). It ends a
        /// move in place; or the last write of a deletion puts a vertex out of the mesh that goes back into it.
        pub finds: bool,
        pub moves_in_place: bool,
        pub puts_out: bool,
        pub put_out_context: ContextId,
        /// In a clock with the end of an attempt or of a solo insertion: ids are kept for its vertex.
        pub owns: bool,
    }

    /// A context starts the solo insertion of its point.
    pub struct SoloStart {
        pub valid: bool,
        pub context: ContextId,
        pub vertex: VertexId,
        /// The record at which the walk of the solo insertion starts.
        pub record: TriangleId,
    }

    /// The progress of a solo insertion.
    pub struct SoloProgress {
        /// A solo insertion is at work: every visit that completes is its own.
        pub is_at_work: bool,
        /// The context whose point is inserted.
        pub context: ContextId,
        /// The solo insertion ended at the last edge; its point is inserted (`inserts`) or equals a vertex.
        pub ends: bool,
        pub inserts: bool,
        /// A test or a flip of the solo insertion was completed at the last edge.
        pub tests: bool,
        pub flips: bool,
    }

    /// The progress of the first triangles.
    pub struct SeedProgress {
        /// Every first triangle is in the mesh.
        pub seeded: bool,
        /// No first triangle is being made, because the points that have come are too few or collinear.
        pub has_no_start: bool,
        /// The last record of a first triangle is written at this edge.
        pub seeds: bool,
    }

    /// The state of all contexts, a bit each.
    pub struct ContextState {
        /// The context is asleep: none of its visits is in flight.
        pub asleep: ContextSet,
        /// The context keeps its point and will retry.
        pub retrying: ContextSet,
        /// A commit or a release of the context is due.
        pub busy: ContextSet,
        /// The context has had a point; it has had a commit (`hinted`), so it has a root at which its next walk starts.
        pub began: ContextSet,
        pub hinted: ContextSet,
        /// The context asks for a solo insertion or is at it. While any does (`solo_valid`), no context starts.
        pub solo: ContextSet,
        pub solo_valid: bool,
        /// No visit is in flight and no lock is held; the flag rises a clock after both hold.
        pub all_rest: bool,
    }

    /// The constants of the configuration.
    pub struct Limits {
        /// The number of the infinite vertex.
        pub infinite: VertexId,
        /// The number of entries that a ring can have.
        pub ring_capacity: RingCount,
        /// The highest record id.
        pub last_id: TriangleId,
        /// The contexts that are built, a bit each.
        pub built_contexts: ContextSet,
        /// The number of clocks without a finished point after which the watchdog reports.
        pub patience: Clocks,
    }

    /// A point that is stored at this edge.
    pub struct Arrival {
        /// A point comes; without this flag the other fields are arbitrary.
        pub came: bool,
        pub id: VertexId,
        pub point: Point,
    }

    /// The state of the engine as the command port sees it.
    pub struct EngineState {
        /// The three points of the first triangle that is due have come, but the triangle is not in the mesh yet.
        pub start_is_open: bool,
        /// These three points are collinear, and no first triangle will be made any more.
        pub collinear: bool,
        /// Every point is finished, and no lock is held.
        pub is_quiet: bool,
        /// The watchdog has reported: no point was finished for too long.
        pub stuck: bool,
        /// The lock memory is being cleared after reset.
        pub sweeps: bool,
        /// The number of records of the mesh.
        pub records: TriangleId,
    }
}
