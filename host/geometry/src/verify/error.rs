//! What the validator can find wrong.

use crate::point::Point;

/// The first thing wrong with a mesh. Triangles are numbered by their place in the list, points by input index.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// A coordinate is too large for exact arithmetic in 128 bits.
    #[error("point {index} is {point}, but the validator takes coordinates below 2147483648")]
    CoordinateTooLarge {
        /// Input index.
        index: usize,
        /// The point.
        point: Point,
    },
    /// More points or triangles than 32-bit half-edge numbers allow.
    #[error("{count} points or triangles are more than the validator's {max}")]
    TooLarge {
        /// Points or triangles given.
        count: usize,
        /// Points or triangles possible.
        max: usize,
    },
    /// A triangle names a point that does not exist.
    #[error("triangle {triangle} names point {index}, but there are only {points} points")]
    IndexOutOfRange {
        /// Number of the triangle.
        triangle: usize,
        /// The index it names.
        index: u32,
        /// Points given.
        points: usize,
    },
    /// A triangle has no area or turns clockwise.
    #[error("triangle {triangle} ({} {} {}) is not counter-clockwise", corners[0], corners[1], corners[2])]
    NotCounterClockwise {
        /// Number of the triangle.
        triangle: usize,
        /// The corners of the triangle.
        corners: [u32; 3],
    },
    /// A triangle does not start with its smallest index.
    #[error("triangle {triangle} ({} {} {}) does not start with its smallest index", corners[0], corners[1], corners[2])]
    NotRotated {
        /// Number of the triangle.
        triangle: usize,
        /// The corners of the triangle.
        corners: [u32; 3],
    },
    /// A triangle is smaller than the one before it.
    #[error("triangle {triangle} ({} {} {}) is out of order", corners[0], corners[1], corners[2])]
    NotSorted {
        /// Number of the triangle.
        triangle: usize,
        /// The corners of the triangle.
        corners: [u32; 3],
    },
    /// A triangle is there twice.
    #[error("triangle {triangle} ({} {} {}) is there twice", corners[0], corners[1], corners[2])]
    DoubledTriangle {
        /// Number of the second one.
        triangle: usize,
        /// The corners of the triangle.
        corners: [u32; 3],
    },
    /// A triangle uses a duplicate under an index that is not its lowest.
    #[error("triangle {triangle} names point {index}, a duplicate of point {of}")]
    NotLowestIndex {
        /// Number of the triangle.
        triangle: usize,
        /// The index it names.
        index: u32,
        /// The lowest index of the same coordinates.
        of: u32,
    },
    /// A distinct point is in no triangle.
    #[error("point {index} is in no triangle")]
    UnusedPoint {
        /// Input index.
        index: u32,
    },
    /// All points are on one line, but there are triangles.
    #[error("{triangles} triangles are given, but all points are on one line")]
    TrianglesOfCollinearPoints {
        /// Triangles given.
        triangles: usize,
    },
    /// The number of triangles is not the one Euler's formula gives.
    #[error("{found} triangles are given, but {distinct} points with {hull} on the hull have {expected}")]
    TriangleCount {
        /// Triangles given.
        found: usize,
        /// 2 · distinct - 2 - hull.
        expected: usize,
        /// Distinct points.
        distinct: usize,
        /// Points on the hull.
        hull: usize,
    },
    /// Two triangles lie on the same side of an edge.
    #[error("triangles {one} and {other} lie on the same side of the edge from point {} to point {}", edge[0], edge[1])]
    SameSide {
        /// A triangle.
        one: usize,
        /// Another.
        other: usize,
        /// The directed edge both have.
        edge: [u32; 2],
    },
    /// An edge with one triangle is not on the hull.
    #[error("the edge from point {} to point {} of triangle {triangle} has no other triangle and is not on the hull", edge[0], edge[1])]
    OpenEdge {
        /// The triangle.
        triangle: usize,
        /// The edge.
        edge: [u32; 2],
    },
    /// A hull edge has no triangle.
    #[error("the hull edge from point {} to point {} has no triangle", edge[0], edge[1])]
    MissingHullEdge {
        /// The edge.
        edge: [u32; 2],
    },
    /// The triangles do not fill the hull.
    #[error("the triangles cover {triangles} half grid squares, the hull {hull}")]
    Area {
        /// Twice the area of all triangles.
        triangles: i128,
        /// Twice the area of the hull.
        hull: i128,
    },
    /// A point lies inside the circumcircle of a neighbouring triangle.
    #[error("point {point} lies inside the circle of triangle {triangle}, so the edge from point {} to point {} is not Delaunay", edge[0], edge[1])]
    NotDelaunay {
        /// Number of the triangle.
        triangle: usize,
        /// The point inside its circle.
        point: u32,
        /// The edge between them.
        edge: [u32; 2],
    },
    /// Four cocircular points, and the diagonal is not the one of the tie rule.
    #[error(
        "the points {}, {}, {}, {} lie on one circle, and the edge from point {} to point {} breaks the tie rule: \
         the diagonal of point {smallest} is due", corners[0], corners[1], corners[2], corners[3], edge[0], edge[1]
    )]
    WrongTie {
        /// The four points.
        corners: [u32; 4],
        /// The edge that is there.
        edge: [u32; 2],
        /// The lexicographically smallest of the four.
        smallest: u32,
    },
    /// The hull list is not the hull of the points.
    #[error("the hull list differs from the hull of the points at place {place}: {found:?} instead of {expected:?}")]
    Hull {
        /// First place that differs.
        place: usize,
        /// Index found; `None` past the end of the list.
        found: Option<u32>,
        /// Index expected; `None` past its end.
        expected: Option<u32>,
    },
    /// The list of duplicates is not that of the points.
    #[error("the list of duplicates differs from that of the points at place {place}")]
    Duplicates {
        /// First place that differs.
        place: usize,
    },
}
