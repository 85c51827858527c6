//! The state of a star: the two chains of visits that go round the deleted vertex, one each way from the root, and what
//! the records outside have shown.
//!
//! Hardware twin: the block `StarStore`.

/// Number of places of visits.
pub(super) const PLACES: usize = 64;

#[derive(Clone, Copy, Debug, Default)]
pub(in super::super) struct Star {
    /// The record of each chain that is being visited, or was visited last: to the right and to the left.
    pub(super) heads: [u32; 2],
    /// The last place of each chain, as a place of the list.
    pub first: usize,
    pub last: usize,
    /// The place of the infinite vertex in the ring.
    pub infinite: Option<usize>,
    /// Whether some record outside is a triangle and no ghost triangle.
    pub has_triangle_outside: bool,
    pub(super) is_too_long: bool,
    /// In a move: the vertex opposite the last record of each chain, and whether all edges stay that have been looked
    /// at.
    pub carried: [u32; 2],
    pub(super) keeps: bool,
}
