//! What travels between the blocks of the engine.
//!
//! Widths are those of the largest core: ids of 15 bits, ring entries of 6. Memories of smaller configurations store fewer bits
//! and return zeros above them, so synthesis removes the rest.

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

/// Bits of [`Token`].
pub const TOKEN_BITS: usize = Token::BITS;
/// Bits of [`Bundle`].
pub const BUNDLE_BITS: usize = Bundle::BITS;
/// Bits of [`Turned`].
pub const TURNED_BITS: usize = Turned::BITS;
/// Bits of [`Entry`].
pub const ENTRY_WORD_BITS: usize = Entry::BITS;

crate::packed! {
    /// One visit of a record.
    pub struct Token {
        /// The record is turned so that its link to `f` comes first.
        pub rotates: bool,
        /// The record's lock bit is set.
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

    /// One or two visits that one completion asks for; the second differs from the first in three fields.
    pub struct Bundle {
        /// There is a second visit.
        pub is_pair: bool,
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
        /// `x` of the second visit.
        pub second_x: Bits<6>,
        /// `after` of the second visit.
        pub second_after: Bits<6>,
        /// `u` of the second visit.
        pub second_u: Bits<15>,
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
        /// The lock bit before the visit.
        pub was_set: bool,
        /// `v0` is the infinite vertex.
        pub infinite0: bool,
        /// `v1` is.
        pub infinite1: bool,
        /// `v2` is.
        pub infinite2: bool,
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
}
