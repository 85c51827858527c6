//! Sets that are samples of a distribution.
//!
//! The first five are those of G. E. Blelloch, G. L. Miller, D. Talmor, "Developing a practical projection-based
//! parallel Delaunay algorithm", SCG 1996 (uniform, normal, Kuzmin, line singularity), and of K. Buchin, "Constructing
//! Delaunay triangulations along space-filling curves", ESA 2009, and O. Schrijvers, F. van Bommel, K.
//! Buchin, EuroCG 2012 (checkers).

use super::grid::{room, GenerateError, Grid};
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

/// Draws a point of a set; `None` for one outside the grid, which is to be drawn anew. Every distribution here has at
/// least a quarter of its mass inside, so drawing ends.
pub type Draw = Box<dyn FnMut(&mut SplitMix64) -> Option<[u32; 2]>>;

/// Points of which every grid point has an equal chance.
pub fn uniform(grid: Grid) -> Draw {
    Box::new(move |random| Some(anywhere(grid, random)))
}

/// Independent Gaussian coordinates around the centre; the sides are four standard deviations away. A point
/// outside is drawn anew.
pub fn normal(grid: Grid) -> Draw {
    let deviation = grid.half() / NORMAL_DEVIATIONS;
    Box::new(move |random| {
        let [x, y] = random.normal_pair();
        grid.cell(grid.half() + x * deviation, grid.half() + y * deviation)
    })
}

/// Kuzmin's disc, a model of flat galaxies: the share of points within radius r is 1 - 1 / sqrt(1 + r²), so r = sqrt(1
/// / (1 - u)² - 1) for uniform u. The sides are 32 units away; the few points outside are drawn anew.
pub fn kuzmin(grid: Grid) -> Draw {
    let unit = grid.half() / KUZMIN_UNITS;
    Box::new(move |random| {
        let outside = 1.0 - random.unit();
        let radius = unit * libm::sqrt(1.0 / (outside * outside) - 1.0);
        let angle = std::f64::consts::TAU * random.unit();
        grid.cell(grid.half() + radius * libm::cos(angle), grid.half() + radius * libm::sin(angle))
    })
}

/// The line singularity: x = b / (u - b u + b), y = v for uniform u, v and b = 0.001. Density falls with the square of
/// the distance from the left side.
pub fn line(grid: Grid) -> Draw {
    let size = grid.size as f64;
    Box::new(move |random| {
        let (u, v) = (random.unit(), random.unit());
        let x = LINE_OFFSET / (u - LINE_OFFSET * u + LINE_OFFSET);
        // u = 0 gives x = 1, just outside.
        grid.cell(x * size, v * size)
    })
}

/// Every eighth point anywhere on the white squares of a chess board, the others on the black ones; the square at the
/// origin is black. Boards of fewer than 8 grid points a side have fewer squares.
pub fn checkers(grid: Grid) -> Draw {
    let squares = BOARD.min(grid.size);
    let side = grid.size / squares;
    let one = move |random: &mut SplitMix64| {
        let white = random.below(8) == 0;
        let row = random.below(squares);
        let column = 2 * random.below(squares / 2) + (row + u64::from(white)) % 2;
        let [x, y] = [column * side + random.below(side), row * side + random.below(side)];
        [x as u32, y as u32]
    };
    Box::new(move |random| Some(one(random)))
}

/// The grid points next to random places of the circle that touches the sides: they are nearly cocircular, so
/// `incircle` is near zero everywhere.
pub fn circle(grid: Grid) -> Draw {
    let centre = grid.half() - 0.5;
    let one = move |random: &mut SplitMix64| {
        let angle = std::f64::consts::TAU * random.unit();
        grid.nearest(centre + centre * libm::cos(angle), centre + centre * libm::sin(angle))
    };
    Box::new(move |random| Some(one(random)))
}

/// Gaussian clusters around uniform centres, a hundred points each on average; a standard deviation is 1/200 of a side.
/// Points outside the grid are drawn anew.
pub fn clusters(n: usize, grid: Grid, random: &mut SplitMix64) -> Result<Draw, GenerateError> {
    let count = n.div_ceil(CLUSTER_POINTS);
    let mut centres = room(count)?;
    centres.extend((0..count).map(|_| anywhere(grid, random)));
    let deviation = grid.size as f64 / CLUSTER_DEVIATIONS;
    Ok(Box::new(move |random| {
        let [x, y] = centres[random.below(count as u64) as usize];
        let [dx, dy] = random.normal_pair();
        grid.cell(f64::from(x) + 0.5 + dx * deviation, f64::from(y) + 0.5 + dy * deviation)
    }))
}

fn anywhere(grid: Grid, random: &mut SplitMix64) -> [u32; 2] {
    [random.below(grid.size) as u32, random.below(grid.size) as u32]
}

/// Points of a set, drawn one after the other.
pub struct Drawn {
    draw: Draw,
    random: SplitMix64,
    left: usize,
}

impl Drawn {
    /// Draws `n` points.
    pub fn new(n: usize, random: SplitMix64, draw: Draw) -> Self {
        Self { draw, random, left: n }
    }
}

impl Iterator for Drawn {
    type Item = [u32; 2];

    fn next(&mut self) -> Option<[u32; 2]> {
        self.left = self.left.checked_sub(1)?;
        loop {
            if let Some(point) = (self.draw)(&mut self.random) {
                return Some(point);
            }
        }
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.left, Some(self.left))
    }
}

impl ExactSizeIterator for Drawn {}
