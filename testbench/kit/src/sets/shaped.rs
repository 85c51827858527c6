//! Sets of a fixed shape, shuffled.

use super::grid::{room, Grid, Points};
use crate::random::SplitMix64;

/// Average number of copies of each point of a box.
const BOX_COPIES: usize = 4;
/// Distance of neighbours on the spiral over the distance of its arms.
const SPIRAL_STEP: f64 = 0.25;

/// A square lattice as wide as the grid allows, filled row by row: every square of neighbours is cocircular.
pub fn lattice(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    let columns = side_of(n).min(grid.size);
    let step = ((grid.size - 1) / (columns - 1).max(1)).max(1);
    let place = |index: u64| [index % columns * step, index / columns % columns * step];
    shuffled(n, place, random)
}

/// A square lattice turned by the Gaussian integer 2 + i, times the largest step that fits: (i, j) becomes (2 i - j,
/// i + 2 j). The turn is exact, so every square of neighbours is cocircular, but no two of its corners share a
/// coordinate. Where the grid is too small for n points they repeat.
pub fn rotated_lattice(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    // A lattice of c columns spans 3 (c - 1) steps in both directions.
    let columns = side_of(n).min((grid.size - 1) / 3 + 1);
    let last = columns - 1;
    let step = ((grid.size - 1) / (3 * last).max(1)).max(1);
    let place = |index: u64| {
        let (i, j) = (index % columns, index / columns % columns);
        [(2 * i + last - j) * step, (i + 2 * j) * step]
    };
    shuffled(n, place, random)
}

/// On y = x² / (2^bits - 1), x evenly spaced: every point is on the hull (up to rounding), and triangles
/// are long and thin.
pub fn parabola(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    let last = grid.size - 1;
    let place = |index: u64| {
        let x = spread(index, n as u64, last);
        [x, x * x / last]
    };
    shuffled(n, place, random)
}

/// The same parabola mirrored: a Hilbert curve over an even number of bits ends in the lower right corner, at the
/// vertex. A point nearer to the vertex than all before it lies in the circles of all their triangles, so tests and
/// cavities along the curve grow with n.
pub fn parabola_inward(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    let mut points = parabola(n, grid, random)?;
    let last = (grid.size - 1) as u32;
    points.iter_mut().for_each(|[x, _]| *x = last - *x);
    Ok(points)
}

/// Two chains of n/2 points, arcs of parabolas that bulge towards each other across the middle of the grid. Every point
/// sees the whole other chain, so a point between them has a cavity of n triangles: the classic worst case of flips.
pub fn two_chains(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    let last = grid.size - 1;
    let lower = n as u64 / 2;
    let place = |index: u64| {
        let (rank, count) = match index.checked_sub(lower) {
            Some(rank) => (rank, n as u64 - lower),
            None => (index, lower),
        };
        let x = spread(rank, count, last);
        // 0 at the ends of a chain, a quarter of the side in its middle.
        let rise = u128::from(x) * u128::from(last - x) / u128::from(last);
        let y = last / 8 + rise as u64;
        [x, if index < lower { y } else { last - y }]
    };
    shuffled(n, place, random)
}

/// Points on an Archimedean spiral, evenly spaced along it; neighbours are a quarter as far apart as the arms.
pub fn spiral(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    let centre = grid.half() - 0.5;
    // With arms 1 apart, r = a / TAU at angle a and the length to there is about a² / (2 TAU).
    let angle = |index: f64| libm::sqrt(2.0 * std::f64::consts::TAU * SPIRAL_STEP * index);
    let scale = centre / angle(n as f64).max(1.0);
    let place = |index: u64| {
        let angle = angle(index as f64);
        let radius = angle * scale;
        let [x, y] = grid.nearest(centre + radius * libm::cos(angle), centre + radius * libm::sin(angle));
        [x.into(), y.into()]
    };
    shuffled(n, place, random)
}

/// Every point of a square box in the middle of the grid, each about four times: all ties and many duplicates.
pub fn filled_box(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    let side = (n / BOX_COPIES).isqrt().max(1) as u64;
    let side = side.min(grid.size);
    let corner = (grid.size - side) / 2;
    let place = |index: u64| [corner + index % side, corner + index / side % side];
    shuffled(n, place, random)
}

/// Number of columns of the smallest square of at least `n` points, at least 1.
fn side_of(n: usize) -> u64 {
    let below = n.isqrt();
    let side = if below * below < n { below + 1 } else { below };
    side.max(1) as u64
}

/// Place `index` of `count` evenly spaced whole numbers from 0 to `last`.
fn spread(index: u64, count: u64, last: u64) -> u64 {
    let intervals = u128::from(count.saturating_sub(1).max(1));
    (u128::from(index) * u128::from(last) / intervals) as u64
}

/// Returns the places of `0..n` in random order. All coordinates are below 2^31 by construction.
fn shuffled(n: usize, place: impl Fn(u64) -> [u64; 2], random: &mut SplitMix64) -> Points {
    let mut points = room(n)?;
    points.extend((0..n as u64).map(|index| place(index).map(|value| value as u32)));
    random.shuffle(&mut points);
    Ok(points)
}
