//! What travels between the blocks of the engine.
//!
//! Widths are those of the largest core: ids of 15 bits, ring entries of 6. Memories of smaller configurations store fewer bits
//! and return zeros above them, so synthesis removes the rest.

use crate::predicate::Point;
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;

/// Bits of a triangle id: `2 * 16384` records.
pub const TRIANGLE_BITS: usize = 15;
/// Bits of a vertex id: 16384 points and the infinite vertex, all ones in the configuration's width.
pub const VERTEX_BITS: usize = 15;
/// Bits of a ring entry number: 64 entries.
pub const ENTRY_BITS: usize = 6;
/// Bits of a count of ring entries, 0 to 64.
pub const COUNT_BITS: usize = 7;
/// Bits of a count of locks: an insertion sets at most `2 * 64 - 2`.
pub const LOG_BITS: usize = 7;

/// Bits of a context number: 24 contexts.
pub const CONTEXT_BITS: usize = 5;
/// Bits of a latency, a clock count that wraps.
pub const LATENCY_BITS: usize = incircle_protocol::LATENCY_BITS as usize;
/// Bits of the address of a memory with a word for each ring entry of each context.
pub const RING_ADDRESS_BITS: usize = CONTEXT_BITS + ENTRY_BITS;
/// Bits of the address of a memory with a word for each lock of each context.
pub const LOG_ADDRESS_BITS: usize = CONTEXT_BITS + LOG_BITS;

/// A triangle record.
pub type TriangleId = Bits<TRIANGLE_BITS>;
/// A vertex.
pub type VertexId = Bits<VERTEX_BITS>;
/// A context.
pub type ContextId = Bits<CONTEXT_BITS>;
/// A bit for each context.
pub type ContextSet = Bits<24>;
/// An entry of a boundary list.
pub type RingEntry = Bits<ENTRY_BITS>;
/// A count of ring entries.
pub type RingCount = Bits<COUNT_BITS>;
/// A count of locks, or a place in a log of locks.
pub type LockCount = Bits<LOG_BITS>;
/// A count of clocks that wraps.
pub type Clocks = Bits<LATENCY_BITS>;
/// A column of a record.
pub type Slot = Bits<2>;

/// Bits of [`Plan`].
pub const PLAN_BITS: usize = Plan::BITS;
/// Bits of [`Token`].
pub const TOKEN_BITS: usize = Token::BITS;
/// Bits of [`Bundle`].
pub const BUNDLE_BITS: usize = Bundle::BITS;
/// Bits of [`Turned`].
pub const TURNED_BITS: usize = Turned::BITS;
/// Bits of [`Entry`].
pub const ENTRY_WORD_BITS: usize = Entry::BITS;
/// Bits of [`Attempt`].
pub const ATTEMPT_BITS: usize = Attempt::BITS;
/// Bits of [`CommitJob`].
pub const COMMIT_JOB_BITS: usize = CommitJob::BITS;
/// Bits of [`ReleaseJob`].
pub const RELEASE_JOB_BITS: usize = ReleaseJob::BITS;

/// Address bits that number the contexts of a configuration.
pub fn context_bits(config: Config) -> usize {
    bits_to_number(config.contexts)
}

/// Address bits that number the ring entries of a configuration.
pub fn ring_bits(config: Config) -> usize {
    bits_to_number(config.ring)
}

