//! The functions that make constrained meshes.

use alloc::vec::Vec;

use super::build::{of_numbers, MeshLists};
use super::constrained::Constrained;
use super::error::Error;
use crate::cpu::Connectivity;
use crate::lattice::{Lattice, Numbers};
use crate::mesh::Mesh;
use crate::plan::{Mark, Plan};
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// Forces constraints into the mesh of a set of points, and takes the triangles of a domain.
///
/// The mesh may come from any back end. Constraints may overlap, touch and repeat one another, and may pass through
/// points: they are then cut into pieces, and each piece is one edge of the mesh with a list of constraints. A
/// constraint between a point and itself, or a duplicate of it, has no piece.
///
/// O(n) to link the mesh; then for each constraint the degree of its first point, the number of triangles that it
/// crosses, and the flips around them.
///
/// ```
/// use core::num::NonZeroUsize;
/// use core::ops::ControlFlow;
/// use incircle_geometry::constraints::{constrain, Domain, Plan};
/// use incircle_geometry::cpu;
///
/// // A square with a notch: point 4 lies inside the hull.
/// let points = vec![[0, 0], [8, 0], [8, 8], [0, 8], [4, 3]];
/// let mesh = cpu::triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?;
/// let outline = [[0, 1], [1, 2], [2, 4], [4, 3], [3, 0]];
/// let plan = Plan { domain: Domain::EvenOdd, ..Plan::new(&outline) };
/// let made = constrain(&mesh, &plan)?;
/// assert_eq!(made.triangles, [[0, 1, 4], [0, 4, 3], [1, 2, 4]]);
/// assert_eq!(made.twice_area, Some(2 * (64 - 20)));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Errors
/// Constraints cross or name points that do not exist, the boundary of the domain is not closed, the place of a hole or
/// region is outside the hull or on a constraint, the domain is empty, or the mesh is not that of its points.
pub fn constrain<P: PlanePoint>(mesh: &Mesh<P>, plan: &Plan<'_, P>) -> Result<Constrained, Error> {
    let lists = MeshLists { triangles: &mesh.triangles, hull: &mesh.hull, duplicates: &mesh.duplicates };
    in_numbers(&mesh.points, plan, |numbers, plan| of_numbers(numbers, mesh.points.len(), lists, plan, &mut || Ok(())))
}

/// Does the work in the numbers of the points. Places of holes and regions stand behind the points there, and the place
/// of a crossing is brought back into the coordinates of the points.
pub(super) fn in_numbers<P: PlanePoint, T, E: Restored>(
    points: &[P],
    plan: &Plan<'_, P>,
    work: impl FnOnce(&Numbers<'_>, &Plan<'_, u32>) -> Result<T, E>,
) -> Result<T, E> {
    let joined;
    let places = if plan.holes.is_empty() && plan.regions.is_empty() {
        points
    } else {
        joined = [points, plan.holes, plan.regions].concat();
        &joined[..]
    };
    if let Some(index) = places.iter().position(|place| !place.site().is_finite()) {
        let [first_hole, first_region] = [points.len(), points.len() + plan.holes.len()];
        let error = match index {
            index if index >= first_region => Error::MarkNotFinite { kind: Mark::Region, number: index - first_region },
            index if index >= first_hole => Error::MarkNotFinite { kind: Mark::Hole, number: index - first_hole },
            index => Error::NotFinite { index },
        };
        return Err(error.into());
    }
    let count = points.len() as u32;
    let holes: Vec<u32> = (count..).take(plan.holes.len()).collect();
    let regions: Vec<u32> = (count + plan.holes.len() as u32..).take(plan.regions.len()).collect();
    let (numbers, lattice) = P::numbers(places).on_lattice();
    let Plan { constraints, lines, domain, .. } = *plan;
    let plan = Plan { constraints, lines, domain, holes: &holes, regions: &regions };
    work(&numbers, &plan).map_err(|error| error.restored(lattice.as_ref()))
}

/// An error that may tell the place of a crossing.
pub(super) trait Restored: From<Error> {
    /// The error with that place in the coordinates of the points, given their lattice.
    fn restored(self, lattice: Option<&Lattice>) -> Self;
}

impl Restored for Error {
    fn restored(self, lattice: Option<&Lattice>) -> Self {
        match self {
            Self::Crossing { constraints, ends, place } => {
                let place = lattice.map_or(place, |lattice| place.restored(lattice));
                Self::Crossing { constraints, ends, place }
            }
            other => other,
        }
    }
}

/// The same as [`constrain`] in the numbers in which a set was triangulated. The first `points` places of `numbers` are
/// the points of the mesh. Holes and regions are indices of places, which may stand behind them.
///
/// # Errors
/// As those of [`constrain`]. A crossing is told in these numbers; [`Place::restored`](super::Place::restored) gives it
/// in the coordinates that a lattice has brought onto the grid.
pub fn constrain_numbers(
    numbers: &Numbers<'_>,
    points: usize,
    mesh: &Connectivity,
    plan: &Plan<'_, u32>,
) -> Result<Constrained, Error> {
    let lists = MeshLists { triangles: &mesh.triangles, hull: &mesh.hull, duplicates: &mesh.duplicates };
    of_numbers(numbers, points, lists, plan, &mut || Ok(()))
}
