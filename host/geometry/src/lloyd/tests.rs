//! Threads, orders, ends, and even spread. `host/research` has a second implementation.

use core::ops::ControlFlow;

use super::*;
use crate::cpu;
use crate::voronoi::{self, Cells, Voronoi};
use incircle_testkit::SplitMix64;

fn square(side: u32) -> Clip {
    Clip::rectangle(Point::new(0, 0), Point::new(side, side)).expect("a square")
}

fn draw(random: &mut SplitMix64, count: usize, bits: u32) -> Vec<Point> {
    (0..count).map(|_| Point::new(random.bits(bits) as u32, random.bits(bits) as u32)).collect()
}

fn threads(count: usize) -> NonZeroUsize {
    NonZeroUsize::new(count).expect("a number of threads")
}

const FIVE: Stop = Stop { iterations: 5, when_still: false };

#[test]
fn threads_and_orders_change_nothing() {
    let mut random = SplitMix64::new(291);
    let points = draw(&mut random, 20_000, 31);
    let clip = square((1 << 31) - 1);
    let one = relax(points.clone(), &clip, FIVE, threads(1)).expect("cells");
    assert_eq!(relax(points.clone(), &clip, FIVE, threads(3)).expect("cells"), one);
    let reversed: Vec<Point> = points.iter().rev().copied().collect();
    let mut other = relax(reversed, &clip, FIVE, threads(2)).expect("cells").points;
    other.reverse();
    assert_eq!(other, one.points);
}

#[test]
fn points_spread_until_they_are_still() {
    let mut random = SplitMix64::new(292);
    for _ in 0..10 {
        let points = draw(&mut random, 12, 10);
        let clip = square(1023);
        let stop = Stop { iterations: 10_000, when_still: true };
        let still = relax(points.clone(), &clip, stop, threads(1)).expect("cells");
        assert_ne!(still.end, End::Iterations);
        if still.end == End::Still {
            assert_eq!(still.moved, 0);
            // A number of steps ends there as well, with the same places.
            let stop = Stop { iterations: still.iterations + 5, when_still: false };
            assert_eq!(relax(points, &clip, stop, threads(1)).expect("cells"), still);
            assert_eq!(step(&still.points, &clip, threads(1)).expect("cells"), still.points);
        }
        let nearest = |k: usize| {
            let square = |j: usize| {
                let (one, other) = (still.points[k], still.points[j]);
                u64::from(one.x.abs_diff(other.x)).pow(2) + u64::from(one.y.abs_diff(other.y)).pow(2)
            };
            (0..12).filter(|&j| j != k).map(square).min().unwrap_or(0)
        };
        // Twelve even points of a square of 1024 are some 300 apart.
        assert!((0..12).all(|k| nearest(k) > 150 * 150), "{:?}", still.points);
    }
}

#[test]
fn few_points_and_duplicates_move_to_centroids() {
    let clip = square(100);
    let step = |points: &[(u32, u32)]| -> Vec<(u32, u32)> {
        let points: Vec<Point> = points.iter().copied().map(Point::from).collect();
        super::step(&points, &clip, threads(1)).expect("cells").into_iter().map(Into::into).collect()
    };
    assert_eq!(step(&[]), []);
    assert_eq!(step(&[(3, 4)]), [(50, 50)]);
    assert_eq!(step(&[(0, 0), (0, 0), (100, 0)]), [(25, 50), (25, 50), (75, 50)]);
    // The cell of the last point lies beyond the clip.
    assert_eq!(step(&[(50, 50), (500, 50)]), [(50, 50), (500, 50)]);
}

/// A step by the lists of a diagram: every cell is clipped, and its corners are divided in 128 bits.
fn by_cells(points: &[Point], clip: &Clip) -> Vec<Point> {
    let mesh = cpu::triangulate(points.to_vec(), threads(1), &mut |_| ControlFlow::Continue(())).expect("a mesh");
    let voronoi = Voronoi::of(&mesh).expect("a diagram");
    let mut cells = Cells::new(&voronoi, clip);
    let mut next: Vec<Point> = (0..points.len() as u32)
        .map(|index| {
            let point = points[index as usize];
            let (mut area, mut moments) = (0i128, [0i128; 2]);
            for piece in cells.cell(index).pieces() {
                let down =
                    |n: i128, d: u64, value: u32| ((n - i128::from(value) * i128::from(d)) * 256).div_euclid(d.into());
                let ring: Vec<[i128; 2]> = piece
                    .corners()
                    .map(|(corner, _)| [down(corner.x, corner.d, point.x), down(corner.y, corner.d, point.y)])
                    .collect();
                for (k, [bx, by]) in ring.iter().enumerate() {
                    let [ax, ay] = ring[(k + ring.len() - 1) % ring.len()];
                    let twice = ax * by - ay * bx;
                    area += twice;
                    moments = [moments[0] + (ax + bx) * twice, moments[1] + (ay + by) * twice];
                }
            }
            let at = |value: u32, moment: i128| {
                (i128::from(value) + (2 * moment + 768 * area).div_euclid(1536 * area)) as u32
            };
            if area > 0 {
                Point::new(at(point.x, moments[0]), at(point.y, moments[1]))
            } else {
                point
            }
        })
        .collect();
    mesh.duplicates.iter().for_each(|duplicate| next[duplicate.index as usize] = next[duplicate.of as usize]);
    next
}

