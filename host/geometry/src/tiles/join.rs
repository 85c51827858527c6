//! The second step: the borders of neighbours become the border of one larger region.

use alloc::vec::Vec;
use core::num::NonZeroUsize;
use core::ops::ControlFlow;

use super::error::Error;
use super::local::{settle, Border, Tile};
use super::occupancy::Occupancy;
use super::reach::TilePoint;
use super::region::Region;
use crate::cpu;
use crate::mesh::Mesh;
use crate::point::{Point, MAX_POINTS};

/// The points of several borders, ready to be triangulated.
///
/// [`join`] does this step and the next on the CPU triangulator. Call both yourself to triangulate elsewhere, such as
/// on a device or on another machine:
/// 1. [`Union::of`] puts the borders together.
/// 2. Triangulate [`Union::points`].
/// 3. [`Union::settle`] takes that mesh and finds the final triangles.
#[derive(Clone, Debug)]
pub struct Union<P: TilePoint, I> {
    region: Region<P::Side>,
    points: Vec<P>,
    ids: Vec<I>,
    /// The open triangles of all children, as places in `points`, in canonical order.
    open: Vec<[u32; 3]>,
    /// For each child, the number of points of this child and those before it.
    ends: Vec<u32>,
}

impl<P: TilePoint, I: Copy + Ord> Union<P, I> {
    /// Puts the borders of regions together, to be joined into one region.
    ///
    /// `region` must cover the regions of all children, and the set must have no point in it that is not of a child.
    /// [`Region::union_of`] finds such a region for children that form a rectangle.
    ///
    /// # Errors
    /// [`Error::NotCovered`] or [`Error::Overlap`] if regions do not fit; [`Error::Ids`], [`Error::NoSuchPoint`] or
    /// [`Error::NotCanonical`] if the lists of a border do not fit; and [`Error::Triangulation`] if there are more than
    /// [`MAX_POINTS`] points.
    pub fn of(region: Region<P::Side>, children: Vec<Border<P, I>>) -> Result<Self, Error> {
        check_regions(&region, &children)?;
        let count = children.iter().map(|child| child.points.len()).sum();
        if count > MAX_POINTS {
            return Err(cpu::Error::TooManyPoints { points: count }.into());
        }
        let mut union = Self { region, points: Vec::new(), ids: Vec::new(), open: Vec::new(), ends: Vec::new() };
        union.points.reserve_exact(count);
        union.ids.reserve_exact(count);
        for child in children {
            check_lists(&child)?;
            let first = union.points.len() as u32;
            union.points.extend(child.points);
            union.ids.extend(child.ids);
            union.open.extend(child.open.iter().map(|triangle| triangle.map(|place| first + place)));
            union.ends.push(union.points.len() as u32);
        }
        Ok(union)
    }

    /// The points to triangulate, which are distinct.
    pub fn points(&self) -> &[P] {
        &self.points
    }

    /// Finds out which triangles of the joined region are final, given the canonical mesh of [`Union::points`].
    ///
    /// Of that mesh, the triangles count that have corners from two children, or that were open in their child. All
    /// others lie within the final triangles of a child. O(n), 10 to 20 ns a triangle.
    ///
    /// # Errors
    /// [`Error::NoSuchPoint`] if the mesh is that of more points.
    pub fn settle(&self, mesh: &Mesh<P>) -> Result<Tile<P, I>, Error> {
        self.settle_by(mesh, &|_| false)
    }

    fn settle_by(&self, mesh: &Mesh<P>, is_clear: &dyn Fn([P; 3]) -> bool) -> Result<Tile<P, I>, Error> {
        let child_of = |place: u32| self.ends.partition_point(|&end| end <= place);
        let mut open = self.open.iter().peekable();
        let counts = mesh.triangles.iter().copied().filter(|triangle| {
            let [a, b, c] = triangle.map(child_of);
            if a != b || b != c {
                return true;
            }
            // Both lists are sorted in the same order.
            while open.next_if(|before| *before < triangle).is_some() {}
            open.next_if_eq(&triangle).is_some()
        });
        settle((&self.points, &self.ids), mesh, self.region, counts, is_clear)
    }
}

