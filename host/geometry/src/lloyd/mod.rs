//! Lloyd's relaxation: every point moves to the centroid of its Voronoi cell, again and again, until points are spread
//! evenly.
//!
//! **Why every machine gives the same bits.** A step rounds at two places, both by integer division. A corner of a cell
//! as seen from its point is the fraction `(x / d, y / d)`, and becomes `floor(x 2^8 / d)`, and the same for y. Area
//! and moments of the polygon of these integers are integers, too, and are summed exactly. Their quotient is rounded to
//! the nearest grid point, halves upwards. So the new place of a point depends on its clipped cell alone, which is
//! exact and canonical, and neither threads nor the order of the points can change it.
//!
//! **Where mass counts.** With a [`Density`], an image over the rectangle around the clip, points move to the centre of
//! mass of their cells. Borders of cells are cut at the borders of pixels, and each cut becomes integers by division,
//! too; the mass and the moments of what lies between are integers.
//!
//! **How exact it is.** Each corner is off by less than `2^-8` of a step of the grid, and the centroid of a cell that
//! is many steps wide by about as much. Points move to grid points, so give them a grid with spare bits: multiply the
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

mod centroid;
mod density;
mod error;
mod quotient;
mod stars;
mod step;
mod weigh;

use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use core::num::NonZeroUsize;

use crate::order::{hilbert, mix};
use crate::point::Point;
use crate::voronoi::Clip;

pub use density::{Density, DensityError};
pub use error::Error;
pub use step::{step, weighted_step};

/// The conditions under which a relaxation ends. It also ends after a step in which no point moved, for all further
/// steps would do the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stop {
    /// The most steps.
    pub iterations: u32,
    /// Whether the relaxation also ends after a step that led to a state that was there before.
    pub when_still: bool,
}

/// The reason why a relaxation ended.
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
    /// The reason why the relaxation ended.
    pub end: End,
}

/// Relaxes points inside a clip, on at most `threads` threads. Points at one place move together. A point whose cell
/// has no area in the clip stays where it is.
///
/// A step makes the mesh of the points and takes O(n) more; only cells near the border of the clip are cut.
///
/// # Errors
/// A coordinate has more than 31 bits, or there are too many points.
pub fn relax(points: Vec<Point>, clip: &Clip, stop: Stop, threads: NonZeroUsize) -> Result<Relaxed, Error> {
    repeat(points, stop, |points| step(points, clip, threads))
}

/// Relaxes points inside a clip over which mass is spread: every point moves to the centre of mass of its cell, so
/// points gather where the density is high. A point whose cell has no mass stays where it is. Everything else is as in
/// [`relax`]; a step also takes time for each pixel that a border between cells crosses.
///
/// # Errors
/// As those of [`relax`], and the density was made for another clip.
pub fn relax_weighted(
    points: Vec<Point>,
    clip: &Clip,
    density: &Density,
    stop: Stop,
    threads: NonZeroUsize,
) -> Result<Relaxed, Error> {
    repeat(points, stop, |points| weighted_step(points, clip, density, threads))
}

/// Repeats a step of the caller until the end. The first error of a step ends the relaxation, so a step may also end
/// the work because somebody asks for that.
///
/// `step` gets the points in an order in which near ones stand near one another, and must give the new place of each,
/// in the same order. The new places must depend on the old ones alone, because the work ends after a step in which no
/// point moves. The result has the points in the order of `points` again.
///
/// ```
/// use core::num::NonZeroUsize;
/// use incircle_geometry::lloyd::{repeat, step, Stop};
/// use incircle_geometry::voronoi::Clip;
/// use incircle_geometry::Point;
///
/// let points = [(100, 100), (200, 900), (900, 500)].map(Point::from).to_vec();
/// let clip = Clip::rectangle(Point::new(0, 0), Point::new(1000, 1000))?;
/// let mut patience = 3;
/// let stopped = repeat(points, Stop { iterations: 1000, when_still: false }, |points| {
///     patience -= 1;
///     if patience < 0 {
///         return Err("somebody waits");
///     }
///     step(points, &clip, NonZeroUsize::MIN).map_err(|_| "no cells")
/// });
/// assert_eq!(stopped, Err("somebody waits"));
/// # Ok::<(), incircle_geometry::lloyd::Error>(())
/// ```
///
/// # Errors
/// Those of `step`.
pub fn repeat<E>(
    points: Vec<Point>,
    stop: Stop,
    mut step: impl FnMut(&[Point]) -> Result<Vec<Point>, E>,
) -> Result<Relaxed, E> {
    // Points near one another stand near one another in the lists of each step.
    let order = hilbert(&points);
    let mut now: Vec<Point> = order.iter().map(|&index| points[index as usize]).collect();
    let mut known = BTreeSet::from([hash(&now)]);
    let mut result = Relaxed { points, iterations: 0, moved: 0, end: End::Iterations };
    while result.iterations < stop.iterations {
        let next = step(&now)?;
        result.iterations += 1;
        result.moved = now.iter().zip(&next).filter(|(one, other)| one != other).count();
        now = next;
        if result.moved == 0 {
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

#[cfg(test)]
mod tests;
