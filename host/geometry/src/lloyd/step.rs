//! One step of a relaxation.
//!
//! Cells that the border of the clip does not come near are taken from the mesh itself: the centres of the triangles
//! around a point, as integers, are the corners of its cell. Triangles with one centre give the same integers, so it
//! does not matter which diagonals a circle of four points has: an edge of length zero adds nothing to any sum. The
//! other cells, few in number, are cut from the clip.

use alloc::vec::Vec;
use core::num::NonZeroUsize;
use core::ops::ControlFlow;

use super::centroid::{Sums, BITS};
use super::density::{Density, DensityError};
use super::error::Error;
use super::quotient::floor_quotient;
use super::stars::{Star, Stars};
use super::weigh::Masses;
use crate::cpu::{self, in_parallel};
use crate::mesh::Mesh;
use crate::point::{Point, MAX_COORD_BITS};
use crate::voronoi::{self, Clip, ClippedCell, Clipper, Corner};

/// Points that justify one more thread.
const THREAD_POINTS: usize = 4096;

/// Moves every point to the centroid of its clipped cell, rounded to the grid. See [`relax`](super::relax).
///
/// # Errors
/// As those of [`relax`](super::relax).
pub fn step(points: &[Point], clip: &Clip, threads: NonZeroUsize) -> Result<Vec<Point>, Error> {
    step_in(points, clip, None, threads)
}

/// Moves every point to the centre of mass of its clipped cell, rounded to the grid. See
/// [`relax_weighted`](super::relax_weighted).
///
/// # Errors
/// As those of [`relax_weighted`](super::relax_weighted).
pub fn weighted_step(
    points: &[Point],
    clip: &Clip,
    density: &Density,
    threads: NonZeroUsize,
) -> Result<Vec<Point>, Error> {
    if density.bounds() != clip.bounds() {
        return Err(DensityError::OtherClip.into());
    }
    step_in(points, clip, Some(density), threads)
}

fn step_in(
    points: &[Point],
    clip: &Clip,
    density: Option<&Density>,
    threads: NonZeroUsize,
) -> Result<Vec<Point>, Error> {
    let is_wide = |point: &Point| (point.x | point.y) >> MAX_COORD_BITS != 0;
    if let Some(index) = points.iter().position(is_wide) {
        return Err(voronoi::Error::CoordinateOutOfRange { index, point: points[index] }.into());
    }
    let mesh = cpu::triangulate(points.to_vec(), threads, &mut |_| ControlFlow::Continue(()))?;
    let threads = threads.get().min(points.len() / THREAD_POINTS + 1);
    let stars = Stars::of(&mesh.points, &mesh.triangles, threads);
    let line = if mesh.is_collinear() { beside_on_line(&mesh) } else { Vec::new() };
    let mut next = points.to_vec();
    let share = points.len().div_ceil(threads).max(1);
    in_parallel(next.chunks_mut(share).enumerate(), |(part, next)| {
        let mut mover = Mover::new(&mesh.points, clip, density);
        for (place, point) in next.iter_mut().enumerate() {
            let index = part * share + place;
            *point = match line.get(index) {
                Some(beside) => mover.cut(index as u32, beside.iter().flatten().copied()),
                None => mover.moved(index as u32, &stars),
            };
        }
    });
    for duplicate in &mesh.duplicates {
        next[duplicate.index as usize] = next[duplicate.of as usize];
    }
    Ok(next)
}

/// The points before and behind each of the points on one line.
fn beside_on_line(mesh: &Mesh<Point>) -> Vec<[Option<u32>; 2]> {
    let mut beside = alloc::vec![[None; 2]; mesh.points.len()];
    for pair in mesh.hull.windows(2) {
        beside[pair[0] as usize][0] = Some(pair[1]);
        beside[pair[1] as usize][1] = Some(pair[0]);
    }
    beside
}

