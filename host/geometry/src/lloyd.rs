//! Lloyd's relaxation: every point moves to the centroid of its Voronoi cell, again and again, until points are spread
//! evenly.
//!
//! **Why every machine gives the same bits.** A step rounds at two places, both by integer division. A corner of a cell
//! as seen from its point is the fraction `(x / d, y / d)`, and becomes `floor(x 2^8 / d)`, and the same for y. Area and
//! moments of the polygon of these integers are integers, too, and are summed exactly. Their quotient is rounded to the
//! nearest grid point, halves upwards. So the new place of a point depends on its clipped cell alone, which is exact and
//! canonical, and neither threads nor the order of the points can change it.
//!
//! **How exact it is.** Each corner is off by less than `2^-8` of a step of the grid, and the centroid of a cell that is
//! many steps wide by about as much. Points move to grid points, so give them a grid with spare bits: multiply the
//! coordinates by a power of two.
//!
//! ```
//! use core::num::NonZeroUsize;
//! use incircle_geometry::lloyd::{relax, End, Stop};
//! use incircle_geometry::voronoi::Clip;
//! use incircle_geometry::Point;
//!
//! let points = [(100, 100), (200, 900), (900, 500)].map(Point::from).to_vec();
//! let clip = Clip::rectangle(Point::new(0, 0), Point::new(1000, 1000))?;
//! let still = relax(points, &clip, Stop { iterations: 1000, when_still: true }, NonZeroUsize::MIN)?;
//! assert_eq!(still.end, End::Still);
//! # Ok::<(), incircle_geometry::lloyd::Error>(())
//! ```

use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use core::num::NonZeroUsize;
use core::ops::ControlFlow;

use crate::cpu::{self, in_parallel};
use crate::order::{hilbert, mix};
use crate::point::Point;
use crate::voronoi::{self, Cells, Clip, ClippedCell, Corner, Voronoi};

/// Bits behind the point of a corner.
const BITS: u32 = 8;
/// Points that justify one more thread.
const THREAD_POINTS: usize = 4096;

/// The reasons why points cannot be relaxed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The points have no mesh.
    #[error(transparent)]
    Mesh(#[from] cpu::Error),
    /// The points or the clip have no cells.
    #[error(transparent)]
    Cells(#[from] voronoi::Error),
}

/// When a relaxation ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stop {
    /// The most steps.
    pub iterations: u32,
    /// Whether the relaxation also ends after a step in which no point moved, or that led to a state that was there
    /// before.
    pub when_still: bool,
}

/// Why a relaxation ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum End {
    /// All steps were done.
    Iterations,
    /// No point moved in the last step.
    Still,
    /// A state came again: points would go round for ever. States are told apart by 64 bits of a hash.
    Cycle,
}

/// The result of a relaxation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Relaxed {
    /// The points in the order in which they were given.
    pub points: Vec<Point>,
    /// The steps that were done, the last one included.
    pub iterations: u32,
    /// The points that moved in the last step.
    pub moved: usize,
    /// Why the relaxation ended.
    pub end: End,
}

/// Relaxes points inside a clip, on at most `threads` threads. Points at one place move together. A point whose cell has
/// no area in the clip stays where it is.
///
/// A step makes the mesh of the points and clips all cells.
///
/// # Errors
/// A coordinate has more than 31 bits, or there are too many points.
pub fn relax(points: Vec<Point>, clip: &Clip, stop: Stop, threads: NonZeroUsize) -> Result<Relaxed, Error> {
    // Points near one another stand near one another in the lists of each step.
    let order = hilbert(&points);
    let mut now: Vec<Point> = order.iter().map(|&index| points[index as usize]).collect();
    let mut known = BTreeSet::from([hash(&now)]);
    let mut result = Relaxed { points, iterations: 0, moved: 0, end: End::Iterations };
    while result.iterations < stop.iterations {
        let next = step(&now, clip, threads)?;
        result.iterations += 1;
        result.moved = now.iter().zip(&next).filter(|(one, other)| one != other).count();
        now = next;
        if stop.when_still && result.moved == 0 {
            result.end = End::Still;
            break;
        }
        if stop.when_still && !known.insert(hash(&now)) {
            result.end = End::Cycle;
            break;
        }
    }
    order.iter().zip(&now).for_each(|(&index, &point)| result.points[index as usize] = point);
    Ok(result)
}

