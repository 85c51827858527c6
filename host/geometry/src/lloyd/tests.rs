//! Threads, orders, ends, and even spread. `host/research` has a second implementation.

use super::*;
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
        let still = relax(points, &clip, stop, threads(1)).expect("cells");
        assert_ne!(still.end, End::Iterations);
        if still.end == End::Still {
            assert_eq!(still.moved, 0);
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
