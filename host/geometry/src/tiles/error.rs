//! The errors of tiles.

use crate::cpu;

/// The reasons why a tile or a join has no result.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A tile was given a point that lies beyond its region.
    #[error("point {place} of the tile lies beyond the region: give it to the tile whose region contains it")]
    Beyond {
        /// Place of the point in the list of the tile.
        place: usize,
    },
    /// The numbers of points and of their ids differ.
    #[error("{points} points have {ids} ids: give one id for each point")]
    Ids {
        /// Number of points given.
        points: usize,
        /// Number of ids given.
        ids: usize,
    },
    /// A triangle or a hull names a point that is not there.
    #[error("there is no point {place} among the {points} points of the mesh: triangulate these points")]
    NoSuchPoint {
        /// The place that was named.
        place: u32,
        /// Number of points.
        points: usize,
    },
    /// The region of a child has places beyond the region of the join.
    #[error("the region of child {child} is not covered by the region of the join: give a larger region")]
    NotCovered {
        /// Place of the child in the list.
        child: usize,
    },
    /// The open triangles of a border are not in canonical order.
    #[error(
        "open triangle {place} of a border is not in canonical order: give the border that `local` or `join` gave"
    )]
    NotCanonical {
        /// Place of the triangle in the list.
        place: usize,
    },
    /// The regions of two children overlap.
    #[error("the regions of children {one} and {other} overlap: a place belongs to one region alone")]
    Overlap {
        /// Place of a child in the list.
        one: usize,
        /// Place of the other child.
        other: usize,
    },
    /// The CPU triangulator refused the points.
    #[error(transparent)]
    Triangulation(#[from] cpu::Error),
}