/// Moves points one after the other, in memory that is used again.
struct Mover<'a> {
    points: &'a [Point],
    clip: &'a Clip,
    density: Option<&'a Density>,
    clipper: Clipper<'a>,
    star: Star,
    ring: Vec<[i64; 2]>,
}

impl<'a> Mover<'a> {
    fn new(points: &'a [Point], clip: &'a Clip, density: Option<&'a Density>) -> Self {
        Self { points, clip, density, clipper: Clipper::new(points, clip), star: Star::default(), ring: Vec::new() }
    }

    /// The new place of a point of a mesh with triangles. A duplicate has no star; its place is put right later.
    fn moved(&mut self, index: u32, stars: &Stars<'_>) -> Point {
        let point = self.points[index as usize];
        let is_closed = stars.star(index, &mut self.star);
        if self.star.neighbors.is_empty() {
            return point;
        }
        if is_closed && self.is_clear() {
            return if self.clip.contains(point) { self.whole(point) } else { point };
        }
        let neighbors = core::mem::take(&mut self.star.neighbors);
        let place = self.cut(index, neighbors.iter().copied());
        self.star.neighbors = neighbors;
        place
    }

    /// Whether the border of the clip surely does not come near the cell of the star.
    fn is_clear(&self) -> bool {
        let (mut low, mut high) = ([i64::MAX; 2], [i64::MIN; 2]);
        for center in &self.star.centers {
            for axis in 0..2 {
                low[axis] = low[axis].min(center[axis]);
                high[axis] = high[axis].max(center[axis]);
            }
        }
        // Centres that were cut off lie so far out that a cell with a point inside the clip touches its border.
        let step = |value: i64, margin: f64| (value >> BITS) as f64 + margin;
        !self.clip.may_touch(low.map(|value| step(value, -1.0)), high.map(|value| step(value, 2.0)))
    }

    /// The new place of a point whose cell the clip does not cut.
    fn whole(&mut self, point: Point) -> Point {
        let origin = [point.x, point.y].map(|value| i64::from(value) << BITS);
        self.ring.clear();
        self.ring.extend(self.star.centers.iter().map(|center| [center[0] - origin[0], center[1] - origin[1]]));
        match self.density {
            Some(density) => {
                let mut masses = Masses::new(density, point);
                masses.add(&self.ring);
                masses.center()
            }
            None => {
                let mut sums = Sums::new();
                sums.add(&self.ring);
                sums.centroid(point)
            }
        }
    }

    /// The new place of any point with these neighbours.
    fn cut(&mut self, index: u32, neighbors: impl Iterator<Item = u32>) -> Point {
        let point = self.points[index as usize];
        self.clipper.clear();
        self.clipper.cut(point, neighbors);
        let cell = self.clipper.cell(point, index);
        match self.density {
            Some(density) => {
                let mut masses = Masses::new(density, point);
                each_ring(cell, point, &mut self.ring, |ring| masses.add(ring));
                masses.center()
            }
            None => {
                let mut sums = Sums::new();
                each_ring(cell, point, &mut self.ring, |ring| sums.add(ring));
                sums.centroid(point)
            }
        }
    }
}

/// Calls `add` with the corners of each ring of a cell, as seen from its point. Holes turn the other way, so they take
/// away.
fn each_ring(cell: ClippedCell<'_>, point: Point, ring: &mut Vec<[i64; 2]>, mut add: impl FnMut(&[[i64; 2]])) {
    for border in cell.rings() {
        ring.clear();
        ring.extend(border.corners().map(|(corner, _)| seen(corner, point)));
        add(ring);
    }
}

/// A corner as seen from the point, in 2^-8 of a step, rounded down. At most 40 bits inside the grid.
fn seen(corner: Corner, point: Point) -> [i64; 2] {
    let d = i128::from(corner.d);
    let down = |n: i128, value: u32| floor_quotient((n - i128::from(value) * d) << BITS, d) as i64;
    [down(corner.x, point.x), down(corner.y, point.y)]
}
