//! The validator of constrained meshes.

use alloc::vec::Vec;

use super::buckets::Buckets;
use super::edges::{check_inner_edge, check_sides, ends, sides, HullEdges, Side};
use super::error::VerifyError;
use super::exact::ExactPoint;
use super::faces::Faces;
use super::fixed::{check_closed, pieces, Piece, Pieces};
use super::sites::Sites;
use super::summary::VerifySummary;
use super::{check_all_used, check_finite, check_sizes, check_triangles};
use crate::lattice::Numbers;
use crate::plan::{Domain, Mark, Plan};
use crate::plane_point::PlanePoint;

/// Proves that `triangles` are those of the domain of a plan in the canonical constrained mesh of `points`, and counts
/// what it has seen. Regions of the plan are not looked at.
///
/// The code shares nothing with the one that makes constrained meshes. It cuts the constraints at all points on them,
/// finds the faces between these pieces, and checks that
/// - each edge of a triangle that is no piece has a triangle on either side and is locally Delaunay, ties by the tie
///   rule;
/// - each piece has a triangle on exactly those sides that belong to the domain;
/// - no point lies in a triangle without being a corner.
///
/// So the triangles have the boundary of the domain, each side counted as it runs, and two sets of triangles of the
/// same boundary cover each place equally often: once in the domain, and never elsewhere. O(n log n), however many
/// constraints overlap or meet at one point.
///
/// ```
/// use incircle_geometry::constraints::{Domain, Plan};
/// use incircle_geometry::verify::verify_constrained;
///
/// let points = [[0, 0], [4, 0], [4, 4], [0, 4]];
/// let plan = Plan { domain: Domain::EvenOdd, ..Plan::new(&[[0, 1], [1, 3], [3, 0]]) };
/// assert!(verify_constrained(&points, &[[0, 1, 3]], &plan).is_ok());
/// assert!(verify_constrained(&points, &[[0, 1, 3], [1, 2, 3]], &plan).is_err());
/// # Ok::<(), incircle_geometry::VerifyError>(())
/// ```
///
/// # Errors
/// The first defect found, with the numbers of its points and triangles. It is one of the plan if no triangles would be
/// right: a boundary that is not closed, a hole outside the hull or on a constraint, or a domain without triangles.
pub fn verify_constrained<P: PlanePoint>(
    points: &[P],
    triangles: &[[u32; 3]],
    plan: &Plan<'_, P>,
) -> Result<VerifySummary, VerifyError> {
    check_sizes(points.len(), triangles)?;
    let holes = if plan.domain == Domain::Holes { plan.holes } else { &[] };
    let all = [points, holes].concat();
    let numbers = P::numbers(&all);
    if let Numbers::Doubles(all) = &numbers {
        let (points, holes) = all.split_at(points.len());
        check_finite(points)?;
        if let Some(number) = holes.iter().position(|hole| !hole.iter().all(|value| value.is_finite())) {
            return Err(VerifyError::MarkNotFinite { kind: Mark::Hole, number });
        }
    }
    match &numbers {
        Numbers::Grid(all) => check(all.split_at(points.len()), triangles, plan),
        Numbers::Whole(all) => check(all.split_at(points.len()), triangles, plan),
        Numbers::Doubles(all) => check(all.split_at(points.len()), triangles, plan),
    }
}

fn check<P: ExactPoint, M>(
    (points, holes): (&[P], &[P]),
    triangles: &[[u32; 3]],
    plan: &Plan<'_, M>,
) -> Result<VerifySummary, VerifyError> {
    let sites = Sites::of(points);
    let domain = plan.domain;
    let boundary = plan.constraints.len().saturating_sub(plan.lines);
    let pieces = pieces(&sites, plan.constraints, boundary, holes)?;
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
            0 if domain == Domain::All => Ok(summary),
            0 => Err(VerifyError::EmptyDomain { triangles: 0 }),
            triangles => Err(VerifyError::TrianglesOfCollinearPoints { triangles }),
        };
    }
    let chosen = chosen(&sites, plan, &pieces, holes, &summary)?;
    check_triangles(&sites, triangles)?;
    if domain == Domain::All {
        check_all_used(&sites, triangles)?;
    } else {
        check_unused(&sites, triangles)?;
    }
    check_edges(&sites, triangles, &Expected { pieces: &pieces.list, chosen: &chosen, domain }, &mut summary)?;
    Ok(summary)
}

