//! Whether lines lie inside rings.

use super::error::VerifyError;
use super::exact::ExactPoint;
use super::faces::Faces;
use super::fixed::{check_closed, pieces};
use super::sites::Sites;
use super::{check_finite, check_sizes};
use crate::lattice::Numbers;
use crate::plan::Domain;
use crate::plane_point::PlanePoint;

/// Whether lines lie inside the area that rings bound by the rule even-odd, or on its border. The lines may touch the
/// rings and run along them, but cross none. Both are given by the indices of their ends. O(n log n).
///
/// Use it to see whether the holes of a polygon lie inside its outer ring.
///
/// ```
/// use incircle_geometry::verify::lie_inside;
///
/// let points = [[0, 0], [8, 0], [8, 8], [0, 8], [2, 2], [6, 2], [6, 8], [9, 2]];
/// let ring = [[0, 1], [1, 2], [2, 3], [3, 0]];
/// assert!(lie_inside(&points, &ring, &[[4, 5], [5, 6], [6, 4]])?);
/// assert!(!lie_inside(&points, &ring, &[[1, 7], [7, 2], [2, 1]])?);
/// # Ok::<(), incircle_geometry::VerifyError>(())
/// ```
///
/// # Errors
/// An index or a coordinate is wrong, the rings are not closed, or lines or rings cross; not every crossing is noticed.
pub fn lie_inside<P: PlanePoint>(points: &[P], rings: &[[u32; 2]], lines: &[[u32; 2]]) -> Result<bool, VerifyError> {
    check_sizes(points.len(), &[])?;
    match &P::numbers(points) {
        Numbers::Grid(points) => are_inside(points, rings, lines),
        Numbers::Whole(points) => are_inside(points, rings, lines),
        Numbers::Doubles(points) => {
            check_finite(points)?;
            are_inside(points, rings, lines)
        }
    }
}

fn are_inside<P: ExactPoint>(points: &[P], rings: &[[u32; 2]], lines: &[[u32; 2]]) -> Result<bool, VerifyError> {
    let sites = Sites::of(points);
    let all = [rings, lines].concat();
    let pieces = pieces(&sites, &all, rings.len(), &[])?;
    check_closed(&sites, rings, false)?;
    let inside = Faces::of(&sites, &pieces).chosen(&pieces, Domain::EvenOdd)?;
    // A piece of lines alone has the same face on both sides, as far as the rings tell.
    Ok(pieces.list.iter().zip(inside).all(|(piece, [left, _])| piece.count > 0 || left))
}
