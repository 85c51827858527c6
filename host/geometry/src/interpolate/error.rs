//! The reasons why there is no surface.

/// The reasons why a [`Surface`](super::Surface) cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// There is no triangle.
    #[error("there is no triangle between the points: give three or more that do not lie on one line")]
    NoTriangle,
    /// The numbers of points and of values differ.
    #[error("{points} points have {values} values: give one value for each point")]
    Values {
        /// Number of points.
        points: usize,
        /// Number of values.
        values: usize,
    },
    /// A triangle names a point that is not there.
    #[error("a triangle names point {index}, but there are {points} points: triangulate these points")]
    NoSuchPoint {
        /// The index that was named.
        index: u32,
        /// Number of points.
        points: usize,
    },
    /// A coordinate is infinite or not a number, or a triangle is not counter-clockwise.
    #[error("triangle {triangle} is not counter-clockwise or not finite: triangulate the points")]
    NotCounterClockwise {
        /// Place of the triangle in the list.
        triangle: usize,
    },
}
