//! From points and constraints to a mesh in one call.

use alloc::vec::Vec;
use core::num::NonZeroUsize;

use super::build::{are_in_range, area_inside, of_numbers, MeshLists};
use super::constrain::{in_numbers, Restored};
use super::constrained::Constrained;
use super::error::Error;
use super::listing::MOST_PARTS;
use super::pieces::Pieces;
use crate::cpu::{self, connect, connect_fixed, Asked, Connectivity, Forced, Outcome, Stage, Watch};
use crate::lattice::{Lattice, Numbers};
use crate::plan::Plan;
use crate::plane_point::PlanePoint;
use crate::point::Duplicate;
use crate::site::Site;

/// A constrained mesh with the hull and the duplicates of its points.
#[non_exhaustive]
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Triangulated {
    /// The triangles of the domain, and what became of the constraints: the answer of
    /// [`constrain`](super::constrain).
    pub made: Constrained,
    /// The hull of all points, as [`Mesh::hull`](crate::Mesh::hull).
    pub hull: Vec<u32>,
    /// The points with the coordinates of an earlier one, as [`Mesh::duplicates`](crate::Mesh::duplicates).
    pub duplicates: Vec<Duplicate>,
}

/// Why points and constraints have no mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TriangulateError {
    /// The points have no mesh, or the watch ended the work.
    #[error(transparent)]
    Points(#[from] cpu::Error),
    /// The constraints or the domain have no mesh.
    #[error(transparent)]
    Plan(#[from] Error),
}

impl Restored for TriangulateError {
    fn restored(self, lattice: Option<&Lattice>) -> Self {
        match self {
            Self::Plan(error) => Self::Plan(error.restored(lattice)),
            other => other,
        }
    }
}

/// Triangulates points with constraints, and takes the triangles of a domain.
///
/// The result is that of [`cpu::triangulate`](crate::cpu::triangulate) and [`constrain`](super::constrain), byte for
/// byte, in less time: the constraints are forced in before the triangles are sorted, while neighbours lie close
/// together in memory. Use `constrain` if there is a mesh already, for example that of a device.
///
/// `threads` and `watch` are those of `cpu::triangulate`; one thread forces the constraints. O(n) on even sets, then
/// for each constraint the edges that it crosses, and the flips around them. Where the answer is an error, the
/// constraints are taken out of the mesh, and the steps of `constrain` find out what is wrong; `watch` can end this,
/// too.
///
/// ```
/// use core::num::NonZeroUsize;
/// use core::ops::ControlFlow;
/// use incircle_geometry::constraints::{triangulate, Domain, Plan};
///
/// // A square with a notch: point 4 lies inside the hull.
/// let points = [[0, 0], [8, 0], [8, 8], [0, 8], [4, 3]];
/// let outline = [[0, 1], [1, 2], [2, 4], [4, 3], [3, 0]];
/// let plan = Plan { domain: Domain::EvenOdd, ..Plan::new(&outline) };
/// let mesh = triangulate(&points, &plan, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?;
/// assert_eq!(mesh.made.triangles, [[0, 1, 4], [0, 4, 3], [1, 2, 4]]);
/// assert_eq!(mesh.hull, [0, 1, 2, 3]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Errors
/// Those of `cpu::triangulate` and of `constrain`.
pub fn triangulate<P: PlanePoint>(
    points: &[P],
    plan: &Plan<'_, P>,
    threads: NonZeroUsize,
    watch: Watch<'_>,
) -> Result<Triangulated, TriangulateError> {
    if let Some(index) = points.iter().position(|point| !point.site().is_finite()) {
        return Err(cpu::Error::NotFinite { index }.into());
    }
    in_numbers(points, plan, |numbers, plan| triangulate_numbers(numbers, points.len(), plan, threads, watch))
}

/// The same as [`triangulate`] for the first `points` places of a set in the numbers in which it is given. Holes and
/// regions are indices of places, which may stand behind them.
///
/// # Errors
/// As those of [`triangulate`]. A crossing is told in these numbers.
pub fn triangulate_numbers(
    numbers: &Numbers<'_>,
    points: usize,
    plan: &Plan<'_, u32>,
    threads: NonZeroUsize,
    watch: Watch<'_>,
) -> Result<Triangulated, TriangulateError> {
    let places = plan.holes.iter().chain(plan.regions);
    let places_exist = points <= numbers.len() && places.copied().all(|place| (place as usize) < numbers.len());
    let mesh = if places_exist && are_in_range(plan.constraints, points) {
        match connect_fixed(numbers, points, Asked { plan, most: MOST_PARTS, threads }, watch)? {
            Outcome::Forced(forced) => return Ok(triangulated(numbers, forced)),
            Outcome::Plain(mesh) => mesh,
        }
    } else {
        connect(&numbers.first(points), threads, watch)?
    };
    // There are no triangles, or the answer is an error: the steps one by one say which.
    let Connectivity { triangles, hull, duplicates } = mesh;
    let lists = MeshLists { triangles: &triangles, hull: &hull, duplicates: &duplicates };
    let mut go_on = || cpu::tell(watch, Stage::Assemble, 0, points).map_err(TriangulateError::Points);
    let made = of_numbers(numbers, points, lists, plan, &mut go_on)?;
    Ok(Triangulated { made, hull, duplicates })
}

fn triangulated(numbers: &Numbers<'_>, forced: Forced) -> Triangulated {
    let Forced { triangles, regions, region_count, marked, hull, duplicates, parts, repeats, border } = forced;
    let (pieces, twice_area) = (Pieces::of(parts, &repeats), area_inside(numbers, &border));
    let made = Constrained { triangles, regions, region_count, marked, pieces, twice_area };
    Triangulated { made, hull, duplicates }
}
