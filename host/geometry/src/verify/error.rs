//! The defects that the validator finds.

use crate::plan::Mark;

/// The first defect that [`verify`](fn@crate::verify) found in a mesh.
///
/// Triangles are numbered by their place in the list, points by their input index. The message names both.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// A coordinate is infinite or not a number.
    #[error("point {index} has a coordinate that is infinite or not a number")]
    NotFinite {
        /// Input index of the point.
        index: usize,
    },
    /// There are more points or triangles than 32-bit half-edge numbers allow.
    #[error("{count} points or triangles are more than the validator's {max}")]
    TooLarge {
        /// Number of points or triangles given, whichever is larger.
        count: usize,
        /// Number of points or triangles that are possible.
        max: usize,
    },
    /// A triangle names a point that does not exist.
    #[error("triangle {triangle} names point {index}, but there are only {points} points")]
    IndexOutOfRange {
        /// Number of the triangle in the list.
        triangle: usize,
        /// The index that the triangle names.
        index: u32,
        /// Number of points given.
        points: usize,
    },
    /// A triangle has no area or turns clockwise.
    #[error("triangle {triangle} ({} {} {}) is not counter-clockwise", corners[0], corners[1], corners[2])]
    NotCounterClockwise {
        /// Number of the triangle in the list.
        triangle: usize,
        /// The corners of the triangle.
        corners: [u32; 3],
    },
    /// A triangle does not start with its smallest index.
    #[error(
        "triangle {triangle} ({} {} {}) does not start with its smallest index", corners[0], corners[1], corners[2]
    )]
    NotRotated {
        /// Number of the triangle in the list.
        triangle: usize,
        /// The corners of the triangle.
        corners: [u32; 3],
    },
    /// A triangle sorts before the previous one of the list.
    #[error("triangle {triangle} ({} {} {}) is out of order", corners[0], corners[1], corners[2])]
    NotSorted {
        /// Number of the triangle in the list.
        triangle: usize,
        /// The corners of the triangle.
        corners: [u32; 3],
    },
    /// The list has a triangle twice.
    #[error("triangle {triangle} ({} {} {}) is there twice", corners[0], corners[1], corners[2])]
    DoubledTriangle {
        /// Number of the second copy.
        triangle: usize,
        /// The corners of the triangle.
        corners: [u32; 3],
    },
    /// A triangle names a duplicate instead of the lowest index of its coordinates.
    #[error("triangle {triangle} names point {index}, a duplicate of point {of}")]
    NotLowestIndex {
        /// Number of the triangle in the list.
        triangle: usize,
        /// The index that the triangle names.
        index: u32,
        /// The lowest index with the same coordinates.
        of: u32,
    },
    /// A distinct point is in no triangle.
    #[error("point {index} is in no triangle")]
    UnusedPoint {
        /// Input index of the point.
        index: u32,
    },
    /// There are triangles, although all points are on one line.
    #[error("the number of triangles is {triangles}, but all points are on one line")]
    TrianglesOfCollinearPoints {
        /// Number of triangles given.
        triangles: usize,
    },
    /// The number of triangles is not the one of Euler's formula.
    #[error("the number of triangles is {found}, but {distinct} points with {hull} on the hull have {expected}")]
    TriangleCount {
        /// Number of triangles given.
        found: usize,
        /// Number of triangles by the formula, 2 · distinct - 2 - hull.
        expected: usize,
        /// Number of distinct points.
        distinct: usize,
        /// Number of points on the hull.
        hull: usize,
    },
    /// Two triangles lie on the same side of an edge.
    #[error("triangles {one} and {other} lie on the same side of the edge from point {} to point {}", edge[0], edge[1])]
    SameSide {
        /// Number of the first triangle.
        one: usize,
        /// Number of the second triangle.
        other: usize,
        /// The directed edge that both have.
        edge: [u32; 2],
    },
    /// An edge has only one triangle, but is not on the hull.
    #[error(
        "the edge from point {} to point {} of triangle {triangle} has no other triangle and is not on the hull",
        edge[0], edge[1]
    )]
    OpenEdge {
        /// Number of the only triangle.
        triangle: usize,
        /// The edge by its two points.
        edge: [u32; 2],
    },
    /// An edge of the hull has no triangle.
    #[error("the hull edge from point {} to point {} has no triangle", edge[0], edge[1])]
    MissingHullEdge {
        /// The edge by its two points.
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
    #[error(
        "point {point} lies inside the circle of triangle {triangle}, so the edge from point {} to point {} is not \
         Delaunay", edge[0], edge[1]
    )]
    NotDelaunay {
        /// Number of the triangle in the list.
        triangle: usize,
        /// The point inside the circle of that triangle.
        point: u32,
        /// The edge between the triangle and the point.
        edge: [u32; 2],
    },
    /// Four points lie on one circle, and the edge between them is not the diagonal of the tie rule.
    #[error(
        "the points {}, {}, {}, {} lie on one circle, and the edge from point {} to point {} breaks the tie rule: \
         the diagonal of point {smallest} is due", corners[0], corners[1], corners[2], corners[3], edge[0], edge[1]
    )]
    WrongTie {
        /// The four points on the circle.
        corners: [u32; 4],
        /// The edge of the mesh.
        edge: [u32; 2],
        /// The lexicographically smallest of the four points.
        smallest: u32,
    },
    /// A constraint names a point that does not exist.
    #[error("constraint {constraint} names point {index}, but there are only {points} points")]
    ConstraintOutOfRange {
        /// Number of the constraint in the list.
        constraint: usize,
        /// The index that the constraint names.
        index: u32,
        /// Number of points given.
        points: usize,
    },
    /// The constraints have more different pieces than edges that do not cross can have.
    #[error(
        "constraints up to number {constraint} have more pieces than any mesh of the points has edges, so some of them \
         cross: no mesh has all of them"
    )]
    ConstraintsCross {
        /// Number of the constraint in the list by which this was noticed.
        constraint: usize,
    },
    /// The boundary of the domain has an end, so that no mesh is right.
    #[error(
        "the boundary of the domain is not closed: the number of its constraints that begin or end at point {point} \
         is odd ({count})"
    )]
    Open {
        /// Input index of the point.
        point: u32,
        /// Number of constraints of the boundary that begin or end there.
        count: usize,
    },
    /// The constraints around the domain do not form rings that run one way, so that no mesh is right.
    #[error(
        "the boundary of the domain is not made of rings: {begin} of its constraints begin at point {point}, and \
         {end} end there"
    )]
    Unbalanced {
        /// Input index of the point.
        point: u32,
        /// Number of constraints of the boundary that begin there.
        begin: usize,
        /// Number of constraints of the boundary that end there.
        end: usize,
    },
    /// No triangle belongs to the domain, so that there is no mesh to check.
    #[error("the domain is empty: none of the {triangles} triangles belongs to it")]
    EmptyDomain {
        /// Number of triangles of the hull.
        triangles: usize,
    },
    /// The place of a hole is outside the hull of the points.
    #[error("{kind} {number}, counted from 0, lies outside the hull of the points")]
    MarkOutside {
        /// Whether the place is that of a hole or of a region.
        kind: Mark,
        /// Number of the hole in the list.
        number: usize,
    },
    /// The place of a hole is on a constraint.
    #[error(
        "{kind} {number}, counted from 0, lies on the constraint from point {} to point {}", edge[0], edge[1]
    )]
    MarkOnConstraint {
        /// Whether the place is that of a hole or of a region.
        kind: Mark,
        /// Number of the hole in the list.
        number: usize,
        /// The ends of the piece of the constraint.
        edge: [u32; 2],
    },
    /// The place of a hole has a coordinate that is infinite or not a number.
    #[error("{kind} {number}, counted from 0, has a coordinate that is infinite or not a number")]
    MarkNotFinite {
        /// Whether the place is that of a hole or of a region.
        kind: Mark,
        /// Number of the hole in the list.
        number: usize,
    },
    /// A piece of a constraint is no edge of the mesh.
    #[error("the piece of a constraint from point {} to point {} is no edge of a triangle", edge[0], edge[1])]
    MissingPiece {
        /// The piece by its two points.
        edge: [u32; 2],
    },
    /// A piece of a constraint has triangles on the wrong sides.
    #[error(
        "the piece of a constraint from point {} to point {} has {found} triangles, but the domain lies on {due} of \
         its sides, or on the other one", edge[0], edge[1]
    )]
    SidesOfPiece {
        /// The piece by its two points.
        edge: [u32; 2],
        /// Number of triangles at the piece.
        found: u8,
        /// Number of sides of the piece that belong to the domain.
        due: u8,
    },
    /// A triangle holds a point that is a corner of none.
    #[error("triangle {triangle} holds point {point}, which is a corner of no triangle")]
    PointInTriangle {
        /// Number of the triangle in the list.
        triangle: usize,
        /// Input index of the point.
        point: u32,
    },
    /// The hull list is not the hull of the points.
    #[error("the hull list differs from the hull of the points at place {place}: {found:?} instead of {expected:?}")]
    Hull {
        /// The first place at which the lists differ.
        place: usize,
        /// The index found; `None` past the end of the list.
        found: Option<u32>,
        /// The index expected; `None` past the end of the hull.
        expected: Option<u32>,
    },
    /// The list of duplicates is not that of the points.
    #[error("the list of duplicates differs from that of the points at place {place}")]
    Duplicates {
        /// The first place at which the lists differ.
        place: usize,
    },
}