impl<I: Copy + Ord> Union<Point, I> {
    /// Like [`Union::settle`], with more final triangles: also those whose disc touches no occupied cell beyond the
    /// joined region. `occupancy` must have all points of the whole set.
    ///
    /// # Errors
    /// [`Error::NoSuchPoint`] if the mesh is that of more points.
    pub fn settle_among(&self, mesh: &Mesh, occupancy: &Occupancy) -> Result<Tile<Point, I>, Error> {
        let beyond = occupancy.beyond(&self.region);
        self.settle_by(mesh, &|corners| beyond.is_clear(corners))
    }
}

/// Joins the borders of neighbouring regions on the CPU triangulator, on one thread.
///
/// The result is that of [`local`](super::local) for all points of the joined region, but only its border and what is
/// newly final. So joins are done again and again, up to the region [`Region::WHOLE`], where every triangle is final.
/// See [`Union::of`] for what `region` must be, and [the module](crate::tiles) for an example.
///
/// O(n) for borders of n points, 0.3 to 0.5 µs a point.
///
/// # Errors
/// Those of [`Union::of`].
pub fn join<P: TilePoint, I: Copy + Ord>(
    region: Region<P::Side>,
    children: Vec<Border<P, I>>,
) -> Result<Tile<P, I>, Error> {
    let (union, mesh) = joined(region, children)?;
    union.settle(&mesh)
}

/// Like [`join`], with more final triangles: also those whose disc touches no occupied cell beyond the joined region.
/// `occupancy` must have all points of the whole set.
///
/// Takes about 130 bytes a point of the borders, and frees the borders of the children.
///
/// # Errors
/// Those of [`Union::of`].
pub fn join_among<I: Copy + Ord>(
    region: Region,
    children: Vec<Border<Point, I>>,
    occupancy: &Occupancy,
) -> Result<Tile<Point, I>, Error> {
    let (union, mesh) = joined(region, children)?;
    union.settle_among(&mesh, occupancy)
}

/// Several borders as one union, and its mesh.
fn joined<P: TilePoint, I: Copy + Ord>(
    region: Region<P::Side>,
    children: Vec<Border<P, I>>,
) -> Result<(Union<P, I>, Mesh<P>), Error> {
    let mut union = Union::of(region, children)?;
    // The mesh takes the points and gives them back, so the memory holds them once.
    let points = core::mem::take(&mut union.points);
    let mut mesh = cpu::triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?;
    union.points = core::mem::take(&mut mesh.points);
    Ok((union, mesh))
}

/// Checks that the regions of children overlap nowhere and are covered by the region of the join.
fn check_regions<P: TilePoint, I>(region: &Region<P::Side>, children: &[Border<P, I>]) -> Result<(), Error> {
    for (child, border) in children.iter().enumerate() {
        if !region.covers(&border.region) {
            return Err(Error::NotCovered { child });
        }
        if let Some(one) = children[..child].iter().position(|other| other.region.overlaps(&border.region)) {
            return Err(Error::Overlap { one, other: child });
        }
    }
    Ok(())
}

/// Checks that the lists of a border fit together.
fn check_lists<P: TilePoint, I>(border: &Border<P, I>) -> Result<(), Error> {
    let points = border.points.len();
    if points != border.ids.len() {
        return Err(Error::Ids { points, ids: border.ids.len() });
    }
    if let Some(&place) = border.open.as_flattened().iter().find(|&&place| place as usize >= points) {
        return Err(Error::NoSuchPoint { place, points });
    }
    // `settle` compares this list with the triangles of the union in one pass, and would miss triangles out of order.
    let mut before = None;
    for (place, triangle) in border.open.iter().enumerate() {
        if before >= Some(triangle) || triangle[0] > triangle[1].min(triangle[2]) {
            return Err(Error::NotCanonical { place });
        }
        before = Some(triangle);
    }
    Ok(())
}
