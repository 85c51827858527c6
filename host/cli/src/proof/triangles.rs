//! The second step: the points of all corners of each triangle come together, and each triangle is checked by itself.

use incircle::verify::local::Placed;
use incircle::{Point, VerifyError};

use super::budget::Budget;
use super::mesh::MeshFile;
use super::place::Place;
use super::points::Sites;
use super::sorter::{Sorted, Sorter};
use super::strips::{members, Deal, Member, Table};
use crate::failure::Failure;

/// The numbers of a side that goes through files: the strip of the first point of the edge, both points of the edge in
/// rising order, the triangle, and its points.
pub const SIDE: usize = 12;

/// The triangles after their checks.
pub struct Checked {
    /// The first defect, if there is one.
    pub error: Option<VerifyError>,
    /// Twice the sum of the areas, if there is no defect.
    pub area: i128,
    /// The sides of the triangles that cross strips.
    pub sides: Sorted<SIDE>,
}

/// Checks all dealt triangles, whose list has the right form.
///
/// # Errors
/// A file cannot be read or written, or the mesh has changed.
pub fn check(
    (mesh, deal): (&MeshFile, &Deal),
    sites: &Sites,
    place: Place<'_>,
    budget: &Budget,
) -> Result<Checked, Failure> {
    let mut judge = Judge { area: 0, first: None };
    let mut corners = Sorter::new(place.folder, budget.share(8));
    let mut requests = Sorter::new(place.folder, budget.share(8));
    for strip in 0..sites.strips() {
        let table = Table::of(sites, strip)?;
        members((deal, strip, &table), budget.triangles, &mut |member| match member {
            Member::Within(places) => {
                judge.check(places.map(|at| table.index(at)), places.map(|at| table.point(at)));
                Ok(())
            }
            Member::Crossing(triangle, places) => {
                let [a, b, c] = triangle;
                for (k, (index, at)) in (0..).zip(triangle.into_iter().zip(places)) {
                    match at.map(|at| table.point(at)) {
                        Some(Point { x, y, .. }) => corners.push([a, b, c, k, x, y])?,
                        None => requests.push([index, a, b, c, k])?,
                    }
                }
                Ok(())
            }
        })?;
    }
    answer(&requests.finish()?, sites, budget, (&mut judge, &mut corners))?;
    let sides = cross(&corners.finish()?, sites, place, budget, &mut judge)?;
    let error = judge.first.map(|(key, flaw)| flaw.error(mesh, [key[0], key[1], key[2]])).transpose()?;
    Ok(Checked { error, area: judge.area, sides })
}

/// Finds the points of corners in other strips.
fn answer(
    requests: &Sorted<5>,
    sites: &Sites,
    budget: &Budget,
    (judge, corners): (&mut Judge, &mut Sorter<6>),
) -> Result<(), Failure> {
    let (mut stream, mut indexed) = (requests.stream(budget.share(8))?, sites.indexed());
    let mut duplicates = sites.duplicates(budget.share(16))?;
    while let Some([index, a, b, c, k]) = stream.take()? {
        match duplicates.lowest(index)? {
            Some(of) => judge.note([a, b, c, k], Flaw::Duplicate { index, of }),
            None => {
                let point = indexed.at(index)?;
                corners.push([a, b, c, k, point.x, point.y])?;
            }
        }
    }
    Ok(())
}

/// Checks the triangles that cross strips, and hands each side to the strip of its edge.
fn cross(
    corners: &Sorted<6>,
    sites: &Sites,
    place: Place<'_>,
    budget: &Budget,
    judge: &mut Judge,
) -> Result<Sorted<SIDE>, Failure> {
    let (mut stream, mut sides) = (corners.stream(budget.share(4))?, Sorter::new(place.folder, budget.share(8)));
    let mut of: ([u32; 3], [Option<Point>; 3]) = Default::default();
    while let Some([a, b, c, k, x, y]) = stream.take()? {
        if of.0 != [a, b, c] {
            of = ([a, b, c], [None; 3]);
        }
        of.1[k as usize % 3] = Some(Point::new(x, y));
        // A triangle that names a duplicate never gets all its points, and is noted as wrong already.
        let (triangle, [Some(a), Some(b), Some(c)]) = of else { continue };
        let points = [a, b, c];
        judge.check(triangle, points);
        for k in 0..3 {
            let ends = [(triangle[k], points[k]), (triangle[(k + 1) % 3], points[(k + 1) % 3])];
            let (least, most) = (ends[0].0.min(ends[1].0), ends[0].0.max(ends[1].0));
            let first = ends[usize::from(ends[1].0 == least)].1;
            let [p, q, r] = points;
            let strip = sites.strip_of(first) as u32;
            let [ta, tb, tc] = triangle;
            sides.push([strip, least, most, ta, tb, tc, p.x, p.y, q.x, q.y, r.x, r.y])?;
        }
    }
    sides.finish()
}

/// The first defect of the triangles so far, in the order of the list. All triangles differ and are in order, so this is
/// the order of their corners.
struct Judge {
    area: i128,
    /// The corners of the triangle and the number of the corner, or 3 for the triangle as a whole.
    first: Option<([u32; 4], Flaw)>,
}

/// What is wrong with a triangle.
enum Flaw {
    Duplicate { index: u32, of: u32 },
    Shape([Point; 3]),
}

impl Judge {
    fn check(&mut self, corners: [u32; 3], points: [Point; 3]) {
        let [a, b, c] = corners;
        match (Placed { triangle: 0, corners, points }).check(None) {
            Ok(area) => self.area += area,
            Err(_) => self.note([a, b, c, 3], Flaw::Shape(points)),
        }
    }

    fn note(&mut self, key: [u32; 4], flaw: Flaw) {
        if self.first.as_ref().is_none_or(|(first, _)| key < *first) {
            self.first = Some((key, flaw));
        }
    }
}

impl Flaw {
    /// The error, with the place of the triangle in the list.
    fn error(self, mesh: &MeshFile, corners: [u32; 3]) -> Result<VerifyError, Failure> {
        let triangle = mesh.places(&[corners])?.first().copied().unwrap_or_default();
        Ok(match self {
            Self::Duplicate { index, of } => VerifyError::NotLowestIndex { triangle, index, of },
            Self::Shape(points) => {
                let checked = Placed { triangle, corners, points }.check(None);
                checked.err().unwrap_or(VerifyError::NotCounterClockwise { triangle, corners })
            }
        })
    }
}
