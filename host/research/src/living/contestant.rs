//! The interface of the triangulations that are compared.

use crate::orders::Failure;

/// Stands in an answer for a vertex that is not there: a place outside the hull has three of these, one in an edge has
/// one.
pub(super) const NO_VERTEX: u32 = u32::MAX;

/// Commands that are carried out one after the other and timed together.
#[derive(Clone, Copy, Debug)]
pub(super) enum Block<'a> {
    Locate(&'a [[f64; 2]]),
    Nearest(&'a [[f64; 2]]),
    /// The points get the next numbers.
    Insert(&'a [[f64; 2]]),
    /// The numbers of points.
    Delete(&'a [u32]),
}

impl Block<'_> {
    /// The number of commands.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Locate(places) | Self::Nearest(places) | Self::Insert(places) => places.len(),
            Self::Delete(numbers) => numbers.len(),
        }
    }
}

/// The time of a block, and its answers.
#[derive(Clone, Debug, Default)]
pub(super) struct Run {
    /// Seconds of the commands. Bringing the answers into the common form is not counted.
    pub(super) seconds: f64,
    /// Three numbers of points for each place that was located, the smallest first and then counter-clockwise; one for
    /// each nearest point; none for a change.
    pub(super) answers: Vec<u32>,
}

/// A triangulation that takes part. Its points have the numbers 0, 1, 2 and so on.
pub(super) trait Contestant {
    fn name(&self) -> &'static str;

    /// Inserts the first points. `order` has their numbers along a Hilbert curve.
    fn load(&mut self, points: &[[f64; 2]], order: &[u32]) -> Result<(), Failure>;

    fn run(&mut self, block: Block) -> Result<Run, Failure>;

    /// All triangles, each with its smallest number first and then counter-clockwise, sorted.
    fn triangles(&mut self) -> Result<Vec<[u32; 3]>, Failure>;
}

/// Turns a triangle so that its smallest number comes first.
pub(super) fn smallest_first(mut triangle: [u32; 3]) -> [u32; 3] {
    let smallest = (0..3).min_by_key(|&corner| triangle[corner]).unwrap_or(0);
    triangle.rotate_left(smallest);
    triangle
}