/// Whether the faces at the left and at the right of each piece belong to the domain.
///
/// # Errors
/// The plan has no mesh: its boundary is not closed, a hole is outside the hull or on a constraint, or the domain is
/// empty.
fn chosen<P: ExactPoint, M>(
    sites: &Sites<'_, P>,
    plan: &Plan<'_, M>,
    pieces: &Pieces,
    holes: &[P],
    summary: &VerifySummary,
) -> Result<Vec<[bool; 2]>, VerifyError> {
    let domain = plan.domain;
    if matches!(domain, Domain::EvenOdd | Domain::NonZero) {
        let boundary = plan.constraints.len().saturating_sub(plan.lines);
        check_closed(sites, &plan.constraints[..boundary], domain == Domain::NonZero)?;
    }
    let chosen = Faces::of(sites, pieces).chosen(pieces, domain);
    // The first hole that is wrong is told.
    let on = if let Err(VerifyError::MarkOnConstraint { number, .. }) = chosen { number } else { usize::MAX };
    if let Some(number) = sites.outside(holes).filter(|&number| number < on) {
        return Err(VerifyError::MarkOutside { kind: Mark::Hole, number });
    }
    let chosen = chosen?;
    // Every face but the unbounded one has a piece at its border.
    if domain != Domain::All && chosen.iter().all(|sides| *sides == [false; 2]) {
        let triangles = 2 * summary.distinct - 2 - summary.hull.len();
        return Err(VerifyError::EmptyDomain { triangles });
    }
    Ok(chosen)
}

/// Checks that no triangle holds a point that is no corner of any triangle.
fn check_unused<P: ExactPoint>(sites: &Sites<'_, P>, triangles: &[[u32; 3]]) -> Result<(), VerifyError> {
    let mut is_used = alloc::vec![false; sites.points.len()];
    triangles.as_flattened().iter().for_each(|&index| is_used[index as usize] = true);
    let unused: Vec<u32> = sites.distinct.iter().copied().filter(|&index| !is_used[index as usize]).collect();
    if unused.is_empty() {
        return Ok(());
    }
    let buckets = Buckets::of(sites.points, &unused);
    for (triangle, corners) in triangles.iter().enumerate() {
        let [a, b, c] = corners.map(|corner| sites.at(corner));
        let mut inside = None;
        buckets.around([a, b, c], |index| {
            let q = sites.at(index);
            if [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| P::orient2d(from, to, q).is_ge()) {
                inside = Some(index);
            }
        });
        if let Some(point) = inside {
            return Err(VerifyError::PointInTriangle { triangle, point });
        }
    }
    Ok(())
}

/// The pieces, and the sides of each that must have triangles.
struct Expected<'a> {
    pieces: &'a [Piece],
    /// Whether the faces at the left and at the right of each piece belong to the domain.
    chosen: &'a [[bool; 2]],
    domain: Domain,
}

/// Checks all edges, and counts edges and ties in the summary.
fn check_edges<P: ExactPoint>(
    sites: &Sites<'_, P>,
    triangles: &[[u32; 3]],
    expected: &Expected<'_>,
    summary: &mut VerifySummary,
) -> Result<(), VerifyError> {
    let mut hull = HullEdges::of(&summary.hull, sites.points.len());
    let mut places: Vec<([u32; 2], usize)> = (expected.pieces.iter().enumerate())
        .map(|(place, piece)| ([piece.from.min(piece.to), piece.from.max(piece.to)], place))
        .collect();
    places.sort_unstable();
    let mut is_met = alloc::vec![false; expected.pieces.len()];
    for edge in sides(triangles).chunk_by(|one, other| one.0 == other.0) {
        summary.edges += 1;
        check_sides(triangles, edge)?;
        let Some(&(ends_of, _)) = edge.first() else { continue };
        let place = places.binary_search_by_key(&ends_of, |&(ends, _)| ends).ok().map(|found| places[found].1);
        if let Some(place) = place {
            is_met[place] = true;
        }
        match (edge, place) {
            (&[(_, only)], _) if expected.domain == Domain::All => hull.take(only, ends(triangles, only))?,
            (_, Some(place)) => expected.check_piece(triangles, edge, place)?,
            (&[(_, only)], None) => {
                return Err(VerifyError::OpenEdge { triangle: (only / 3) as usize, edge: ends(triangles, only) });
            }
            (&[(_, one), (_, other)], None) => {
                summary.ties += usize::from(check_inner_edge(sites, triangles, one, other)?);
            }
            _ => {}
        }
    }
    if expected.domain == Domain::All {
        hull.check_complete(&summary.hull)?;
    }
    let unmet = (0..expected.pieces.len()).find(|&place| !is_met[place] && expected.chosen[place] != [false; 2]);
    match unmet.map(|place| &expected.pieces[place]) {
        Some(piece) => Err(VerifyError::MissingPiece { edge: [piece.from, piece.to] }),
        None => Ok(()),
    }
}

impl Expected<'_> {
    /// Checks that a piece has triangles on those sides that belong to the domain.
    fn check_piece(&self, triangles: &[[u32; 3]], sides: &[Side], place: usize) -> Result<(), VerifyError> {
        let piece = &self.pieces[place];
        let has = |from: u32| sides.iter().any(|&(_, half)| ends(triangles, half)[0] == from);
        if self.domain == Domain::All || [has(piece.from), has(piece.to)] == self.chosen[place] {
            return Ok(());
        }
        let [left, right] = self.chosen[place];
        let [due, found] = [u8::from(left) + u8::from(right), sides.len() as u8];
        Err(VerifyError::SidesOfPiece { edge: [piece.from, piece.to], found, due })
    }
}
