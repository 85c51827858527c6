//! The reasons why a change is refused.

use crate::constraints::crossing::Place;
use crate::point::MAX_POINTS;

/// The reasons why a [`Triangulation`](super::Triangulation) refuses a change. The triangulation stays as it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A coordinate is infinite or not a number.
    #[error("a coordinate of the point is infinite or not a number: give finite coordinates")]
    NotFinite,
    /// A coordinate in a list of points is infinite or not a number.
    #[error("point {position} of the list has a coordinate that is infinite or not a number: give finite ones")]
    NotFiniteAt {
        /// The position of the point in the list.
        position: usize,
    },
    /// The point of this index was deleted.
    #[error("point {index} was deleted: its index is never used again")]
    Deleted {
        /// The index that was given.
        index: u32,
    },
    /// No point has had this index yet.
    #[error("there is no point {index}: so far the indices are those below {next}")]
    Unknown {
        /// The index that was given.
        index: u32,
        /// The index that the next point will have.
        next: u32,
    },
    /// There are as many points as indices allow.
    #[error("there are {MAX_POINTS} points, the most that indices allow: delete some, or use several triangulations")]
    TooManyPoints,
    /// All indices have been used.
    #[error("all 4294967295 indices have been used: call `renumber`, which gives the points new ones from 0 on")]
    IndicesUsedUp,
    /// A list of new places does not have one for each living point.
    #[error("there are {given} new places for {living} living points: give one for each, in the order of the indices")]
    WrongCount {
        /// The number of places given.
        given: usize,
        /// The number of living points.
        living: usize,
    },
    /// Two constraints would cross at a place that is no point.
    #[error(
        "constraint {} (from point {} to point {}) would cross constraint {} (from point {} to point {}) at {place}: \
         make the crossing a point, or remove one of the two", constraints[1], ends[1][0], ends[1][1], constraints[0],
        ends[0][0], ends[0][1]
    )]
    Crossing {
        /// The numbers of both constraints, the smaller first.
        constraints: [u32; 2],
        /// The indices of the ends of both.
        ends: [[u32; 2]; 2],
        /// The crossing itself.
        place: Place,
    },
    /// A point that is an end of a constraint was to be deleted.
    #[error("point {index} is an end of constraint {constraint}: remove that constraint before the point")]
    EndOfConstraint {
        /// The index that was given.
        index: u32,
        /// The smallest number of a constraint that ends there.
        constraint: u32,
    },
    /// There is no constraint of this number.
    #[error("there is no constraint {constraint}: it was removed, or its number is not below {next}")]
    UnknownConstraint {
        /// The number that was given.
        constraint: u32,
        /// The number that the next constraint will have.
        next: u32,
    },
    /// All numbers of constraints have been used.
    #[error("all 4294967295 numbers of constraints have been used: make a new triangulation of the living points")]
    ConstraintsUsedUp,
}