/// A number that tells states apart.
fn hash(points: &[Point]) -> u64 {
    points.iter().fold(0, |sum, point| mix(sum ^ (u64::from(point.x) << 32 | u64::from(point.y))))
}

/// Moves every point to the centroid of its clipped cell, rounded to the grid. See [`relax`].
///
/// # Errors
/// As those of [`relax`].
pub fn step(points: &[Point], clip: &Clip, threads: NonZeroUsize) -> Result<Vec<Point>, Error> {
    let mesh = cpu::triangulate(points.to_vec(), threads, &mut |_| ControlFlow::Continue(()))?;
    let voronoi = Voronoi::of(&mesh)?;
    let mut next = points.to_vec();
    let threads = threads.get().min(points.len() / THREAD_POINTS + 1);
    let share = points.len().div_ceil(threads).max(1);
    in_parallel(next.chunks_mut(share).enumerate(), |(part, next)| {
        let mut cells = Cells::new(&voronoi, clip);
        for (place, point) in next.iter_mut().enumerate() {
            let index = part * share + place;
            *point = centroid(&cells.cell(index as u32), *point);
        }
    });
    for duplicate in &mesh.duplicates {
        next[duplicate.index as usize] = next[duplicate.of as usize];
    }
    Ok(next)
}

/// The grid point nearest to the centroid of a cell; the point itself if the cell has no area.
fn centroid(cell: &ClippedCell<'_>, point: Point) -> Point {
    let (mut area, mut moments) = (0i128, [0i128; 2]);
    let (mut low, mut high) = ([i128::MAX; 2], [i128::MIN; 2]);
    for piece in cell.pieces() {
        let (mut first, mut from) = (None, [0i128; 2]);
        for (corner, _) in piece.corners() {
            let to = seen(corner, point);
            for axis in 0..2 {
                low[axis] = low[axis].min(to[axis]);
                high[axis] = high[axis].max(to[axis]);
            }
            if first.is_some() {
                add(from, to, &mut area, &mut moments);
            }
            first.get_or_insert(to);
            from = to;
        }
        add(from, first.unwrap_or(from), &mut area, &mut moments);
    }
    if area <= 0 {
        return point;
    }
    // Three times the area, in units of a grid step.
    let divisor = (3 * area) << BITS;
    let round = |value: i128| (value + (1 << (BITS - 1))) >> BITS;
    let moved = |value: u32, axis: usize| {
        let offset = (2 * moments[axis] + divisor).div_euclid(2 * divisor);
        // The rounded corners of a cell that is thinner than a share of a step can have a centroid outside their box.
        let inside = offset.clamp(round(low[axis]), round(high[axis]));
        (i128::from(value) + inside).clamp(0, (1 << 31) - 1) as u32
    };
    Point::new(moved(point.x, 0), moved(point.y, 1))
}

/// A corner as seen from the point, in 2^-8 of a step, rounded down. At most 40 bits inside the grid.
fn seen(corner: Corner, point: Point) -> [i128; 2] {
    let d = i128::from(corner.d);
    let down = |numerator: i128, value: u32| ((numerator - i128::from(value) * d) << BITS).div_euclid(d);
    [down(corner.x, point.x), down(corner.y, point.y)]
}

/// Adds the triangle of the point and an edge: twice its area, and six times its moments. Sums of many edges may wrap;
/// the last sums do not, because the area has at most 80 bits and each moment at most 122.
fn add(from: [i128; 2], to: [i128; 2], area: &mut i128, moments: &mut [i128; 2]) {
    let twice = from[0] * to[1] - from[1] * to[0];
    *area = area.wrapping_add(twice);
    for axis in 0..2 {
        moments[axis] = moments[axis].wrapping_add((from[axis] + to[axis]).wrapping_mul(twice));
    }
}

#[cfg(test)]
mod tests;
