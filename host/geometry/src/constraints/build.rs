//! From a mesh and a plan to a constrained mesh, step by step.

use alloc::vec;
use alloc::vec::Vec;

use super::constrained::Constrained;
use super::crossing::Place;
use super::domain::{Boundary, Parts};
use super::error::Error;
use super::listing::{force_all, pieces_on_line, GoOn};
use super::network::Network;
use super::pieces::Pieces;
use crate::cpu::view::view_of_32_bits;
use crate::double::Coordinate;
use crate::lattice::Numbers;
use crate::mesh::smallest_first;
use crate::pages;
use crate::plan::{Domain, Mark, Plan};
use crate::point::{Duplicate, Point, MAX_POINTS};
use crate::site::{FilteredSite, Site};

/// The lists of a mesh.
#[derive(Clone, Copy)]
pub(super) struct MeshLists<'a> {
    pub triangles: &'a [[u32; 3]],
    pub hull: &'a [u32],
    pub duplicates: &'a [Duplicate],
}

/// Makes the constrained mesh of the first `points` places.
///
/// # Errors
/// The plan has no mesh, or `go_on` ends the work.
pub(super) fn of_numbers<E: From<Error>>(
    numbers: &Numbers<'_>,
    points: usize,
    mesh: MeshLists<'_>,
    plan: &Plan<'_, u32>,
    go_on: GoOn<'_, E>,
) -> Result<Constrained, E> {
    match numbers {
        Numbers::Grid(places) => {
            let whole = |site: Point| Some([site.x.into(), site.y.into()]);
            let mut made = of_sites(places, points, mesh, plan, whole, go_on)?;
            made.twice_area = Some(twice_area(places, &made.triangles));
            Ok(made)
        }
        Numbers::Whole(places) => of_sites(&filtered(places), points, mesh, plan, |site| Some(site.0), go_on),
        Numbers::Doubles(places) => of_sites(&filtered(places), points, mesh, plan, |_| None, go_on),
    }
}

fn filtered<C: Coordinate>(places: &[[C; 2]]) -> Vec<FilteredSite<C>> {
    places.iter().map(|&place| FilteredSite::of(place)).collect()
}

/// Twice the sum of the areas of the triangles. Twice an area is below 2^65, and there are fewer than 2^30 triangles,
/// so 128 bits hold the sum.
fn twice_area(places: &[Point], triangles: &[[u32; 3]]) -> i128 {
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| places[corner as usize]);
        view_of_32_bits(a, b, c).cross
    };
    triangles.iter().map(area).sum()
}

/// Twice the area to the left of the edges around it, for points of the grid. It is the sum of the areas of the
/// triangles there. Each cross product is below 2^65, and there are fewer than 2^31, so 128 bits hold the sum.
pub(super) fn area_inside(numbers: &Numbers<'_>, border: &[[u32; 2]]) -> Option<i128> {
    let Numbers::Grid(places) = numbers else { return None };
    let cross = |ends: &[u32; 2]| {
        let [a, b] = ends.map(|index| places[index as usize]);
        i128::from(a.x) * i128::from(b.y) - i128::from(a.y) * i128::from(b.x)
    };
    Some(border.iter().map(cross).sum())
}

/// Whether there are few enough constraints, and all name points.
pub(super) fn are_in_range(constraints: &[[u32; 2]], points: usize) -> bool {
    constraints.len() <= MAX_POINTS && constraints.as_flattened().iter().all(|&end| (end as usize) < points)
}

/// The steps. `whole` gives the coordinates of a site if they are whole numbers.
fn of_sites<S: Site, E: From<Error>>(
    places: &[S],
    points: usize,
    mesh: MeshLists<'_>,
    plan: &Plan<'_, u32>,
    whole: impl Fn(S) -> Option<[i64; 2]>,
    go_on: GoOn<'_, E>,
) -> Result<Constrained, E> {
    let ends = ends_of(plan.constraints, points, mesh.duplicates)?;
    let mut marks = plan.holes.iter().chain(plan.regions);
    if places.len() < points || !marks.all(|&place| (place as usize) < places.len()) {
        return Err(Error::NoMesh.into());
    }
    if mesh.triangles.is_empty() {
        return Ok(on_line(places, mesh.hull, &ends, plan)?);
    }
    go_on()?;
    let mut network = Network::new(places, mesh.triangles, mesh.hull, &ends)?;
    let forced = force_all(&mut network, &ends, go_on)?;
    let pieces = forced.map_err(|[one, other]| {
        let constraints = [one, other];
        let pairs = constraints.map(|constraint| plan.constraints[constraint as usize]);
        let sites = pairs.map(|pair| pair.map(|vertex| places[vertex as usize]));
        let place = Place::of(sites.map(|pair| pair.map(&whole)), sites.map(|pair| pair.map(Site::rounded)));
        Error::Crossing { constraints, ends: pairs, place }
    })?;
    go_on()?;
    Ok(taken(&network, mesh.triangles.len(), (&ends, points, pieces), plan)?)
}

