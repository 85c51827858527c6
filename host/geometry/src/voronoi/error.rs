//! The reasons why there is no Voronoi diagram, or no clip.

use crate::point::Point;

/// The reasons why a mesh has no Voronoi diagram here, or a ring makes no clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A coordinate has more than 31 bits.
    #[error("point {index} is {point}, but coordinates end at 2147483647: use a coarser grid")]
    CoordinateOutOfRange {
        /// Index of the point, in the set or in the ring of the clip.
        index: usize,
        /// The point with this coordinate.
        point: Point,
    },
    /// A triangle, the hull or a duplicate of the mesh names a point that is not there.
    #[error("the mesh names point {index}, but has {points} points: triangulate these points")]
    NoSuchPoint {
        /// The index that was named.
        index: u32,
        /// Number of points.
        points: usize,
    },
    /// A triangle of the mesh has no area or is clockwise.
    #[error("triangle {triangle} of the mesh is not counter-clockwise: triangulate the points")]
    NotCounterClockwise {
        /// Place of the triangle in the list.
        triangle: usize,
    },
    /// The clip has fewer than three different corners, or no area.
    #[error("the clip has no area: give two opposite corners of a rectangle, or three corners that turn")]
    EmptyClip,
    /// The rings of the clip have another number of corners than were given.
    #[error(
        "the rings of the clip have {have} corners, but the clip has {corners}: give the number of corners of each ring"
    )]
    RingCounts {
        /// The corners of all rings together.
        have: usize,
        /// The corners of the clip.
        corners: usize,
    },
    /// A hole of the clip does not lie inside the outer ring, or lies inside another hole.
    #[error(
        "hole {hole} of the clip, counted from 0, lies outside its outer ring or inside another hole: give holes that \
         lie side by side within the outer ring"
    )]
    MisplacedHole {
        /// Number of the hole, counted from 0.
        hole: usize,
    },
    /// The border of the clip crosses or touches itself.
    #[error(
        "the border of the clip crosses or touches itself: edges {one} and {other} have a common place; give a ring in \
         which only consecutive edges meet"
    )]
    CrossedClip {
        /// Number of an edge, counted from 0: it begins at the corner of this number. Holes are counted on.
        one: usize,
        /// Number of the other edge, which is higher.
        other: usize,
    },
}
