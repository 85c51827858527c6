//! Sets that are samples of a distribution.
//!
//! The first five are those of G. E. Blelloch, G. L. Miller, D. Talmor, "Developing a practical projection-based
//! parallel Delaunay algorithm", SCG 1996 (uniform, normal, Kuzmin, line singularity), and of K. Buchin, "Constructing
//! Delaunay triangulations along space-filling curves", ESA 2009, and O. Schrijvers, F. van Bommel, K.
//! Buchin, EuroCG 2012 (checkers).

use super::grid::{room, Grid, Points};
use crate::random::SplitMix64;

/// Standard deviations from the centre of the grid to its sides.
const NORMAL_DEVIATIONS: f64 = 4.0;
/// Number of Kuzmin's length units in half a side of the grid.
const KUZMIN_UNITS: f64 = 32.0;
/// The parameter `b` of the line singularity: the share of the plane next to the line that is left out.
const LINE_OFFSET: f64 = 0.001;
/// Squares along a side of the chequered board, as on a chess board.
const BOARD: u64 = 8;
/// Average number of points of a cluster.
const CLUSTER_POINTS: usize = 100;
/// Number of standard deviations of a cluster along a side of the grid.
const CLUSTER_DEVIATIONS: f64 = 200.0;

/// Points of which every grid point has an equal chance.
pub fn uniform(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    repeat(n, || Some(anywhere(grid, random)))
}

/// Independent Gaussian coordinates around the centre; the sides are four standard deviations away. A point
/// outside is drawn anew.
pub fn normal(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    let deviation = grid.half() / NORMAL_DEVIATIONS;
    repeat(n, || {
        let [x, y] = random.normal_pair();
        grid.cell(grid.half() + x * deviation, grid.half() + y * deviation)
    })
}

/// Kuzmin's disc, a model of flat galaxies: the share of points within radius r is 1 - 1 / sqrt(1 + r²), so r = sqrt(1
/// / (1 - u)² - 1) for uniform u. The sides are 32 units away; the few points outside are drawn anew.
pub fn kuzmin(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    let unit = grid.half() / KUZMIN_UNITS;
    repeat(n, || {
        let outside = 1.0 - random.unit();
        let radius = unit * libm::sqrt(1.0 / (outside * outside) - 1.0);
        let angle = std::f64::consts::TAU * random.unit();
        grid.cell(grid.half() + radius * libm::cos(angle), grid.half() + radius * libm::sin(angle))
    })
}

/// The line singularity: x = b / (u - b u + b), y = v for uniform u, v and b = 0.001. Density falls with the square of
/// the distance from the left side.
pub fn line(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    let size = grid.size as f64;
    repeat(n, || {
        let (u, v) = (random.unit(), random.unit());
        let x = LINE_OFFSET / (u - LINE_OFFSET * u + LINE_OFFSET);
        // u = 0 gives x = 1, just outside.
        grid.cell(x * size, v * size)
    })
}

/// Every eighth point anywhere on the white squares of a chess board, the others on the black ones; the square at the
/// origin is black. Boards of fewer than 8 grid points a side have fewer squares.
pub fn checkers(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    let squares = BOARD.min(grid.size);
    let side = grid.size / squares;
    let one = |random: &mut SplitMix64| {
        let white = random.below(8) == 0;
        let row = random.below(squares);
        let column = 2 * random.below(squares / 2) + (row + u64::from(white)) % 2;
        let [x, y] = [column * side + random.below(side), row * side + random.below(side)];
        [x as u32, y as u32]
    };
    repeat(n, || Some(one(random)))
}

/// The grid points next to random places of the circle that touches the sides: they are nearly cocircular, so
/// `incircle` is near zero everywhere.
pub fn circle(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    let centre = grid.half() - 0.5;
    let one = |random: &mut SplitMix64| {
        let angle = std::f64::consts::TAU * random.unit();
        grid.nearest(centre + centre * libm::cos(angle), centre + centre * libm::sin(angle))
    };
    repeat(n, || Some(one(random)))
}

/// Gaussian clusters around uniform centres, a hundred points each on average; a standard deviation is 1/200 of a side.
/// Points outside the grid are drawn anew.
pub fn clusters(n: usize, grid: Grid, random: &mut SplitMix64) -> Points {
    let count = n.div_ceil(CLUSTER_POINTS);
    let centres = repeat(count, || Some(anywhere(grid, random)))?;
    let deviation = grid.size as f64 / CLUSTER_DEVIATIONS;
    repeat(n, || {
        let [x, y] = centres[random.below(count as u64) as usize];
        let [dx, dy] = random.normal_pair();
        grid.cell(f64::from(x) + 0.5 + dx * deviation, f64::from(y) + 0.5 + dy * deviation)
    })
}

fn anywhere(grid: Grid, random: &mut SplitMix64) -> [u32; 2] {
    [random.below(grid.size) as u32, random.below(grid.size) as u32]
}

/// Draws until `n` points lie inside the grid. Every distribution here has at least a quarter of its mass inside,
/// so the loop ends.
fn repeat(n: usize, mut draw: impl FnMut() -> Option<[u32; 2]>) -> Points {
    let mut points = room(n)?;
    points.extend(std::iter::from_fn(|| Some(draw())).flatten().take(n));
    Ok(points)
}
