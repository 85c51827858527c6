//! Lloyd's relaxation once more, by half planes in fractions: small sets, step by step, beside the library.

use std::num::NonZeroUsize;

use incircle_geometry::lloyd::step;
use incircle_geometry::voronoi::Clip;
use incircle_geometry::Point;
use incircle_testkit::{clipped_cell, SplitMix64};

/// Corners are rounded down to multiples of 2^-8 of a step.
const PARTS: i128 = 256;

/// The new place of a point: the centroid of its cell, whose corners are rounded as seen from the point.
fn moved(points: &[[i64; 2]], index: usize, clip: &[[i64; 2]]) -> [i64; 2] {
    // The lowest index of a place decides for all.
    let index = points.iter().position(|point| *point == points[index]).unwrap_or(index);
    let own = points[index].map(i128::from);
    let seen =
        |place: &[i128; 3]| [0, 1].map(|axis| ((place[axis] - own[axis] * place[2]) * PARTS).div_euclid(place[2]));
    let corners: Vec<[i128; 2]> = clipped_cell(points, index, clip).iter().map(seen).collect();
    // The triangles of a fan from the first corner, not from the point.
    let (mut area, mut sum) = (0, [0; 2]);
    for pair in corners.windows(2).skip(1) {
        let (a, b, c) = (corners[0], pair[0], pair[1]);
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        area += twice;
        (0..2).for_each(|axis| sum[axis] += twice * (a[axis] + b[axis] + c[axis]));
    }
    if area <= 0 {
        return points[index];
    }
    // Halves are rounded upwards.
    let rounded = |axis: usize| {
        let unit = 3 * area * PARTS;
        let whole = sum[axis].div_euclid(unit);
        own[axis] + whole + i128::from(2 * sum[axis].rem_euclid(unit) >= unit)
    };
    [rounded(0) as i64, rounded(1) as i64]
}

#[test]
fn steps_are_those_of_half_planes() {
    let mut random = SplitMix64::new(293);
    for _ in 0..60 {
        let bits = random.pick(&[3, 6, 10]);
        let side = (1i64 << bits) - 1;
        let clip = [[0, 0], [side, 0], [side, side], [0, side]];
        let count = 1 + random.below(12);
        let mut points: Vec<[i64; 2]> = (0..count).map(|_| [0; 2].map(|_: i64| random.bits(bits) as i64)).collect();
        for _ in 0..4 {
            let grid: Vec<Point> = points.iter().map(|&[x, y]| Point::new(x as u32, y as u32)).collect();
            let square = Clip::rectangle(Point::new(0, 0), Point::new(side as u32, side as u32)).expect("a square");
            let found = step(&grid, &square, NonZeroUsize::MIN).expect("cells");
            let expected: Vec<[i64; 2]> = (0..points.len()).map(|index| moved(&points, index, &clip)).collect();
            let found: Vec<[i64; 2]> = found.iter().map(|point| [point.x.into(), point.y.into()]).collect();
            assert_eq!(found, expected, "{points:?}");
            points = found;
        }
    }
}
