//! The third step: the sides of each edge come together in the strip of its first point, and are checked.

use incircle::verify::local::{check_inner_edge, check_sides, Placed, Side};
use incircle::{Point, VerifyError};

use super::budget::Budget;
use super::mesh::MeshFile;
use super::points::{Hull, Sites};
use super::sorter::{Sorted, Stream};
use super::strips::{members, Deal, Member, Table};
use super::triangles::SIDE;
use crate::failure::Failure;
use crate::progress::CountMeter;

/// More sides of an edge change nothing: of three, two run the same way.
const MOST_SIDES: usize = 3;

/// The result of the step.
#[derive(Default)]
pub struct Edges {
    /// The number of edges.
    pub count: u64,
    /// The number of ties.
    pub ties: u64,
    /// The first edge whose sides do not fit.
    unfit: Option<UnfitEdge>,
    /// The first edge of the hull that has no triangle, with its rank.
    missing: Option<(u64, [u32; 2])>,
    /// The first edge that is not Delaunay.
    wrong: Option<([u32; 2], Vec<Side>)>,
}

/// An edge whose sides do not fit.
struct UnfitEdge {
    ends: [u32; 2],
    sides: Vec<Side>,
    /// The ends in the direction of the hull, if the edge lies on it.
    due: Option<[u32; 2]>,
}

/// An edge of the hull: its ends in the direction of the hull, and its place there.
type HullEdge = ([u32; 2], u32);

/// Takes an edge: its ends in rising order, its sides, and what it is on the hull.
type TakeEdge<'t> = dyn FnMut([u32; 2], &[Side], Option<HullEdge>) + 't;

/// Checks the edges of all strips.
///
/// # Errors
/// A file cannot be read.
pub fn check(
    (deal, sides): (&Deal, &Sorted<SIDE>),
    sites: &Sites,
    budget: &Budget,
    quiet: bool,
) -> Result<Edges, Failure> {
    let meter = CountMeter::new(sites.strips() as u64, "checking", "strips of edges", quiet);
    let mut edges = Edges::default();
    let (mut sides, mut hull) = (sides.stream(budget.share(8))?, sites.hull.edges.stream(budget.share(16))?);
    for strip in 0..sites.strips() {
        let table = Table::of(sites, strip)?;
        let strip = Strip::of((deal, strip, table), budget)?;
        strip.each_edge(&mut sides, &mut hull, &mut |edge, sides, on_hull| {
            edges.take(edge, sides, on_hull, &sites.hull);
        })?;
        meter.advance(1);
    }
    Ok(edges)
}

impl Edges {
    /// Judges one edge.
    fn take(&mut self, edge: [u32; 2], sides: &[Side], on_hull: Option<HullEdge>, hull: &Hull) {
        let due = on_hull.map(|(ends, _)| ends);
        self.count += u64::from(!sides.is_empty());
        if !sides.is_empty() && check_sides(sides, due).is_err() {
            if self.unfit.as_ref().is_none_or(|first| edge < first.ends) {
                self.unfit = Some(UnfitEdge { ends: edge, sides: sides.to_vec(), due });
            }
            return;
        }
        // The only side of an edge of the hull runs along it, or the check above had failed.
        if let Some((ends, place)) = on_hull.filter(|_| sides.len() != 1) {
            let rank = hull.rank(place);
            if self.missing.is_none_or(|(first, _)| rank < first) {
                self.missing = Some((rank, ends));
            }
        }
        if let [one, other] = sides {
            match check_inner_edge(one, other) {
                Ok(is_tie) => self.ties += u64::from(is_tie),
                Err(_) if self.wrong.as_ref().is_none_or(|(first, _)| edge < *first) => {
                    self.wrong = Some((edge, sides.to_vec()));
                }
                Err(_) => {}
            }
        }
    }

    /// The first defect, with the places of its triangles in the list.
    ///
    /// # Errors
    /// The mesh cannot be read, or has changed.
    pub fn error(&self, mesh: &MeshFile) -> Result<Option<VerifyError>, Failure> {
        if let Some(UnfitEdge { sides, due, .. }) = &self.unfit {
            return Ok(check_sides(&placed(sides, mesh)?, *due).err());
        }
        if let Some((_, edge)) = self.missing {
            return Ok(Some(VerifyError::MissingHullEdge { edge }));
        }
        let Some((_, sides)) = &self.wrong else { return Ok(None) };
        Ok(match &placed(sides, mesh)?[..] {
            [one, other] => check_inner_edge(one, other).err(),
            _ => None,
        })
    }
}

