//! Small sets full of ties.

use incircle_testkit::SplitMix64;

use crate::point::Point;

/// The coordinates of a small set are below this number.
pub(super) const SIDE: u32 = 12;

/// Kinds of small sets.
const KINDS: u64 = 9;

/// A small set of the given kind: its seed says which.
pub(super) fn tie_rich(seed: u64) -> Vec<Point> {
    let mut random = SplitMix64::new(seed);
    let random = &mut random;
    let count = 3 + random.below(15) as usize;
    match seed % KINDS {
        0 => anywhere(random, count, 3),
        1 => anywhere(random, count, 5),
        2 => anywhere(random, 2 * count, SIDE),
        3 => lattice(random),
        4 => circle(random, count),
        5 => line(random, count),
        6 => vec![anywhere(random, 1, SIDE)[0]; 1 + count % 4],
        7 => [line(random, count / 2), line(random, count / 2)].concat(),
        _ => [circle(random, count), anywhere(random, count / 2, SIDE)].concat(),
    }
}

/// Points anywhere on a corner of the grid; many are equal if the corner is small.
fn anywhere(random: &mut SplitMix64, count: usize, side: u32) -> Vec<Point> {
    let corner = [(); 2].map(|()| random.below_u32(SIDE - side + 1));
    (0..count).map(|_| Point::new(corner[0] + random.below_u32(side), corner[1] + random.below_u32(side))).collect()
}

/// A lattice of up to 5 x 5 points, some of them left out.
fn lattice(random: &mut SplitMix64) -> Vec<Point> {
    let step = 1 + random.below_u32(2);
    let [columns, rows] = [(); 2].map(|()| 2 + random.below_u32(4));
    let mut points: Vec<Point> =
        (0..columns * rows).map(|k| Point::new(step * (k % columns), step * (k / columns))).collect();
    points.retain(|_| !random.once_in(6));
    random.shuffle(&mut points);
    points
}

/// Points of the circle with the radius 5, which has twelve places on the grid.
fn circle(random: &mut SplitMix64, count: usize) -> Vec<Point> {
    let places = [(10, 5), (9, 8), (8, 9), (5, 10), (2, 9), (1, 8), (0, 5), (1, 2), (2, 1), (5, 0), (8, 1), (9, 2)];
    (0..count).map(|_| places[random.below(12) as usize].into()).collect()
}

/// Points on a vertical, horizontal or slanted line.
fn line(random: &mut SplitMix64, count: usize) -> Vec<Point> {
    let [dx, dy] = random.pick(&[[0, 1], [1, 0], [1, 1], [1, 2], [2, 1]]);
    let corner = [(); 2].map(|()| random.below_u32(2));
    let along = |k: u32| Point::new(corner[0] + dx * k, corner[1] + dy * k);
    (0..count).map(|_| along(random.below_u32(6))).collect()
}