/// Bits that number `things`; at least one.
fn bits_to_number(things: u32) -> usize {
    (u32::BITS - (things.max(2) - 1).leading_zeros()) as usize
}

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

    /// One visit of a record.
    pub struct Token {
        /// The context it belongs to.
        pub owner: ContextId,
        /// The record is turned so that its link to `f` comes first.
        pub rotates: bool,
        /// The record's lock is taken.
        pub locks: bool,
        /// Ring entry whose edge is tested.
        pub x: RingEntry,
        /// The entry after it.
        pub after: RingEntry,
        /// The entry that was allocated when `f` joined the cavity; 0 for the root.
        pub f_entry: RingEntry,
        /// The cavity triangle behind the edge.
        pub f: TriangleId,
        /// The record visited.
        pub u: TriangleId,
    }

    /// One to three visits that one completion asks for. The second visit has `x = after` of the first and the third `x =
    /// second_after` and `after = 0`; all other fields are those of the first.
    pub struct Bundle {
        /// There is a second visit.
        pub is_pair: bool,
        /// There are a second and a third visit; `is_pair` is set too.
        pub is_triple: bool,
        pub owner: ContextId,
        pub rotates: bool,
        pub locks: bool,
        pub x: RingEntry,
        pub after: RingEntry,
        pub f_entry: RingEntry,
        pub f: TriangleId,
        pub u: TriangleId,
        /// `after` of the second visit.
        pub second_after: RingEntry,
        /// `u` of the second visit.
        pub second_u: TriangleId,
        /// `u` of the third visit.
        pub third_u: TriangleId,
    }

    /// A record that has been read and turned.
    pub struct Turned {
        /// Vertices, counter-clockwise.
        pub v0: VertexId,
        pub v1: VertexId,
        pub v2: VertexId,
        /// Links; `n0` is opposite `v0`.
        pub n0: TriangleId,
        pub n1: TriangleId,
        pub n2: TriangleId,
        /// The stored slot that now comes first.
        pub slot: Slot,
        /// The visit took the record's lock.
        pub took: bool,
        /// It would have, but another context holds it, or it was being cleared.
        pub foreign: bool,
        /// The record was not written yet, or being written: a walk must look again.
        pub again: bool,
        /// That vertex is the infinite one.
        pub infinite0: bool,
        pub infinite1: bool,
        pub infinite2: bool,
    }

    /// The state of a context's cavity, from the visit that locks its root. `half_open` comes last: a memory keeps as many of its
    /// bits as a ring has entries.
    pub struct Attempt {
        /// It has failed: its visits run out.
        pub drains: bool,
        /// Visits pushed and not completed.
        pub outstanding: RingCount,
        /// Ring entries.
        pub count: RingCount,
        /// Cavity triangles without a boundary edge.
        pub inners: RingCount,
        /// Locks in the log.
        pub logged: LockCount,
        /// Bit `y`: one of the two edges that entry `y`'s cavity triangle brought has been passed. The root brought three and uses
        /// bits 0 and 1.
        pub half_open: Bits<64>,
    }

    /// A finished ring, to be committed.
    pub struct CommitJob {
        /// Its context.
        pub owner: ContextId,
        /// The new vertex.
        pub p: VertexId,
        /// Inner triangles.
        pub inners: RingCount,
        /// Locks in the log.
        pub locks: LockCount,
        /// When the point was taken.
        pub since: Clocks,
    }

    /// The locks of an attempt, to be released.
    pub struct ReleaseJob {
        /// Its context.
        pub owner: ContextId,
        /// Locks in the log, at least one.
        pub locks: LockCount,
    }

    /// What a visit found out. Fields that a visit does not need hold what came out all the same.
    pub struct Verdict {
        /// The record goes when the point comes.
        pub conflict: bool,
        /// The point lies in this triangle, or strictly beyond this hull edge.
        pub located: bool,
        /// The point falls onto a corner.
        pub falls_onto_corner: bool,
        /// The point lies left of `v0 v1`.
        pub is_left: bool,
        /// The point lies on the line `v0 v1`.
        pub is_straight: bool,
        /// Where a walk goes on.
        pub walk_next: TriangleId,
    }

    /// A final edge of the boundary, from `a` to the next entry's `a`.
    pub struct Entry {
        /// Its first vertex.
        pub a: VertexId,
        /// The triangle outside.
        pub u: TriangleId,
        /// The slot of `u` that leads to `f`.
        pub slot: Slot,
        /// The cavity triangle behind the edge.
        pub f: TriangleId,
        /// The entry after this one.
        pub after: RingEntry,
    }

    /// A visit that completes in the next clock, and its record turned.
    pub struct Upcoming {
        /// There is one.
        pub done: bool,
        pub token: Token,
        pub turned: Turned,
    }

    /// A visit that completes.
    pub struct Completion {
        /// There is one.
        pub done: bool,
        pub token: Token,
        pub turned: Turned,
        pub verdict: Verdict,
    }

    /// Visits to make.
    pub struct Push {
        /// There are some.
        pub valid: bool,
        pub bundle: Bundle,
    }

    /// The visits that follow one that completes.
    pub struct Follow {
        /// There are some.
        pub asks: bool,
        /// There may be some, as far as is known soon. Whoever asks also may ask.
        pub may_ask: bool,
        pub bundle: Bundle,
    }

    /// What a visit that completes means for its context. At most one of `looks` to `root_duplicate` is high.
    pub struct Case {
        /// A visit completes.
        pub is_done: bool,
        /// Which kind of visit it is.
        pub is_walk: bool,
        pub is_root: bool,
        pub is_test: bool,
        /// The look at the first three points.
        pub looks: bool,
        /// The same visit is made again; because another context holds the lock.
        pub repeats: bool,
        pub waits: bool,
        /// The walk goes on; it has found the point's triangle.
        pub walks_on: bool,
        pub locates: bool,
        /// The root is locked and holds the point: its neighbours are tested.
        pub opens: bool,
        /// The root no longer holds the point.
        pub retries: bool,
        /// A test passes through its edge; its edge is final.
        pub splits: bool,
        pub settles: bool,
        /// A test would pass, and the list is full.
        pub overflows: bool,
        /// Another context holds the lock, of the root or of a tested triangle.
        pub gives_up_root: bool,
        pub gives_up: bool,
        /// The point falls onto a corner.
        pub walk_duplicate: bool,
        pub root_duplicate: bool,
        /// Visits follow: it repeats, walks on, locates, opens or splits; they may.
        pub asks: bool,
        pub may_ask: bool,
    }

    /// What a test makes of its attempt.
    pub struct Step {
        /// No visit of the attempt is out any more.
        pub is_over: bool,
        /// And it has not failed: the ring is finished.
        pub succeeds: bool,
        /// The cavity triangle behind the edge has no boundary edge left.
        pub finds_inner: bool,
        /// The second edge of the root is passed.
        pub passes_root: bool,
    }

    /// What becomes of the context whose visit completes.
    pub struct Outcome {
        pub owner: ContextId,
        /// None of its visits is out any more.
        pub sleeps: bool,
        /// It will try its point again.
        pub keeps: bool,
        /// A commit or a release of it is due.
        pub hands_over: bool,
        /// It wants the waiting token; meets a foreign lock with it; needs it no more.
        pub asks_to_wait: bool,
        pub waits: bool,
        pub stops_waiting: bool,
        /// Its list has overflowed.
        pub overflows: bool,
        /// Its point is one already.
        pub duplicate: bool,
        /// A root's visit says where a walk for the same point would start next.
        pub root_enable: bool,
        pub root: TriangleId,
    }

    /// A final edge of a boundary, for the list of its context.
    pub struct EntryWrite {
        pub valid: bool,
        pub owner: ContextId,
        pub place: RingEntry,
        pub entry: Entry,
    }

    /// An inner triangle, for the list of its context.
    pub struct InnerWrite {
        pub valid: bool,
        pub owner: ContextId,
        pub place: RingEntry,
        pub id: TriangleId,
    }

    /// A lock that was taken, for the log of its context.
    pub struct LockWrite {
        pub valid: bool,
        pub owner: ContextId,
        pub place: LockCount,
        pub id: TriangleId,
    }

    /// A ring is finished.
    pub struct CommitRequest {
        pub valid: bool,
        pub job: CommitJob,
    }

    /// Locks are due.
    pub struct ReleaseRequest {
        pub valid: bool,
        pub job: ReleaseJob,
    }

    /// The entry at the head of the ring reader.
    pub struct RingHead {
        pub valid: bool,
        pub entry: Entry,
        /// It ends its ring.
        pub is_last: bool,
        /// The same cavity triangle lies behind the entry before it, or behind the first of its ring.
        pub shares: bool,
    }

    /// A ring is written.
    pub struct Committed {
        pub valid: bool,
        pub job: CommitJob,
        /// A record of its star.
        pub hint: TriangleId,
    }

    /// A lock to clear.
    pub struct LockClear {
        pub valid: bool,
        pub id: TriangleId,
    }

    /// The last lock of a context is released.
    pub struct Released {
        pub valid: bool,
        pub owner: ContextId,
    }

    /// A context starts to walk.
    pub struct Start {
        pub valid: bool,
        pub owner: ContextId,
        /// The record at which it starts.
        pub u: TriangleId,
        /// It takes this new point.
        pub takes: bool,
        pub id: VertexId,
    }

    /// The coordinates of the point that a context has taken stand on the vertex memory's port.
    pub struct Fetched {
        pub valid: bool,
        pub owner: ContextId,
    }

    /// A context starts to insert its point alone.
    pub struct SoloStart {
        pub valid: bool,
        pub owner: ContextId,
        pub p: VertexId,
        /// The record at which its walk starts.
        pub u: TriangleId,
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
        pub keeping: ContextSet,
        /// A commit or a release is due.
        pub busy: ContextSet,
        /// There has been a point; a commit.
        pub began: ContextSet,
        pub hinted: ContextSet,
        /// Somebody holds the waiting token; who; it has waited for long: nobody else may try again.
        pub waiter_valid: bool,
        pub waiter: ContextId,
        pub is_urgent: bool,
        /// Somebody wants to be alone: nobody starts; who.
        pub solo_valid: bool,
        pub solo_owner: ContextId,
        /// No visit is out and no lock held; said a clock after it has come true.
        pub all_rest: bool,
    }

    /// What stays as the core was built.
    pub struct Limits {
        /// The infinite vertex.
        pub infinite: VertexId,
        /// Entries of a boundary list.
        pub ring: RingCount,
        /// The highest record id.
        pub last_id: TriangleId,
        /// Contexts that are built, a bit each.
        pub all: ContextSet,
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

    /// A record that a read-out wants.
    pub struct RecordRead {
        pub valid: bool,
        pub id: TriangleId,
    }

    /// The point that a context inserts from now on.
    pub struct Position {
        pub valid: bool,
        pub owner: ContextId,
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

    /// What visits do at an edge, for the counters.
    pub struct VisitEvents {
        /// A visit of a walk, of a root, a test; of an insertion alone, too.
        pub walk_visit: bool,
        pub root_visit: bool,
        pub test: bool,
        /// It is made again.
        pub revisit: bool,
        /// A list overflows.
        pub overflows: bool,
        /// A flip of an insertion alone is finished.
        pub flip: bool,
        /// An attempt is given up for a foreign lock; a root had changed.
        pub gives_up: bool,
        pub retries: bool,
        /// The waiting token is taken.
        pub takes_token: bool,
        /// A ring is finished; its cavity's triangles.
        pub cavity_ends: bool,
        pub cavity_triangles: RingCount,
    }

    /// What happens in the engine at an edge, for the counters.
    pub struct Events {
        pub visits: VisitEvents,
        /// The first triangle is finished: three points are inserted.
        pub seeds: bool,
        /// A commit is finished; when its point was taken.
        pub commit_ends: bool,
        pub since: Clocks,
        /// An insertion alone is finished; it finds a duplicate.
        pub solo_inserts: bool,
        pub solo_duplicate: bool,
        /// A duplicate is found.
        pub duplicate: bool,
        /// A visit is issued; a record or a link is written; a commit is at work; a lock is released.
        pub is_issuing: bool,
        pub is_writing: bool,
        pub is_committing: bool,
        pub is_releasing: bool,
    }

    /// A write into the triangle memory: a record, or one link.
    pub struct Write {
        /// There is a write.
        pub valid: bool,
        /// The record written.
        pub id: TriangleId,
        /// The vertex columns are written.
        pub vertices: bool,
        /// Link column 0 is written.
        pub link0: bool,
        /// Link column 1 is written.
        pub link1: bool,
        /// Link column 2 is written.
        pub link2: bool,
        /// Data of the columns.
        pub v0: VertexId,
        pub v1: VertexId,
        pub v2: VertexId,
        pub n0: TriangleId,
        pub n1: TriangleId,
        pub n2: TriangleId,
    }

    /// What of a [`Write`] is written into the memories, and where.
    pub struct WriteEnables {
        /// The vertex columns.
        pub vertices: bool,
        /// Link column 0.
        pub link0: bool,
        /// Link column 1.
        pub link1: bool,
        /// Link column 2.
        pub link2: bool,
        /// The record, for the vertex columns.
        pub vertices_id: TriangleId,
        /// The record, for the link columns.
        pub links_id: TriangleId,
    }
}