#[test]
fn steps_are_those_of_clipped_cells() {
    let mut random = SplitMix64::new(294);
    for round in 0..400 {
        let bits = [3, 4, 8, 16, 31][round % 5];
        let count = 1 + random.below(60) as usize;
        let mut points = draw(&mut random, count, bits);
        if round % 3 == 0 {
            points.iter_mut().for_each(|point| *point = Point::new(point.x & !1, point.y & !1));
        }
        let side = (1 << bits) - 1;
        let (low, high) = (Point::new(side / 8, side / 8), Point::new(side, side - side / 3));
        let notch = [low, Point::new(high.x, low.y), high, Point::new(side / 2, side / 4), Point::new(low.x, high.y)];
        for clip in
            [square(side), Clip::rectangle(low, high).expect("a rectangle"), Clip::polygon(&notch).expect("a notch")]
        {
            let expected = by_cells(&points, &clip);
            assert_eq!(step(&points, &clip, threads(1)).expect("cells"), expected, "{points:?} {:?}", clip.corners());
        }
    }
}

#[test]
fn a_point_amid_many_has_a_cell() {
    // All 60 lie about a circle around the first point.
    let mut points = vec![Point::new(5000, 5000)];
    for k in 0..60 {
        let angle = f64::from(k) / 60.0 * core::f64::consts::TAU;
        points.push(Point::new((5000.0 + 3000.0 * angle.cos()) as u32, (5000.0 + 3000.0 * angle.sin()) as u32));
    }
    assert_eq!(step(&points, &square(10_000), threads(1)).expect("cells"), by_cells(&points, &square(10_000)));
}

#[test]
fn even_weights_are_no_weights() {
    let mut random = SplitMix64::new(295);
    let clip = square((1 << 20) - 1);
    let points = draw(&mut random, 500, 20);
    let plain = step(&points, &clip, threads(1)).expect("cells");
    for weight in [1, 65535] {
        let density = Density::over(&clip, 7, &[weight; 35]).expect("a density");
        let weighted = weighted_step(&points, &clip, &density, threads(1)).expect("cells");
        // Corners and cuts are rounded to 2^-4 of a step.
        assert!(plain.iter().zip(&weighted).all(|(a, b)| a.x.abs_diff(b.x) <= 1 && a.y.abs_diff(b.y) <= 1));
    }
}

#[test]
fn weights_are_equal_on_threads_and_in_any_order() {
    let mut random = SplitMix64::new(296);
    let clip = square((1 << 31) - 1);
    let weights: Vec<u16> =
        (0..100 * 60).map(|_| if random.below(3) == 0 { 0 } else { random.bits(16) as u16 }).collect();
    let density = Density::over(&clip, 100, &weights).expect("a density");
    let points = draw(&mut random, 9000, 31);
    let one = relax_weighted(points.clone(), &clip, &density, FIVE, threads(1)).expect("cells");
    assert_eq!(relax_weighted(points.clone(), &clip, &density, FIVE, threads(3)).expect("cells"), one);
    let reversed: Vec<Point> = points.iter().rev().copied().collect();
    let mut other = relax_weighted(reversed, &clip, &density, FIVE, threads(2)).expect("cells").points;
    other.reverse();
    assert_eq!(other, one.points);
}

#[test]
fn points_gather_where_mass_is() {
    let clip = square(1 << 20);
    // The upper left quarter has all the mass but for a sixteenth.
    let density = Density::over(&clip, 2, &[45, 1, 1, 1]).expect("a density");
    let mut random = SplitMix64::new(297);
    let start = draw(&mut random, 400, 20);
    let stop = Stop { iterations: 120, when_still: false };
    let end = relax_weighted(start, &clip, &density, stop, threads(1)).expect("cells").points;
    let gathered = end.iter().filter(|point| point.x < 1 << 19 && point.y > 1 << 19).count();
    // Even points would be 100. At the end it would be the share of the square roots, sqrt 45 to 3: 276 points.
    assert!((120..300).contains(&gathered), "{gathered}");
    // Cells without mass keep their points.
    let half = Density::over(&clip, 2, &[1, 0]).expect("a density");
    let far = [Point::new(100, 100), Point::new(1 << 20, 50), Point::new(1 << 20, 90)];
    let moved = weighted_step(&far, &clip, &half, threads(1)).expect("cells");
    assert_eq!((moved[0], moved[1], moved[2]), (Point::new(1 << 18, 1 << 19), far[1], far[2]));
}

#[test]
fn images_without_full_rows_or_mass_are_refused() {
    let clip = square(9);
    assert_eq!(Density::over(&clip, 0, &[1]), Err(DensityError::NotFull { weights: 1, columns: 0 }));
    assert_eq!(Density::over(&clip, 2, &[1; 3]), Err(DensityError::NotFull { weights: 3, columns: 2 }));
    assert_eq!(Density::over(&clip, 2, &[]), Err(DensityError::NotFull { weights: 0, columns: 2 }));
    assert_eq!(Density::over(&clip, 2, &[0; 4]), Err(DensityError::NoMass));
    let density = Density::over(&clip, 1, &[1]).expect("a density");
    let other = weighted_step(&[Point::new(1, 1)], &square(8), &density, threads(1));
    assert_eq!(other, Err(Error::Density(DensityError::OtherClip)));
    let wide = step(&[Point::new(1 << 31, 1)], &clip, threads(1));
    assert!(matches!(wide, Err(Error::Cells(voronoi::Error::CoordinateOutOfRange { index: 0, .. }))), "{wide:?}");
}
