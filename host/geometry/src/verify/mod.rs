//! The validator, which proves that a mesh is the canonical one.
//!
//! Use the validator in tests of code that makes or changes meshes, and on answers of hardware that you do not trust.
//! The validator shares no predicate, no sort and no step of an algorithm with the devices, the model or the rest of
//! the host, only the types of points and meshes. Instead, it has exact integers of its own, the lifted 3x3
//! determinant, and a hull by monotone chain (Andrew 1979).
//!
//! An accepted list of triangles is the canonical mesh, because
//! - all triangles are counter-clockwise, and each edge has one triangle on either side, or is a hull edge with one
//!   triangle, and no hull edge is missing: so the number of triangles above a place changes from 0 to 1 at the hull
//!   and nowhere else, and the triangles fill the hull without overlap;
//! - each distinct point is a corner: so no triangle holds another point, because two triangles would overlap there;
//! - each inner edge is locally Delaunay, ties by the tie rule: so all triangles are Delaunay (Delaunay 1934), and as
//!   the tie rule is a lifting (see [`cpu`](crate::cpu)), no other set of triangles passes;
//! - each triangle begins with its smallest index, and the list is sorted: so there is no other such list.
//!
//! Euler's formula and the sum of the areas follow from the first two points. The validator checks Euler's formula all
//! the same, and the areas where integers of 128 bits can sum them, which is for points of the grid.

mod buckets;
mod constrained;
mod digits;
mod edges;
mod error;
mod exact;
mod faces;
mod fixed;
mod inside;
pub mod local;
mod sites;
mod strands;
mod summary;

use alloc::vec;
use alloc::vec::Vec;

pub use constrained::verify_constrained;
pub use error::VerifyError;
pub use inside::lie_inside;
pub use summary::VerifySummary;

use crate::lattice::Numbers;
use crate::plane_point::PlanePoint;
use crate::point::Duplicate;

use exact::ExactPoint;
use sites::Sites;

/// Most points or triangles that the validator takes: three half-edges of each triangle must fit 32 bits.
const MAX_COUNT: usize = (u32::MAX / 3) as usize;

/// Proves that `triangles` is the canonical Delaunay triangulation of `points`, and counts what it has seen.
///
/// The triangles may come from anywhere; indices out of range and other nonsense are errors, never a panic. Points are
/// of any type that can be triangulated. O(n log n), with about 200 bytes a point.
/// [`Mesh::verify`](crate::Mesh::verify) also checks the hull and the duplicates of a mesh.
///
/// ```
/// use incircle_geometry::{verify, Point};
/// let square = [(0, 0), (2, 0), (2, 2), (0, 2)].map(Point::from);
/// let summary = verify(&square, &[[0, 1, 2], [0, 2, 3]])?;
/// assert_eq!((summary.edges, summary.ties), (5, 1));
/// assert!(verify(&square, &[[0, 1, 3], [1, 2, 3]]).is_err());
/// # Ok::<(), incircle_geometry::VerifyError>(())
/// ```
///
/// # Errors
/// The first defect found, with the numbers of its points and triangles.
pub fn verify<P: PlanePoint>(points: &[P], triangles: &[[u32; 3]]) -> Result<VerifySummary, VerifyError> {
    check_sizes(points.len(), triangles)?;
    match P::numbers(points) {
        Numbers::Grid(points) => verify_exactly(&points, triangles),
        Numbers::Whole(points) => verify_exactly(&points, triangles),
        Numbers::Doubles(points) => {
            check_finite(&points)?;
            verify_exactly(&points, triangles)
        }
    }
}

fn verify_exactly<P: ExactPoint>(points: &[P], triangles: &[[u32; 3]]) -> Result<VerifySummary, VerifyError> {
    let sites = Sites::of(points);
    let mut summary = VerifySummary {
        points: points.len(),
        distinct: sites.distinct.len(),
        duplicates: points.len() - sites.distinct.len(),
        triangles: triangles.len(),
        hull: sites.hull(),
        collinear: sites.are_collinear(),
        ..VerifySummary::default()
    };
    if summary.collinear {
        return match triangles.len() {
            0 => Ok(summary),
            triangles => Err(VerifyError::TrianglesOfCollinearPoints { triangles }),
        };
    }
    let covered = check_triangles(&sites, triangles)?;
    local::check_count(summary.triangles, summary.distinct, summary.hull.len())?;
    check_all_used(&sites, triangles)?;
    check_area(&sites, &summary.hull, covered)?;
    edges::check(&sites, triangles, &mut summary)?;
    Ok(summary)
}

