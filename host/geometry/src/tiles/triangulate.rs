//! All steps in the memory of one process.

use alloc::vec::Vec;
use core::num::NonZeroUsize;

use super::error::Error;
use super::join::Union;
use super::local::{local, Border, Tile};
use super::tree::{Step, Tree};
use crate::cpu::{self, Triangulator};
use crate::mesh::Mesh;
use crate::order::z_curve::position;
use crate::point::{Duplicate, Point, MAX_POINTS};

/// Computes the canonical Delaunay triangulation of a set by tiles of at most `most` distinct points.
///
/// The mesh is the one of [`cpu::triangulate`], byte for byte, whatever `most` is. This function shows how the steps fit
/// together, and is not the fastest way to a mesh that fits the memory: that is [`cpu::triangulate`]. It works on one
/// thread, tile by tile. O(n log n), and about twice the time of [`cpu::triangulate`] for tiles of 8,192 points.
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
    let mut curve: Vec<(u64, u32)> = points.iter().map(|point| position(point.x, point.y)).zip(0..).collect();
    curve.sort_unstable();
    let positions: Vec<u64> = curve.iter().map(|&(position, _)| position).collect();
    let tree = Tree::of_positions(&positions, most);
    drop(positions);
    let mut work = Work::default();
    for step in tree.steps() {
        match step {
            Step::Tile { region, points: range } => {
                // In ascending order, so that each place goes by its lowest index.
                let mut ids: Vec<u32> = curve[range.clone()].iter().map(|&(_, id)| id).collect();
                ids.sort_unstable();
                let own: Vec<Point> = ids.iter().map(|&id| points[id as usize]).collect();
                work.triangulate(&own)?;
                let named = |duplicate: &Duplicate| {
                    let [index, of] = [duplicate.index, duplicate.of].map(|place| ids[place as usize]);
                    Duplicate { index, of }
                };
                work.duplicates.extend(work.mesh.duplicates.iter().map(named));
                let tile = local(&work.mesh, &ids, *region)?;
                work.keep(tile);
            }
            Step::Join { region, children } => {
                let first = work.borders.len().saturating_sub(*children);
                let union = Union::of(*region, work.borders.split_off(first))?;
                work.triangulate(union.points())?;
                let tile = union.settle(&work.mesh)?;
                work.keep(tile);
            }
        }
    }
    let Work { mut triangles, mut duplicates, hull, .. } = work;
    triangles.sort_unstable();
    duplicates.sort_unstable();
    Ok(Mesh { points, triangles, hull, duplicates })
}

/// What is there after some of the steps, and memory for the next one.
#[derive(Default)]
struct Work {
    triangulator: Triangulator,
    /// The triangulation of one tile or one union.
    mesh: Mesh,
    borders: Vec<Border<Point, u32>>,
    triangles: Vec<[u32; 3]>,
    duplicates: Vec<Duplicate>,
    /// The hull after the last step.
    hull: Vec<u32>,
}

impl Work {
    fn triangulate(&mut self, points: &[Point]) -> Result<(), Error> {
        Ok(self.triangulator.triangulate_into(points, &mut self.mesh)?)
    }

    fn keep(&mut self, tile: Tile<Point, u32>) {
        self.triangles.extend(tile.finals);
        self.borders.push(tile.border);
        self.hull = tile.hull;
    }
}
