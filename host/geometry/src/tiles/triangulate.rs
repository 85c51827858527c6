//! All steps in the memory of one process.

use alloc::vec::Vec;
use core::num::NonZeroUsize;

use bytemuck::Zeroable;

use super::error::Error;
use super::join::Union;
use super::local::{local, Border, Tile};
use super::region::Region;
use super::tree::{Step, Tree};
use crate::cpu::{self, Triangulator};
use crate::mesh::Mesh;
use crate::order::z_curve::position;
use crate::point::{Duplicate, Point, MAX_POINTS};
use crate::sort::{sort_by_key, Entry, Keyed, Wide};

/// Computes the canonical Delaunay triangulation of a set by tiles of at most `most` distinct points.
///
/// The mesh is the one of [`cpu::triangulate`], byte for byte, whatever `most` is. This function shows how the steps
/// fit together. It works on one thread, tile by tile, and takes O(n log n) at worst. A million even points in tiles of
/// 8,192 take about as long as [`cpu::triangulate`] does.
///
/// ```
/// use core::num::NonZeroUsize;
/// use core::ops::ControlFlow;
/// use incircle_geometry::{cpu, tiles, Point};
///
/// let points: Vec<Point> = (0..1000u32).map(|k| Point::new(k * k % 1009, k * 7919 % 1013)).collect();
/// let mesh = tiles::triangulate(points.clone(), NonZeroUsize::new(100).unwrap())?;
/// assert_eq!(mesh, cpu::triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))?);
/// # Ok::<(), tiles::Error>(())
/// ```
///
/// # Errors
/// There are more than [`MAX_POINTS`] points.
pub fn triangulate(points: Vec<Point>, most: NonZeroUsize) -> Result<Mesh, Error> {
    if points.len() > MAX_POINTS {
        return Err(cpu::Error::TooManyPoints { points: points.len() }.into());
    }
    let (tree, curve) = cut(&points, most);
    let mut work = Work::default();
    for step in tree.steps() {
        match step {
            Step::Tile { region, points: range } => work.tile(*region, &points, &curve[range.clone()])?,
            Step::Join { region, children } => work.join(*region, *children)?,
        }
    }
    let Work { mut triangles, mut duplicates, hull, .. } = work;
    sort_by_key(&mut triangles);
    duplicates.sort_unstable();
    let triangles = triangles.into_iter().map(|Triangle(corners)| corners).collect();
    Ok(Mesh { points, triangles, hull, duplicates })
}

/// The tree of a set, and the indices of its points along the curve. The sort is stable, so duplicates come in the
/// order of their indices, and the first of them stands for all.
fn cut(points: &[Point], most: NonZeroUsize) -> (Tree, Vec<u32>) {
    let mut entries: Vec<Wide> =
        points.iter().zip(0..).map(|(point, id)| Wide::new(position(point.x, point.y), id)).collect();
    sort_by_key(&mut entries);
    let positions: Vec<u64> = entries.iter().map(Keyed::key).collect();
    (Tree::of_positions(&positions, most), entries.iter().map(Entry::value).collect())
}

/// A final triangle. Its first two corners are the key: each directed edge has one triangle on its left.
#[derive(Clone, Copy, Zeroable)]
struct Triangle([u32; 3]);

impl Keyed for Triangle {
    fn key(&self) -> u64 {
        u64::from(self.0[0]) << u32::BITS | u64::from(self.0[1])
    }
}

/// The results of the steps so far, and memory for the next one.
#[derive(Default)]
struct Work {
    triangulator: Triangulator,
    /// The triangulation of one tile or one union.
    mesh: Mesh,
    borders: Vec<Border<Point, u32>>,
    triangles: Vec<Triangle>,
    duplicates: Vec<Duplicate>,
    /// The hull after the last step.
    hull: Vec<u32>,
}

impl Work {
    fn tile(&mut self, region: Region, points: &[Point], ids: &[u32]) -> Result<(), Error> {
        let own: Vec<Point> = ids.iter().map(|&id| points[id as usize]).collect();
        self.triangulator.triangulate_into(&own, &mut self.mesh)?;
        self.duplicates.extend(self.mesh.duplicates.iter().map(|duplicate| {
            let [index, of] = [duplicate.index, duplicate.of].map(|place| ids[place as usize]);
            Duplicate { index, of }
        }));
        let tile = local(&self.mesh, ids, region)?;
        self.keep(tile);
        Ok(())
    }

    /// Joins the borders that were put onto the stack last.
    fn join(&mut self, region: Region, children: usize) -> Result<(), Error> {
        let first = self.borders.len().saturating_sub(children);
        let union = Union::of(region, self.borders.split_off(first))?;
        self.triangulator.triangulate_into(union.points(), &mut self.mesh)?;
        let tile = union.settle(&self.mesh)?;
        self.keep(tile);
        Ok(())
    }

    fn keep(&mut self, tile: Tile<Point, u32>) {
        self.triangles.extend(tile.finals.into_iter().map(Triangle));
        self.borders.push(tile.border);
        self.hull = tile.hull;
    }
}
