//! From points and constraints to the canonical constrained mesh.

use alloc::vec::Vec;
use core::num::NonZeroUsize;

use super::domain::Chosen;
use super::force::Stop;
use super::mesh::{Fixed, Part};
use super::parts::Boundary;
use crate::constraints::repeats::{by_ends, Repeats};
use crate::cpu::collect;
use crate::cpu::edges::Half;
use crate::cpu::filtered::Filtered;
use crate::cpu::filtered_sites::{self, FilteredSites};
use crate::cpu::kernel::Kernel;
use crate::cpu::sites::{self, Sites};
use crate::cpu::triangulator::{check, insert, is_collinear, tell, threads_for, Connectivity, Error, Stage, Watch};
use crate::cpu::view::{Integers, Narrow, Wide, Widest, NARROW_BITS, WIDE_BITS};
use crate::double::Coordinate;
use crate::lattice::Numbers;
use crate::pages;
use crate::plan::{Domain, Plan};
use crate::point::{Duplicate, Point};
use crate::site::FilteredSite;

/// A constrained mesh, by input indices.
pub(crate) struct Forced {
    pub triangles: Vec<[u32; 3]>,
    pub hull: Vec<u32>,
    pub duplicates: Vec<Duplicate>,
    /// The edges that constraints fix, smaller index first, each with one of its constraints. Constraints that repeat
    /// another are left out.
    pub parts: Vec<([u32; 2], u32)>,
    pub repeats: Repeats,
    /// The region of each triangle, the number of regions, and the region at each place that asks for one.
    pub regions: Vec<u32>,
    pub region_count: u32,
    pub marked: Vec<u32>,
    /// The edges around the triangles, which lie to the left of them: those of the hull if all are wanted.
    pub border: Vec<[u32; 2]>,
}

/// The mesh of points and constraints, or that of the points alone.
pub(crate) enum Outcome {
    Forced(Forced),
    /// The canonical mesh without the constraints: there are no triangles, or the plan has no answer.
    Plain(Connectivity),
}

/// What a mesh with constraints is made of.
#[derive(Clone, Copy)]
pub(crate) struct Asked<'a> {
    /// The constraints and the domain. All indices of points and places exist.
    pub plan: &'a Plan<'a, u32>,
    /// The most parts that the constraints may have.
    pub most: usize,
    pub threads: NonZeroUsize,
}

/// The sites of a set in the order of the curve.
struct Curve<'a, K: Kernel> {
    sites: &'a [K::Site],
    places: &'a [K::Place],
    ids: Vec<u32>,
    duplicates: Vec<Duplicate>,
    /// The number of input points.
    points: usize,
    /// The places of holes and of regions; `None` if some are far outside.
    marks: Option<[Vec<K::Site>; 2]>,
}

/// The mesh of the first `points` places with constraints, in the numbers in which the set is given. If there are no
/// triangles, or constraints and domain have no mesh, it is the one without constraints, and
/// [`constrain`](crate::constraints::constrain) finds out what is wrong. `watch` hears of [`Stage::Assemble`] again
/// from time to time while constraints are forced, so that it can end the work.
///
/// # Errors
/// As those of [`connect`](crate::cpu::connect).
pub(crate) fn connect_fixed(
    numbers: &Numbers<'_>,
    points: usize,
    asked: Asked<'_>,
    watch: Watch<'_>,
) -> Result<Outcome, Error> {
    check(points)?;
    tell(watch, Stage::Order, 0, points)?;
    let threads = threads_for(points, asked.threads).get();
    match numbers {
        Numbers::Grid(places) => of_grid(places, points, asked, threads, watch),
        Numbers::Whole(places) => of_filtered(places, points, asked, threads, watch),
        Numbers::Doubles(places) => of_filtered(places, points, asked, threads, watch),
    }
}

/// The sites of holes and of regions. `None` if a place has no site.
fn marks_of<S>(plan: &Plan<'_, u32>, site: impl Fn(usize) -> Option<S>) -> Option<[Vec<S>; 2]> {
    let sites = |marks: &[u32]| marks.iter().map(|&mark| site(mark as usize)).collect::<Option<Vec<S>>>();
    Some([sites(plan.holes)?, sites(plan.regions)?])
}

fn of_grid(all: &[Point], points: usize, asked: Asked<'_>, threads: usize, watch: Watch<'_>) -> Result<Outcome, Error> {
    let Sites { sites, ids, duplicates, bits } = sites::sort(&all[..points], threads);
    // Sites count from the lower left corner of the points.
    let corner = sites.first().zip(ids.first()).map(|(site, &id)| {
        let Point { x, y } = all[id as usize];
        Point::new(x - site.x(), y - site.y())
    });
    let marks = marks_of(asked.plan, |place| {
        let (Point { x, y }, corner) = (all[place], corner?);
        let (x, y) = (x.checked_sub(corner.x)?, y.checked_sub(corner.y)?);
        (u64::from(x | y) >> bits == 0).then(|| Point::new(x, y).into())
    });
    let (sites, places) = (&sites[..], &sites[..]);
    if bits <= NARROW_BITS {
        Curve::<Integers<Narrow>> { sites, places, ids, duplicates, points, marks }.force(asked, threads, watch)
    } else if bits <= WIDE_BITS {
        Curve::<Integers<Wide>> { sites, places, ids, duplicates, points, marks }.force(asked, threads, watch)
    } else {
        Curve::<Integers<Widest>> { sites, places, ids, duplicates, points, marks }.force(asked, threads, watch)
    }
}

