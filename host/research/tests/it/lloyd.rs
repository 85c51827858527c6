//! Lloyd's relaxation once more, by half planes in fractions: small sets, step by step, beside the library.

use std::num::NonZeroUsize;

use incircle_geometry::lloyd::{step, weighted_step, Density};
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

/// Borders of pixels and cuts are rounded down to multiples of 2^-4 of a step.
const SHARES: i128 = 16;

/// An image over the square of a clip, with rows from the lowest on.
struct Image {
    columns: usize,
    rows: Vec<Vec<i128>>,
    side: i128,
}

impl Image {
    fn borders(&self, parts: usize) -> Vec<i128> {
        (0..=parts as i128).map(|part| part * self.side * SHARES / parts as i128).collect()
    }

    /// Six times the mass, and twelve times the moments, of what lies below an edge, positive from left to right: pixel
    /// by pixel, each as a trapezium over a rectangle.
    fn below(&self, from: [i128; 2], to: [i128; 2]) -> [i128; 3] {
        if from[0] > to[0] {
            return self.below(to, from).map(|value| -value);
        }
        let (xs, ys) = (self.borders(self.columns), self.borders(self.rows.len()));
        // The places at which the edge is cut: all crossings with borders, rounded down, in order.
        let way = [to[0] - from[0], to[1] - from[1]];
        let mut cuts = vec![from, to];
        for (axis, borders) in [(0, &xs), (1, &ys)] {
            let (low, high) = (from[axis].min(to[axis]), from[axis].max(to[axis]));
            for border in borders.iter().filter(|border| low < **border && **border < high) {
                let other = from[1 - axis]
                    + (way[1 - axis] * (border - from[axis]) * way[axis].signum()).div_euclid(way[axis].abs());
                cuts.push(if axis == 0 { [*border, other] } else { [other, *border] });
            }
        }
        cuts.sort_by_key(|cut| (cut[0], cut[1] * way[1].signum()));
        let mut sums = [0; 3];
        for piece in cuts.windows(2) {
            let ([x0, y0], [x1, y1]) = (piece[0], piece[1]);
            let dx = x1 - x0;
            let column = xs.windows(2).position(|pair| pair[0] <= x0 && x1 <= pair[1]).expect("a column");
            for (row, pair) in ys.windows(2).enumerate() {
                let weight = self.rows[row][column];
                let (low, high) = (pair[0], pair[1]);
                // The heights of both ends above the row's lower border, cut off at its upper one.
                let [a, b] = [y0, y1].map(|y| y.clamp(low, high) - low);
                let (square, product) = (a * a + a * b + b * b, a + b);
                sums[0] += weight * 6 * dx * product / 2;
                sums[1] += weight * 2 * dx * (a * (2 * x0 + x1) + b * (x0 + 2 * x1));
                // The moment in y: half the difference of squares, integrated.
                sums[2] += weight * dx * (6 * low * product + 2 * square);
            }
        }
        sums
    }
}

/// The new place of a point over an image.
fn weighted(points: &[[i64; 2]], index: usize, clip: &[[i64; 2]], image: &Image) -> [i64; 2] {
    let index = points.iter().position(|point| *point == points[index]).unwrap_or(index);
    let seen = |place: &[i128; 3]| [0, 1].map(|axis| (place[axis] * SHARES).div_euclid(place[2]));
    let corners: Vec<[i128; 2]> = clipped_cell(points, index, clip).iter().map(seen).collect();
    let mut sums = [0; 3];
    for (k, from) in corners.iter().enumerate() {
        let below = image.below(*from, corners[(k + 1) % corners.len()]);
        // Counter-clockwise, the lower border leads to the right.
        (0..3).for_each(|which| sums[which] -= below[which]);
    }
    if sums[0] <= 0 {
        return points[index];
    }
    let rounded = |moment: i128| (moment + SHARES * sums[0]).div_euclid(2 * SHARES * sums[0]) as i64;
    [rounded(sums[1]), rounded(sums[2])]
}

#[test]
fn weighted_steps_are_those_of_trapeziums() {
    let mut random = SplitMix64::new(298);
    for _ in 0..60 {
        let bits = random.pick(&[4, 6, 10]);
        let side = (1i64 << bits) - 1;
        let clip = [[0, 0], [side, 0], [side, side], [0, side]];
        let square = Clip::rectangle(Point::new(0, 0), Point::new(side as u32, side as u32)).expect("a square");
        let (columns, rows) = (1 + random.below(9) as usize, 1 + random.below(9) as usize);
        let weights: Vec<u16> = (0..columns * rows).map(|_| random.pick(&[0, 0, 1, 7, 65535])).collect();
        let Ok(density) = Density::over(&square, columns, &weights) else { continue };
        let lines = weights.chunks(columns).rev().map(|row| row.iter().map(|&weight| weight.into()).collect());
        let image = Image { columns, rows: lines.collect(), side: side.into() };
        let count = 1 + random.below(12);
        let mut points: Vec<[i64; 2]> = (0..count).map(|_| [0; 2].map(|_: i64| random.bits(bits) as i64)).collect();
        for _ in 0..4 {
            let grid: Vec<Point> = points.iter().map(|&[x, y]| Point::new(x as u32, y as u32)).collect();
            let found = weighted_step(&grid, &square, &density, NonZeroUsize::MIN).expect("cells");
            let expected: Vec<[i64; 2]> =
                (0..points.len()).map(|index| weighted(&points, index, &clip, &image)).collect();
            let found: Vec<[i64; 2]> = found.iter().map(|point| [point.x.into(), point.y.into()]).collect();
            assert_eq!(found, expected, "{points:?} {weights:?}");
            points = found;
        }
    }
}
