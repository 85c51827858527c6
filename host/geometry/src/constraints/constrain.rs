//! The functions that make constrained meshes.

use alloc::vec::Vec;

use super::build::{of_numbers, MeshLists};
use super::constrained::Constrained;
use super::error::Error;
use crate::cpu::Connectivity;
use crate::lattice::Numbers;
use crate::mesh::Mesh;
use crate::plan::Plan;
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
    let places: Vec<P> = [&mesh.points[..], plan.holes, plan.regions].concat();
    if let Some(index) = places.iter().position(|place| !place.site().is_finite()) {
        return Err(Error::NotFinite { index });
    }
    let count = mesh.points.len() as u32;
    let holes: Vec<u32> = (count..).take(plan.holes.len()).collect();
    let regions: Vec<u32> = (count + plan.holes.len() as u32..).take(plan.regions.len()).collect();
    let (numbers, lattice) = P::numbers(&places).on_lattice();
    let Plan { constraints, lines, domain, .. } = *plan;
    let plan = Plan { constraints, lines, domain, holes: &holes, regions: &regions };
    let lists = MeshLists { triangles: &mesh.triangles, hull: &mesh.hull, duplicates: &mesh.duplicates };
    let restored = |error| match error {
        Error::Crossing { constraints, ends, place } => {
            let place = lattice.map_or(place, |lattice| place.restored(&lattice));
            Error::Crossing { constraints, ends, place }
        }
        other => other,
    };
    of_numbers(&numbers, mesh.points.len(), lists, &plan).map_err(restored)
}

/// The same as [`constrain`] in the numbers in which a set was triangulated. The first `points` places of `numbers` are
/// the points of the mesh. Holes and regions are indices of places, which may stand behind them.
///
/// # Errors
/// As those of [`constrain`]. A crossing is told in these numbers; [`Place::restored`] gives it in the coordinates
/// that a lattice has brought onto the grid.
pub fn constrain_numbers(
    numbers: &Numbers<'_>,
    points: usize,
    mesh: &Connectivity,
    plan: &Plan<'_, u32>,
) -> Result<Constrained, Error> {
    let lists = MeshLists { triangles: &mesh.triangles, hull: &mesh.hull, duplicates: &mesh.duplicates };
    of_numbers(numbers, points, lists, plan)
}