/// Sides with the places of their triangles in the list.
fn placed(sides: &[Side], mesh: &MeshFile) -> Result<Vec<Side>, Failure> {
    let triangles: Vec<[u32; 3]> = sides.iter().map(|side| side.of.corners).collect();
    let places = mesh.places(&triangles)?;
    let numbered = sides.iter().zip(places);
    Ok(numbered.map(|(side, triangle)| Side { of: Placed { triangle, ..side.of }, ..*side }).collect())
}

/// A strip with the sides of its triangles that cross no other strip.
struct Strip {
    number: u32,
    table: Table,
    /// The places of the corners in the table.
    triangles: Vec<[u32; 3]>,
    /// For each side the places of the ends of its edge, the lower one first, and four times the number of the triangle
    /// with the number of the corner. Sorted.
    sides: Vec<[u32; 3]>,
}

impl Strip {
    fn of((deal, number, table): (&Deal, usize, Table), budget: &Budget) -> Result<Self, Failure> {
        let (mut triangles, mut sides) = (Vec::new(), Vec::new());
        members((deal, number, &table), budget.triangles, &mut |member| {
            let Member::Within(places) = member else { return Ok(()) };
            if triangles.len() == triangles.capacity() {
                // Doubling could take twice the memory.
                triangles.reserve_exact(1 << 16);
                sides.reserve_exact(3 << 16);
            }
            for k in 0..3 {
                let [from, to] = [places[k], places[(k + 1) % 3]];
                sides.push([from.min(to), from.max(to), 4 * triangles.len() as u32 + k as u32]);
            }
            triangles.push(places);
            Ok(())
        })?;
        sides.sort_unstable();
        Ok(Self { number: number as u32, table, triangles, sides })
    }

    /// Calls `take` with each edge of the strip: its points in rising order, its first sides in the order of their
    /// triangles, and its direction and place on the hull. An edge of the hull may have no side.
    fn each_edge(
        &self,
        crossing: &mut Stream<'_, SIDE>,
        hull: &mut Stream<'_, 5>,
        take: &mut TakeEdge<'_>,
    ) -> Result<(), Failure> {
        let (mut next, mut sides) = (0, Vec::new());
        loop {
            let own = self.sides.get(next).map(|side| self.edge(side));
            let others = crossing.peek().filter(|row| row[0] == self.number).map(|row| [row[1], row[2]]);
            let outer = hull.peek().filter(|row| row[0] == self.number).map(|row| [row[1], row[2]]);
            let Some(edge) = [own, others, outer].into_iter().flatten().min() else { return Ok(()) };
            sides.clear();
            while let Some(side) = self.sides.get(next).filter(|side| self.edge(side) == edge) {
                if sides.len() < MOST_SIDES {
                    sides.push(self.side(side[2]));
                }
                next += 1;
            }
            let within = sides.len();
            while let Some(&row) = crossing.peek().filter(|row| row[..3] == [self.number, edge[0], edge[1]]) {
                if sides.len() < within + MOST_SIDES {
                    sides.push(side_of(row));
                }
                crossing.take()?;
            }
            if sides.len() > within {
                sides.sort_by_key(|side| side.of.corners);
                sides.truncate(MOST_SIDES);
            }
            let mut on_hull = None;
            while let Some(&[_, _, _, is_turned, place]) =
                hull.peek().filter(|row| row[..3] == [self.number, edge[0], edge[1]])
            {
                on_hull = Some((if is_turned == 1 { [edge[1], edge[0]] } else { edge }, place));
                hull.take()?;
            }
            take(edge, &sides, on_hull);
        }
    }

    fn edge(&self, [least, most, _]: &[u32; 3]) -> [u32; 2] {
        [self.table.index(*least), self.table.index(*most)]
    }

    /// The side with this number.
    fn side(&self, number: u32) -> Side {
        let places = self.triangles[(number / 4) as usize];
        let (corners, points) = (places.map(|at| self.table.index(at)), places.map(|at| self.table.point(at)));
        Side { of: Placed { triangle: 0, corners, points }, corner: (number % 4) as usize }
    }
}

/// The side of a row that went through files.
fn side_of(row: [u32; SIDE]) -> Side {
    let [_, least, most, a, b, c, ax, ay, bx, by, cx, cy] = row;
    let corners = [a, b, c];
    let corner = (0..3).find(|&k| {
        let ends = [corners[k], corners[(k + 1) % 3]];
        ends == [least, most] || ends == [most, least]
    });
    let points = [Point::new(ax, ay), Point::new(bx, by), Point::new(cx, cy)];
    Side { of: Placed { triangle: 0, corners, points }, corner: corner.unwrap_or_default() }
}