/// Takes the triangles of the domain, of a mesh of `count` triangles in which all constraints are.
fn taken<S: Site>(
    network: &Network<'_, S>,
    count: usize,
    (ends, points, pieces): (&[[u32; 2]], usize, Pieces),
    plan: &Plan<'_, u32>,
) -> Result<Constrained, Error> {
    let boundary = Boundary { pieces: &pieces, ends, count: plan.boundary(), domain: plan.domain };
    boundary.check(points)?;
    let parts = if plan.takes_all() { Parts::one(network) } else { Parts::of(network, &boundary) };
    let chosen = parts.chosen(network, plan)?;
    let (mut made, regions) = numbered(network, count, &parts, &chosen);
    if made.triangles.is_empty() {
        return Err(Error::Empty { triangles: count });
    }
    for (number, part) in parts.marked(network, Mark::Region, plan.regions)?.into_iter().enumerate() {
        made.marked.push(regions.get(part as usize).copied().flatten().ok_or(Error::RegionOutsideDomain { number })?);
    }
    made.pieces = pieces;
    Ok(made)
}

/// The ends of all constraints, under the lowest indices of their places.
fn ends_of(constraints: &[[u32; 2]], points: usize, duplicates: &[Duplicate]) -> Result<Vec<[u32; 2]>, Error> {
    if constraints.len() > MAX_POINTS {
        return Err(Error::TooManyConstraints { count: constraints.len(), max: MAX_POINTS });
    }
    if duplicates.iter().any(|duplicate| duplicate.of as usize >= points) {
        return Err(Error::NoMesh);
    }
    let lowest = |index: u32| {
        let found = duplicates.binary_search_by_key(&index, |duplicate| duplicate.index);
        found.map_or(index, |place| duplicates[place].of)
    };
    let checked = |(constraint, &ends): (u32, &[u32; 2])| match ends.iter().find(|&&end| end as usize >= points) {
        Some(&index) => Err(Error::OutOfRange { constraint, index, points }),
        None => Ok(ends.map(lowest)),
    };
    (0..).zip(constraints).map(checked).collect()
}

/// The pieces of constraints between points of one line, which has no triangles. `hull` has its points in order.
fn on_line<S: Site>(places: &[S], hull: &[u32], ends: &[[u32; 2]], plan: &Plan<'_, u32>) -> Result<Constrained, Error> {
    let pieces = pieces_on_line(places, hull, ends)?;
    if plan.domain != Domain::All {
        return Err(Error::Empty { triangles: 0 });
    }
    if !plan.regions.is_empty() {
        return Err(Error::Outside { kind: Mark::Region, number: 0 });
    }
    Ok(Constrained { pieces, ..Constrained::default() })
}

/// The triangles of the chosen parts in canonical order with their regions, and the region of each part. `count` is
/// the number of triangles of the mesh.
fn numbered<S: Site>(
    network: &Network<'_, S>,
    count: usize,
    parts: &Parts,
    chosen: &[bool],
) -> (Constrained, Vec<Option<u32>>) {
    let mut regions = vec![None; chosen.len()];
    let mut made = Constrained::default();
    (made.triangles, made.regions) = (pages::with_room(count), pages::with_room(count));
    let mut add = |corners: [u32; 3], triangle: u32| {
        let part = parts.of[triangle as usize] as usize;
        // In lists that are no mesh there may be triangles that no flood has met.
        if chosen.get(part) == Some(&true) {
            let region = *regions[part].get_or_insert_with(|| {
                made.region_count += 1;
                made.region_count - 1
            });
            made.triangles.push(corners);
            made.regions.push(region);
        }
    };
    // The triangles that no step has changed are sorted as they stand, so only the others are sorted, and both merged.
    let corners = |triangle: u32| smallest_first(network.plane.get(triangle).vertices);
    let numbers = || 0..count as u32;
    let changed = numbers().filter(|&number| network.is_changed(number));
    let mut changed: Vec<([u32; 3], u32)> = changed.map(|number| (corners(number), number)).collect();
    changed.sort_unstable();
    let mut changed = changed.into_iter().peekable();
    for number in numbers().filter(|&number| !network.is_changed(number)) {
        let own = corners(number);
        while let Some((corners, number)) = changed.next_if(|(other, _)| *other < own) {
            add(corners, number);
        }
        add(own, number);
    }
    changed.for_each(|(corners, number)| add(corners, number));
    (made, regions)
}
