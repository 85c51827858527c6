//! The registers of a context that the pipeline reads with each of its visits.

use crate::predicate::Point;

/// The points and the vertex of a context.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sight {
    /// The place to which the context walks.
    pub place: Point,
    /// The point that is inserted, or the new place of a vertex that moves.
    pub to: Point,
    /// The vertex that is changed.
    pub vertex: u32,
    /// Whether equal distances are decided by the numbers of the vertices, which is a defect.
    pub by_number: bool,
}
