//! The first step: finding the final triangles of a tile, and the border that it leaves for joins.

use alloc::vec;
use alloc::vec::Vec;

use super::error::Error;
use super::occupancy::Occupancy;
use super::reach::{Reach, TilePoint};
use super::region::Region;
use crate::mesh::{smallest_first, Mesh, EMPTY};
use crate::point::Point;

/// The result for the points of one region: its final triangles, and the border with which it is joined to others.
///
/// Triangles name points by ids that the caller chose, each with its smallest id first.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile<P: TilePoint, I> {
    /// The triangles that are in the mesh of all points, whatever lies beyond the region. After a join, those that the
    /// join has made final; the final triangles of its children are not repeated.
    pub finals: Vec<[I; 3]>,
    /// The points and triangles that joins need.
    pub border: Border<P, I>,
    /// The hull of the points of the region, in the form of [`Mesh::hull`].
    pub hull: Vec<I>,
    /// Triangles that are open only because [`Reach::Unknown`] was the answer: 0 for grid points. Such a triangle makes
    /// the border longer, and the mesh stays right.
    pub unknown: usize,
}

/// The part of a region that a join with its neighbours needs: its open triangles, and every point that a triangle
/// across a side may have as a corner.
///
/// All fields are plain lists, so that a border can be written to a file or sent to another machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Border<P: TilePoint, I> {
    /// The region, which contains all points. No other point of the set is in the region.
    pub region: Region<P::Side>,
    /// Distinct points: the corners of open triangles, and the hull.
    pub points: Vec<P>,
    /// The id of each point.
    pub ids: Vec<I>,
    /// The open triangles, as places in `points`. They have the order and the form of [`Mesh::triangles`]: sorted, each
    /// counter-clockwise with its smallest place first.
    pub open: Vec<[u32; 3]>,
}

/// Finds out which triangles of a tile are final, given the triangulation of the points of the tile alone.
///
/// `mesh` is the canonical mesh of the points in `region`, from any back end, and `ids` has an id for each point. Give
/// duplicates in ascending order of their ids, so that the lowest one stands for all. A triangle is final if its closed
/// circumscribed disc lies strictly within the region. The border has the corners of all other triangles and the hull,
/// and so all distinct points if there is no triangle.
///
/// O(n), 7 to 15 ns a triangle.
///
/// ```
/// use core::num::NonZeroUsize;
/// use core::ops::ControlFlow;
/// use incircle_geometry::{cpu, tiles, Point};
///
/// // A lattice of 20 x 20 points. More points may follow at x = 20 and beyond.
/// let points: Vec<Point> = (0..400).map(|k| Point::new(k / 20, k % 20)).collect();
/// let mesh = cpu::triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?;
/// let ids: Vec<u32> = (0..400).collect();
/// let tile = tiles::local(&mesh, &ids, tiles::Region { east: Some(20), ..tiles::Region::WHOLE })?;
/// // Each square lies within its circle, which ends 0.2 beyond it. So all triangles are final, and the border is the
/// // hull.
/// assert_eq!((tile.finals.len(), tile.border.open.len(), tile.border.points.len()), (722, 0, 76));
/// # Ok::<(), tiles::Error>(())
/// ```
///
/// # Errors
/// [`Error::Beyond`] if the region does not contain a point, [`Error::Ids`] if there are more or fewer ids than points,
/// and [`Error::NoSuchPoint`] if a triangle or the hull names a point that is not there.
pub fn local<P: TilePoint, I: Copy + Ord>(
    mesh: &Mesh<P>,
    ids: &[I],
    region: Region<P::Side>,
) -> Result<Tile<P, I>, Error> {
    check_places(mesh, &region)?;
    settle((&mesh.points, ids), mesh, region, mesh.triangles.iter().copied(), &|_| false)
}

