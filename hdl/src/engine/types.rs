//! What travels between the blocks of the engine.
//!
//! Widths are those of the largest core: ids of 15 bits, ring entries of 6. Memories of smaller configurations store fewer bits
//! and return zeros above them, so synthesis removes the rest.

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
        pub id: Bits<VERTEX_BITS>,
        /// It is the third of the context's own first triangle, in a batch.
        pub is_seed: bool,
    }

    /// How points are dealt to contexts.
    pub struct Deal {
        /// Contexts that work.
        pub contexts: Bits<5>,
        /// Each of them has a mesh of its own.
        pub is_batch: bool,
        /// The first vertex of those that are dealt in turn: 16, or three for each context in a batch.
        pub dealt_from: Bits<7>,
    }

    /// One visit of a record.
    pub struct Token {
        /// The context it belongs to.
        pub owner: Bits<5>,
        /// The record is turned so that its link to `f` comes first.
        pub rotates: bool,
        /// The record's lock is taken.
        pub locks: bool,
        /// Ring entry whose edge is tested.
        pub x: Bits<6>,
        /// The entry after it.
        pub after: Bits<6>,
        /// The entry that was allocated when `f` joined the cavity; 0 for the root.
        pub f_entry: Bits<6>,
        /// The cavity triangle behind the edge.
        pub f: Bits<15>,
        /// The record visited.
        pub u: Bits<15>,
    }

    /// One to three visits that one completion asks for. The second visit has `x = after` of the first and the third `x =
    /// second_after` and `after = 0`; all other fields are those of the first.
    pub struct Bundle {
        /// There is a second visit.
        pub is_pair: bool,
        /// There are a second and a third visit; `is_pair` is set too.
        pub is_triple: bool,
        /// See [`Token`].
        pub owner: Bits<5>,
        /// See [`Token`].
        pub rotates: bool,
        /// See [`Token`].
        pub locks: bool,
        /// See [`Token`].
        pub x: Bits<6>,
        /// See [`Token`].
        pub after: Bits<6>,
        /// See [`Token`].
        pub f_entry: Bits<6>,
        /// See [`Token`].
        pub f: Bits<15>,
        /// See [`Token`].
        pub u: Bits<15>,
        /// `after` of the second visit.
        pub second_after: Bits<6>,
        /// `u` of the second visit.
        pub second_u: Bits<15>,
        /// `u` of the third visit.
        pub third_u: Bits<15>,
    }

    /// A record that has been read and turned.
    pub struct Turned {
        /// Vertices, counter-clockwise.
        pub v0: Bits<15>,
        /// See `v0`.
        pub v1: Bits<15>,
        /// See `v0`.
        pub v2: Bits<15>,
        /// Links; `n0` is opposite `v0`.
        pub n0: Bits<15>,
        /// See `n0`.
        pub n1: Bits<15>,
        /// See `n0`.
        pub n2: Bits<15>,
        /// The stored slot that now comes first.
        pub slot: Bits<2>,
        /// The visit took the record's lock.
        pub took: bool,
        /// It would have, but another context holds it, or it was being cleared.
        pub foreign: bool,
        /// The record was not written yet, or being written: a walk must look again.
        pub again: bool,
        /// `v0` is the infinite vertex.
        pub infinite0: bool,
        /// `v1` is.
        pub infinite1: bool,
        /// `v2` is.
        pub infinite2: bool,
    }

    /// The state of a context's cavity, from the visit that locks its root. `half_open` comes last: a memory keeps as many of its
    /// bits as a ring has entries.
    pub struct Attempt {
        /// It has failed: its visits run out.
        pub drains: bool,
        /// Visits pushed and not completed.
        pub outstanding: Bits<7>,
        /// Ring entries.
        pub count: Bits<7>,
        /// Cavity triangles without a boundary edge.
        pub inners: Bits<7>,
        /// Locks in the log.
        pub logged: Bits<7>,
        /// Bit `y`: one of the two edges that entry `y`'s cavity triangle brought has been passed. The root brought three and uses
        /// bits 0 and 1.
        pub half_open: Bits<64>,
    }

    /// A finished ring, to be committed.
    pub struct CommitJob {
        /// Its context.
        pub owner: Bits<5>,
        /// The new vertex.
        pub p: Bits<15>,
        /// Inner triangles.
        pub inners: Bits<7>,
        /// Locks in the log.
        pub locks: Bits<7>,
        /// When the point was taken.
        pub since: Bits<22>,
    }

    /// The locks of an attempt, to be released.
    pub struct ReleaseJob {
        /// Its context.
        pub owner: Bits<5>,
        /// Locks in the log, at least one.
        pub locks: Bits<7>,
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
        pub walk_next: Bits<15>,
    }

    /// A final edge of the boundary, from `a` to the next entry's `a`.
    pub struct Entry {
        /// Its first vertex.
        pub a: Bits<15>,
        /// The triangle outside.
        pub u: Bits<15>,
        /// The slot of `u` that leads to `f`.
        pub slot: Bits<2>,
        /// The cavity triangle behind the edge.
        pub f: Bits<15>,
        /// The entry after this one.
        pub after: Bits<6>,
    }

    /// What happens in the engine at an edge, for the counters.
    pub struct Events {
        /// The first triangle is finished.
        pub seeds: bool,
        /// A commit is finished.
        pub commit_ends: bool,
        /// When its point was taken.
        pub since: Bits<22>,
        /// An insertion alone is finished.
        pub solo_inserts: bool,
        /// An insertion alone finds a duplicate.
        pub solo_duplicate: bool,
        /// It makes a test.
        pub solo_test: bool,
        /// It makes a flip.
        pub flip: bool,
        /// A duplicate is found.
        pub duplicate: bool,
        /// A visit of a walk.
        pub walk_visit: bool,
        /// The visit of a root.
        pub root_visit: bool,
        /// A test.
        pub test: bool,
        /// A visit is made again.
        pub revisit: bool,
        /// A list overflows.
        pub overflow: bool,
        /// An attempt is given up for a foreign lock.
        pub gives_up: bool,
        /// A root had changed.
        pub root_retry: bool,
        /// The waiting token is taken.
        pub takes_token: bool,
        /// A ring is finished.
        pub cavity_ends: bool,
        /// Its cavity's triangles.
        pub cavity_triangles: Bits<7>,
        /// A visit is issued.
        pub is_issuing: bool,
        /// A record or a link is written.
        pub is_writing: bool,
        /// A commit is at work.
        pub is_committing: bool,
        /// A lock is released.
        pub is_releasing: bool,
    }

    /// A write into the triangle memory: a record, or one link.
    pub struct Write {
        /// There is a write.
        pub valid: bool,
        /// The record written.
        pub id: Bits<15>,
        /// The vertex columns are written.
        pub vertices: bool,
        /// Link column 0 is written.
        pub link0: bool,
        /// Link column 1 is written.
        pub link1: bool,
        /// Link column 2 is written.
        pub link2: bool,
        /// Data of the columns.
        pub v0: Bits<15>,
        /// See `v0`.
        pub v1: Bits<15>,
        /// See `v0`.
        pub v2: Bits<15>,
        /// See `v0`.
        pub n0: Bits<15>,
        /// See `v0`.
        pub n1: Bits<15>,
        /// See `v0`.
        pub n2: Bits<15>,
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
        pub vertices_id: Bits<15>,
        /// The record, for the link columns.
        pub links_id: Bits<15>,
    }
}
