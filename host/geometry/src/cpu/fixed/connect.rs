//! From points and constraints to the canonical constrained mesh.

use alloc::vec::Vec;
use core::num::NonZeroUsize;

use super::{Fixed, Part};
use crate::cpu::collect;
use crate::cpu::filtered::Filtered;
use crate::cpu::filtered_sites::{self, FilteredSites};
use crate::cpu::kernel::Kernel;
use crate::cpu::sites::{self, Sites};
use crate::cpu::triangulator::{check, insert, is_collinear, tell, threads_for, Error, Stage, Watch};
use crate::cpu::view::{Integers, Narrow, Wide, Widest, NARROW_BITS, WIDE_BITS};
use crate::double::Coordinate;
use crate::lattice::Numbers;
use crate::pages;
use crate::point::{Duplicate, Point};

/// A constrained mesh, by input indices.
pub(crate) struct Forced {
    pub triangles: Vec<[u32; 3]>,
    pub hull: Vec<u32>,
    pub duplicates: Vec<Duplicate>,
    /// The edges that constraints fix, smaller index first, each with one of its constraints.
    pub parts: Vec<([u32; 2], u32)>,
}

/// What a mesh with constraints is made of.
#[derive(Clone, Copy)]
pub(crate) struct Asked<'a> {
    /// Pairs of indices of points, which exist.
    pub constraints: &'a [[u32; 2]],
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
}

/// The mesh of the first `points` places with constraints, in the numbers in which the set is given. `None` if there
/// are no triangles, or the constraints cross or have too many parts: [`constrain`](crate::constraints::constrain) says
/// which.
///
/// # Errors
/// As those of [`connect`](crate::cpu::connect).
pub(crate) fn connect_fixed(
    numbers: &Numbers<'_>,
    points: usize,
    asked: Asked<'_>,
    watch: Watch<'_>,
) -> Result<Option<Forced>, Error> {
    check(points)?;
    tell(watch, Stage::Order, 0, points)?;
    let threads = threads_for(points, asked.threads).get();
    match numbers {
        Numbers::Grid(places) => of_grid(&places[..points], asked, threads, watch),
        Numbers::Whole(places) => of_filtered(&places[..points], asked, threads, watch),
        Numbers::Doubles(places) => of_filtered(&places[..points], asked, threads, watch),
    }
}

fn of_grid(points: &[Point], asked: Asked<'_>, threads: usize, watch: Watch<'_>) -> Result<Option<Forced>, Error> {
    let Sites { sites, ids, duplicates, bits } = sites::sort(points, threads);
    let (sites, places, points) = (&sites[..], &sites[..], points.len());
    if bits <= NARROW_BITS {
        Curve::<Integers<Narrow>> { sites, places, ids, duplicates, points }.force(asked, threads, watch)
    } else if bits <= WIDE_BITS {
        Curve::<Integers<Wide>> { sites, places, ids, duplicates, points }.force(asked, threads, watch)
    } else {
        Curve::<Integers<Widest>> { sites, places, ids, duplicates, points }.force(asked, threads, watch)
    }
}

fn of_filtered<C: Coordinate>(
    points: &[[C; 2]],
    asked: Asked<'_>,
    threads: usize,
    watch: Watch<'_>,
) -> Result<Option<Forced>, Error> {
    if let Some(index) = points.iter().position(|point| !point.iter().all(|value| value.half().is_finite())) {
        return Err(Error::NotFinite { index });
    }
    let FilteredSites { sites, places, ids, duplicates } = filtered_sites::sort(points, threads);
    let (sites, places, points) = (&sites[..], &places[..], points.len());
    Curve::<Filtered<C>> { sites, places, ids, duplicates, points }.force(asked, threads, watch)
}

impl<K: Kernel> Curve<'_, K> {
    fn force(mut self, asked: Asked<'_>, threads: usize, watch: Watch<'_>) -> Result<Option<Forced>, Error> {
        if is_collinear::<K>(self.sites) {
            return Ok(None);
        }
        self.duplicates.sort_unstable();
        let (mut halves, Some(whole)) = insert::<K>(self.sites, self.places, threads, watch)? else { return Ok(None) };
        tell(watch, Stage::Assemble, 0, self.points)?;
        let hull = collect::hull_of(&mut halves, &self.ids, whole.leftmost());
        let ends = self.ends(asked.constraints);
        let mut mesh = Fixed::<K>::new(self.sites, &mut halves);
        let Ok(parts) = mesh.force_all(&ends, asked.most) else { return Ok(None) };
        mesh.unmark();
        let count = 2 * self.ids.len() - 2 - hull.len();
        let triangles = collect::triangles(halves, &self.ids, self.points, count, threads);
        let parts = self.renumbered(parts);
        Ok(Some(Forced { triangles, hull, duplicates: self.duplicates, parts }))
    }

    /// The vertices at the ends of constraints.
    fn ends(&self, constraints: &[[u32; 2]]) -> Vec<[u32; 2]> {
        let mut rank: Vec<u32> = pages::zeros(self.points);
        (0..).zip(&self.ids).for_each(|(place, &id)| rank[id as usize] = place);
        self.duplicates.iter().for_each(|own| rank[own.index as usize] = rank[own.of as usize]);
        constraints.iter().map(|pair| pair.map(|end| rank[end as usize])).collect()
    }

    /// The parts of constraints with input indices.
    fn renumbered(&self, parts: Vec<Part>) -> Vec<([u32; 2], u32)> {
        let renumber = |Part { ends, constraint }| {
            let [a, b] = ends.map(|vertex: u32| self.ids[vertex as usize]);
            ([a.min(b), a.max(b)], constraint)
        };
        parts.into_iter().map(renumber).collect()
    }
}