fn of_filtered<C: Coordinate>(
    all: &[[C; 2]],
    points: usize,
    asked: Asked<'_>,
    threads: usize,
    watch: Watch<'_>,
) -> Result<Outcome, Error> {
    if let Some(index) = all[..points].iter().position(|point| !point.iter().all(|value| value.half().is_finite())) {
        return Err(Error::NotFinite { index });
    }
    let FilteredSites { sites, places, ids, duplicates } = filtered_sites::sort(&all[..points], threads);
    let marks = marks_of(asked.plan, |place| {
        let is_finite = all[place].iter().all(|value| value.half().is_finite());
        is_finite.then(|| FilteredSite::of(all[place]))
    });
    let (sites, places) = (&sites[..], &places[..]);
    Curve::<Filtered<C>> { sites, places, ids, duplicates, points, marks }.force(asked, threads, watch)
}

impl<K: Kernel> Curve<'_, K> {
    fn force(mut self, asked: Asked<'_>, threads: usize, watch: Watch<'_>) -> Result<Outcome, Error> {
        self.duplicates.sort_unstable();
        if is_collinear::<K>(self.sites) {
            return Ok(Outcome::Plain(Connectivity::of_line(self.sites, &self.ids, self.duplicates)));
        }
        let (mut halves, whole) = insert::<K>(self.sites, self.places, threads, watch)?;
        let mut go_on = || tell(watch, Stage::Assemble, 0, self.points);
        go_on()?;
        let hull = whole.map_or_else(Vec::new, |whole| collect::hull_of(&mut halves, &self.ids, whole.leftmost()));
        let ends = self.ends(asked.plan.constraints);
        let mut mesh = Fixed::<K>::new(self.sites, &mut halves);
        let order = by_ends(&ends);
        let repeats = Repeats::in_order(&order);
        let parts = match mesh.force_all(&ends, &order, asked.most, &mut go_on) {
            Ok(parts) => parts,
            Err(Stop::Ended(error)) => return Err(error),
            Err(Stop::Crossing | Stop::TooManyParts) => {
                mesh.release(&mut go_on)?;
                return Ok(Outcome::Plain(self.plain(halves, hull, threads)));
            }
        };
        go_on()?;
        let of_edge = self.renumbered(&mesh, &parts);
        let chosen = if asked.plan.takes_all() {
            mesh.unmark();
            self.whole(halves, &hull, threads)
        } else {
            let (count, domain) = (asked.plan.boundary(), asked.plan.domain);
            let boundary = Boundary { parts: &parts, repeats: &repeats, ends: &ends, count, domain };
            let marks = self.marks.as_ref();
            let chosen = marks.and_then(|[holes, regions]| mesh.take(&self.ids, &boundary, holes, regions));
            let Some(chosen) = chosen else {
                mesh.release(&mut go_on)?;
                return Ok(Outcome::Plain(self.plain(halves, hull, threads)));
            };
            chosen
        };
        let Chosen { triangles, regions, marked, region_count, mut border } = chosen;
        if asked.plan.domain == Domain::All {
            border = hull.iter().copied().zip(hull.iter().copied().cycle().skip(1)).map(|(a, b)| [a, b]).collect();
        }
        let duplicates = self.duplicates;
        let forced =
            Forced { triangles, hull, duplicates, parts: of_edge, repeats, regions, region_count, marked, border };
        Ok(Outcome::Forced(forced))
    }

    /// The mesh without constraints, from half-edges none of which is fixed.
    fn plain(self, halves: Vec<Half>, hull: Vec<u32>, threads: usize) -> Connectivity {
        let Chosen { triangles, .. } = self.whole(halves, &hull, threads);
        Connectivity { triangles, hull, duplicates: self.duplicates }
    }

    /// All triangles, as one region.
    fn whole(&self, halves: Vec<Half>, hull: &[u32], threads: usize) -> Chosen {
        let count = 2 * self.ids.len() - 2 - hull.len();
        let triangles = collect::triangles(halves, &self.ids, self.points, count, threads);
        let regions = pages::zeros(triangles.len());
        Chosen { triangles, regions, marked: Vec::new(), region_count: 1, border: Vec::new() }
    }

    /// The vertices at the ends of constraints.
    fn ends(&self, constraints: &[[u32; 2]]) -> Vec<[u32; 2]> {
        let mut rank: Vec<u32> = pages::zeros(self.points);
        (0..).zip(&self.ids).for_each(|(place, &id)| rank[id as usize] = place);
        self.duplicates.iter().for_each(|own| rank[own.index as usize] = rank[own.of as usize]);
        constraints.iter().map(|pair| pair.map(|end| rank[end as usize])).collect()
    }

    /// The parts of constraints with the input indices of their ends, the smaller first.
    fn renumbered(&self, mesh: &Fixed<'_, K>, parts: &[Part]) -> Vec<([u32; 2], u32)> {
        let renumber = |&Part { edge, constraint }: &Part| {
            let [a, b] = [mesh.origin(edge), mesh.end(edge)].map(|vertex| self.ids[vertex as usize]);
            ([a.min(b), a.max(b)], constraint)
        };
        parts.iter().map(renumber).collect()
    }
}