/// Like [`local`], with more final triangles: also those whose disc touches no occupied cell beyond the region.
///
/// `occupancy` must have all points of the whole set. Takes up to 2 µs more for each triangle that [`local`] would
/// leave open.
///
/// # Errors
/// Those of [`local`].
pub fn local_among<I: Copy + Ord>(
    mesh: &Mesh,
    ids: &[I],
    region: Region,
    occupancy: &Occupancy,
) -> Result<Tile<Point, I>, Error> {
    check_places(mesh, &region)?;
    let beyond = occupancy.beyond(&region);
    let triangles = mesh.triangles.iter().copied();
    settle((&mesh.points, ids), mesh, region, triangles, &|corners| beyond.is_clear(corners))
}

/// Refuses points beyond the region.
fn check_places<P: TilePoint>(mesh: &Mesh<P>, region: &Region<P::Side>) -> Result<(), Error> {
    match mesh.points.iter().position(|point| !region.contains(point.place())) {
        Some(place) => Err(Error::Beyond { place }),
        None => Ok(()),
    }
}

/// Divides triangles of a mesh into final and open ones, and makes the border of the open ones and the hull. Triangles
/// whose disc reaches beyond the region are final if `is_clear` says so.
pub(super) fn settle<P: TilePoint, I: Copy + Ord>(
    (points, ids): (&[P], &[I]),
    mesh: &Mesh<P>,
    region: Region<P::Side>,
    triangles: impl Iterator<Item = [u32; 3]>,
    is_clear: &dyn Fn([P; 3]) -> bool,
) -> Result<Tile<P, I>, Error> {
    if points.len() != ids.len() {
        return Err(Error::Ids { points: points.len(), ids: ids.len() });
    }
    let no_point = |place: u32| Error::NoSuchPoint { place, points: points.len() };
    if let Some(&place) = mesh.hull.iter().find(|&&place| place as usize >= points.len()) {
        return Err(no_point(place));
    }
    let sides = P::sides(&region);
    let (mut finals, mut open, mut unknown) = (Vec::new(), Vec::new(), 0);
    for triangle in triangles {
        if let Some(place) = triangle.into_iter().find(|&place| place as usize >= points.len()) {
            return Err(no_point(place));
        }
        let corners = triangle.map(|place| points[place as usize]);
        let reach = P::reach(&sides, corners);
        if reach == Reach::Within || is_clear(corners) {
            finals.push(smallest_first(triangle.map(|place| ids[place as usize])));
        } else {
            unknown += usize::from(reach == Reach::Unknown);
            open.push(triangle);
        }
    }
    let border = border(points, ids, &mesh.hull, region, open);
    let hull = named_hull(mesh, ids);
    Ok(Tile { finals, border, hull, unknown })
}

/// The hull of a mesh by ids, in canonical form. All its places must have ids.
fn named_hull<P, I: Copy + Ord>(mesh: &Mesh<P>, ids: &[I]) -> Vec<I> {
    let mut hull: Vec<I> = mesh.hull.iter().map(|&place| ids[place as usize]).collect();
    // Without triangles the hull is a list from one end of the line to the other, so it must not be turned. `mesh` must
    // say so: none of a union's triangles may count, because all lie within the final triangles of its children.
    if !mesh.is_collinear() {
        let least = hull.iter().enumerate().min_by_key(|&(_, id)| *id).map_or(0, |(place, _)| place);
        hull.rotate_left(least);
    }
    hull
}

/// The border of open triangles and a hull, whose places are in `points`. The points of the border keep their sequence,
/// so the triangles stay sorted, each with its smallest place first.
fn border<P: TilePoint, I: Copy>(
    points: &[P],
    ids: &[I],
    hull: &[u32],
    region: Region<P::Side>,
    mut open: Vec<[u32; 3]>,
) -> Border<P, I> {
    let mut places = vec![EMPTY; points.len()];
    for &place in open.as_flattened().iter().chain(hull) {
        places[place as usize] = 0;
    }
    let mut border = Border { region, points: Vec::new(), ids: Vec::new(), open: Vec::new() };
    for (slot, (&point, &id)) in places.iter_mut().zip(points.iter().zip(ids)) {
        if *slot != EMPTY {
            *slot = border.points.len() as u32;
            border.points.push(point);
            border.ids.push(id);
        }
    }
    for place in open.as_flattened_mut() {
        *place = places[*place as usize];
    }
    border.open = open;
    border
}
