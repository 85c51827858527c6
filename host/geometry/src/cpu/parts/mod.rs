//! Divide and conquer with parts that somebody else triangulates: a device, another process, another machine.
//!
//! [`Parts`] cuts a set along the tree of cuts into parts of at most a given number of points. Any device, process or
//! machine triangulates a part, and [`Parts::join`] joins the meshes into that of the whole set, as the CPU
//! triangulator joins its own parts. So a device of any capacity does sets of any size.
//!
//! Most triangles of a part need no join. A part lies in a cell of the quadtree, and no other point of the set is in
//! that cell. A triangle whose closed circumscribed disc lies strictly inside the cell is *final*: no point of the set
//! is inside its circle or on it, so the triangle belongs to the mesh of the whole set. Only the other triangles, which
//! `open` finds, become half-edges (`rings`). The region that the final triangles cover is a *hole* among them: the
//! merges go round it, and never remove one of its edges.
//!
//! **Why a hole does no harm.** A merge removes an edge if the vertex behind the edge is inside a circle that is empty
//! of all vertices before. Across a hole that vertex is not the corner of the final triangle but another vertex of the
//! part. The edge stays all the same: it belongs to a final triangle, so the circle through the edge and the next base
//! edge has no vertex of the part inside, whichever vertex is asked about.
//!
//! The meshes come from outside and may be wrong. `guarded` bounds the work and the memory of the merges, so that wrong
//! meshes end in [`Unsound`] or in a mesh that is wrong, but never in a panic or an endless loop.

mod guarded;
mod join;
mod open;
mod rings;
mod solved;
#[cfg(test)]
mod tests;

use alloc::vec::Vec;
use core::num::NonZeroUsize;
use core::ops::Range;

use super::conquer::level_after;
use super::sites::{sort, Sites};
use super::subtrees::divide;
use super::triangulator::{check, is_collinear, threads_for, Connectivity, Error};
use super::view::{Integers, Site, Widest};
use crate::point::{Duplicate, Point};
use crate::tiles::region::Region;

pub use solved::SolvedPart;

/// The level of a cut above the bit of the curve's position that it is made at; see `view::level`.
const LEVEL_OF_BIT_0: u32 = 2;

/// The meshes of the parts do not fit together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the meshes of the parts do not fit together, so one of them is not the Delaunay triangulation of its points")]
pub struct Unsound;

/// A set of points that is cut into parts, whose meshes are joined when all are there.
///
/// Use it to triangulate a set that is larger than a device, or to let several devices work on one set. Each part goes
/// anywhere as a set of its own; the mesh of the whole set does not depend on the number of parts.
///
/// Cost: O(n) on even sets. Cutting sorts the points as [`triangulate`](super::triangulate) does, and joining sorts the
/// triangles. Beside that, [`Parts::solved`] and [`Parts::join`] do the work of the seams, which have about
/// `5.5 sqrt(n)` of the `n` points of a part.
///
/// ```
/// use core::num::NonZeroUsize;
/// use core::ops::ControlFlow;
/// use incircle_geometry::cpu::{triangulate, Parts};
/// use incircle_geometry::Point;
///
/// let one = NonZeroUsize::MIN;
/// let points: Vec<Point> = (0..100).map(|k| Point::new(k * 37 % 101, k * k % 103)).collect();
/// let parts = Parts::divide(&points, 30, one)?;
/// let mut solved = Vec::new();
/// for part in 0..parts.count() {
///     let mesh = triangulate(parts.points(part), one, &mut |_| ControlFlow::Continue(()))?;
///     solved.push(parts.solved(part, mesh.triangles, &mesh.hull)?);
/// }
/// let joined = parts.join(solved, one)?;
/// let whole = triangulate(points, one, &mut |_| ControlFlow::Continue(()))?;
/// assert_eq!((joined.triangles, joined.hull), (whole.triangles, whole.hull));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Parts {
    /// The distinct points along the curve, counted from the lower left corner of their bounding box.
    sites: Vec<Site>,
    /// The input index of each site.
    ids: Vec<u32>,
    duplicates: Vec<Duplicate>,
    ranges: Vec<Range<usize>>,
    /// The number of input points.
    points: usize,
    /// The largest coordinates of all sites.
    far: [u32; 2],
    is_collinear: bool,
}

impl Parts {
    /// Cuts a set into parts of up to `most` distinct points, at least 3, on up to `threads` threads. Every part is a
    /// cell of the quadtree over the points.
    ///
    /// # Errors
    /// There are more than [`MAX_POINTS`](crate::MAX_POINTS) points.
    pub fn divide(points: &[Point], most: usize, threads: NonZeroUsize) -> Result<Self, Error> {
        check(points.len())?;
        let Sites { sites, ids, mut duplicates, .. } = sort(points, threads_for(points.len(), threads).get());
        duplicates.sort_unstable();
        let mut ranges = Vec::new();
        if !sites.is_empty() {
            divide::<Integers<Widest>>(&sites, 0..sites.len(), most.max(3), &mut ranges);
        }
        let far = sites.iter().fold([0; 2], |[x, y], site| [site.x().max(x), site.y().max(y)]);
        let is_collinear = is_collinear::<Integers<Widest>>(&sites);
        Ok(Self { sites, ids, duplicates, ranges, points: points.len(), far, is_collinear })
    }

    /// The number of parts; 0 if there are no points.
    pub fn count(&self) -> usize {
        self.ranges.len()
    }

    /// The number of distinct points of all parts.
    pub fn distinct(&self) -> usize {
        self.sites.len()
    }

    /// The distinct points of a part, along the curve. They are moved towards the origin, all parts of a set by the
    /// same distance, which changes no mesh. Empty if there is no such part.
    pub fn points(&self, part: usize) -> Vec<Point> {
        self.range(part).map_or_else(Vec::new, |range| {
            self.sites[range].iter().map(|site| Point::new(site.x(), site.y())).collect()
        })
    }

    /// The number of distinct points of a part; 0 if there is no such part.
    pub fn points_of(&self, part: usize) -> usize {
        self.range(part).map_or(0, |range| range.len())
    }

    /// The mesh of the whole set if all points lie on one line, so that no part need be triangulated.
    pub fn collinear(&self) -> Option<Connectivity> {
        if !self.is_collinear {
            return None;
        }
        Some(Connectivity::of_line(&self.sites, &self.ids, self.duplicates.clone()))
    }

    /// The places of a part's points among all sites.
    fn range(&self, part: usize) -> Option<Range<usize>> {
        self.ranges.get(part).cloned()
    }

    /// The cell of the quadtree that has the points of this range and no others. Sides on which the set has no points
    /// are left open.
    fn region(&self, range: &Range<usize>) -> Region {
        let level_after = |v: usize| level_after::<Integers<Widest>>(&self.sites, v);
        let before = range.start.checked_sub(1).map_or(u32::MAX, level_after);
        let level = before.min(level_after(range.end - 1));
        if level == u32::MAX {
            return Region::WHOLE;
        }
        // The cut is made at this bit of the position on the curve, where bits of y and of x take turns. The lower bits
        // are free in the cell.
        let free = level.saturating_sub(LEVEL_OF_BIT_0);
        let first = self.sites[range.start];
        let side = |coordinate: u32, bits: u32, far: u32| {
            let low = i64::from(coordinate) >> bits << bits;
            let high = low + (1 << bits);
            ((low > 0).then_some(low), (high <= i64::from(far)).then_some(high))
        };
        let (west, east) = side(first.x(), free / 2, self.far[0]);
        let (south, north) = side(first.y(), free.div_ceil(2), self.far[1]);
        Region { west, east, south, north }
    }
}
