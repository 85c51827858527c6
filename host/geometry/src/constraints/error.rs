//! The reasons why constraints cannot be forced into a mesh.

use super::crossing::Place;
use crate::plan::Mark;

/// Why constraints and a domain have no mesh. Constraints, points, holes and regions are counted from 0.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A coordinate is infinite or not a number.
    #[error("point {index} has a coordinate that is infinite or not a number")]
    NotFinite {
        /// Index of the point.
        index: usize,
    },
    /// The place of a hole or region has a coordinate that is infinite or not a number.
    #[error("{kind} {number}, counted from 0, has a coordinate that is infinite or not a number")]
    MarkNotFinite {
        /// Whether the place is that of a hole or of a region.
        kind: Mark,
        /// Number of the hole or region.
        number: usize,
    },
    /// There are more constraints than numbers of 32 bits can count.
    #[error("the number of constraints is {count}, but at most {max} are possible")]
    TooManyConstraints {
        /// Number of constraints given.
        count: usize,
        /// Number of constraints that are possible.
        max: usize,
    },
    /// Constraints overlap so much that the list of the constraints of all pieces is too long.
    #[error("constraints overlap too much: their pieces would name more than {max} constraints")]
    TooManyPieces {
        /// Entries that the list may have.
        max: usize,
    },
    /// A constraint names a point that does not exist.
    #[error("constraint {constraint} names point {index}, but the number of points is {points}")]
    OutOfRange {
        /// Number of the constraint.
        constraint: u32,
        /// The index that the constraint names.
        index: u32,
        /// Number of points.
        points: usize,
    },
    /// Two constraints cross at a place that is not a point of the set.
    #[error(
        "constraint {} (from point {} to point {}) crosses constraint {} (from point {} to point {}) at {place}: \
         make the crossing a point", constraints[1], ends[1][0], ends[1][1], constraints[0], ends[0][0], ends[0][1]
    )]
    Crossing {
        /// The numbers of both constraints, the smaller first.
        constraints: [u32; 2],
        /// The indices of the ends of both.
        ends: [[u32; 2]; 2],
        /// The crossing itself.
        place: Place,
    },
    /// The boundary of a domain has an end.
    #[error(
        "the boundary of the domain is not closed: the number of its constraints that begin or end at point {point} \
         is odd ({count})"
    )]
    Open {
        /// Index of the point.
        point: u32,
        /// Number of constraints of the boundary that begin or end there.
        count: usize,
    },
    /// The constraints around a domain do not form rings that run one way.
    #[error(
        "the boundary of the domain is not made of rings: {begin} of its constraints begin at point {point}, and \
         {end} end there"
    )]
    Unbalanced {
        /// Index of the point.
        point: u32,
        /// Number of constraints of the boundary that begin there.
        begin: usize,
        /// Number of constraints of the boundary that end there.
        end: usize,
    },
    /// A hole or a region is given by a place outside the hull of the points.
    #[error("{kind} {number}, counted from 0, lies outside the hull of the points")]
    Outside {
        /// Whether the place is that of a hole or of a region.
        kind: Mark,
        /// Number of the hole or region.
        number: usize,
    },
    /// A hole or a region is given by a place on a constraint, so that it is on no side of it.
    #[error(
        "{kind} {number}, counted from 0, lies on the constraint from point {} to point {}", edge[0], edge[1]
    )]
    OnConstraint {
        /// Whether the place is that of a hole or of a region.
        kind: Mark,
        /// Number of the hole or region.
        number: usize,
        /// The ends of the piece of the constraint.
        edge: [u32; 2],
    },
    /// The place of a region lies in a part of the hull that does not belong to the domain.
    #[error("region {number}, counted from 0, lies in a part of the hull that does not belong to the domain")]
    RegionOutsideDomain {
        /// Number of the region.
        number: usize,
    },
    /// No triangle belongs to the domain.
    #[error("the domain is empty: none of the {triangles} triangles belongs to it")]
    Empty {
        /// Number of triangles of the hull.
        triangles: usize,
    },
    /// The triangles that the constraints were to be forced into are not the canonical mesh of the points.
    #[error("the triangles are not the mesh of these points: triangulate the points, and force constraints into that")]
    NoMesh,
}