fn check_sizes(points: usize, triangles: &[[u32; 3]]) -> Result<(), VerifyError> {
    let count = points.max(triangles.len());
    if count > MAX_COUNT {
        return Err(VerifyError::TooLarge { count, max: MAX_COUNT });
    }
    Ok(())
}

fn check_finite(points: &[[f64; 2]]) -> Result<(), VerifyError> {
    match points.iter().position(|point| !point.iter().all(|value| value.is_finite())) {
        Some(index) => Err(VerifyError::NotFinite { index }),
        None => Ok(()),
    }
}

/// Checks each triangle by itself and the order of the list; returns twice the sum of the areas, if
/// the numbers allow it.
fn check_triangles<P: ExactPoint>(sites: &Sites<'_, P>, triangles: &[[u32; 3]]) -> Result<Option<i128>, VerifyError> {
    let mut covered = Some(0);
    for (triangle, &corners) in triangles.iter().enumerate() {
        check_corners(sites, triangle, corners)?;
        let points = corners.map(|corner| sites.at(corner));
        let before = triangle.checked_sub(1).and_then(|before| triangles.get(before)).copied();
        let area = local::check_shape(triangle, corners, points, before)?;
        covered = covered.zip(area).map(|(sum, area)| sum + area);
    }
    Ok(covered)
}

/// Checks that the corners of a triangle exist, each under the lowest index of its coordinates.
fn check_corners<P: ExactPoint>(sites: &Sites<'_, P>, triangle: usize, corners: [u32; 3]) -> Result<(), VerifyError> {
    for index in corners {
        match sites.lowest.get(index as usize) {
            None => return Err(VerifyError::IndexOutOfRange { triangle, index, points: sites.points.len() }),
            Some(&of) if of != index => return Err(VerifyError::NotLowestIndex { triangle, index, of }),
            Some(_) => {}
        }
    }
    Ok(())
}

fn check_all_used<P: ExactPoint>(sites: &Sites<'_, P>, triangles: &[[u32; 3]]) -> Result<(), VerifyError> {
    let mut used = vec![false; sites.points.len()];
    for &index in triangles.as_flattened() {
        used[index as usize] = true;
    }
    let unused = sites.distinct.iter().filter(|&&index| !used[index as usize]);
    match unused.min() {
        Some(&index) => Err(VerifyError::UnusedPoint { index }),
        None => Ok(()),
    }
}

/// Checks that the triangles sum to the area of the hull, if the numbers allow sums.
fn check_area<P: ExactPoint>(sites: &Sites<'_, P>, hull: &[u32], triangles: Option<i128>) -> Result<(), VerifyError> {
    let Some(triangles) = triangles else {
        return Ok(());
    };
    let following = hull.iter().skip(1).chain(hull.first());
    let sectors = hull.iter().zip(following);
    let hull = sectors.filter_map(|(&from, &to)| P::orient2d_value(None, sites.at(from), sites.at(to))).sum();
    local::check_area(triangles, hull)
}

/// Checks that the hull of a mesh is the one of the summary.
pub(crate) fn check_hull(hull: &[u32], summary: &VerifySummary) -> Result<(), VerifyError> {
    match first_difference(hull, &summary.hull) {
        Some(place) => Err(VerifyError::Hull {
            place,
            found: hull.get(place).copied(),
            expected: summary.hull.get(place).copied(),
        }),
        None => Ok(()),
    }
}

/// Checks that the duplicates of a mesh are those of its points.
pub(crate) fn check_duplicates<P: PlanePoint>(points: &[P], duplicates: &[Duplicate]) -> Result<(), VerifyError> {
    let expected: Vec<Duplicate> = match P::numbers(points) {
        Numbers::Grid(points) => Sites::of(&points).duplicates().collect(),
        Numbers::Whole(points) => Sites::of(&points).duplicates().collect(),
        Numbers::Doubles(points) => Sites::of(&points).duplicates().collect(),
    };
    match first_difference(duplicates, &expected) {
        Some(place) => Err(VerifyError::Duplicates { place }),
        None => Ok(()),
    }
}

/// The first place at which two lists differ.
fn first_difference<T: PartialEq>(one: &[T], other: &[T]) -> Option<usize> {
    if one == other {
        return None;
    }
    let common = one.iter().zip(other).take_while(|(one, other)| one == other);
    Some(common.count())
}

#[cfg(test)]
mod plan_tests;
#[cfg(test)]
mod tests;
