//! `reach` beside integers of any size.

use incircle_testkit::{disc_is_between, SplitMix64};

use super::*;

/// The lines that grid points beyond a region are on at the nearest: `west - 1`, `east`, `south - 1`, `north`.
fn lines(region: &Region) -> [Option<f64>; 4] {
    let line = |side: Option<i64>, step: i64| side.map(|side| (side - step) as f64);
    [line(region.west, 1), line(region.east, 0), line(region.south, 1), line(region.north, 0)]
}

fn is_between(region: &Region, corners: [Point; 3]) -> bool {
    *region == Region::WHOLE || disc_is_between(corners.map(|p| [p.x.into(), p.y.into()]), lines(region))
}

fn check(region: &Region, corners: [Point; 3]) -> Reach {
    let expected = if is_between(region, corners) { Reach::Within } else { Reach::Beyond };
    let found = reach(region, corners);
    assert_eq!(found, expected, "{region:?} {corners:?}");
    found
}

/// A side through the grid of `bits` bits or next to it, or no side; never one that no grid point is beyond, because
/// the oracle does not know that coordinates end.
fn side(random: &mut SplitMix64, bits: u32) -> Option<i64> {
    (!random.once_in(4)).then(|| 1 + random.below((1 << bits) - 1) as i64)
}

fn region(random: &mut SplitMix64, bits: u32) -> Region {
    let [west, east, south, north] = [(); 4].map(|()| side(random, bits));
    Region { west, east, south, north }
}

/// A corner anywhere on the grid, or within `spread` steps of a place.
fn corner(random: &mut SplitMix64, bits: u32, place: Point, spread: u32) -> Point {
    let near = |random: &mut SplitMix64, value: u32| {
        let moved = i64::from(value) + random.below(2 * u64::from(spread) + 1) as i64 - i64::from(spread);
        moved.clamp(0, (1 << bits) - 1) as u32
    };
    Point::new(near(random, place.x), near(random, place.y))
}

#[test]
fn grid_points_of_all_widths_have_the_exact_answer() {
    let mut random = SplitMix64::new(71);
    for bits in [3, 8, 16, 19, 20, 21, 24, 31, 32] {
        let mut within = 0;
        for _ in 0..4000 {
            let spread = 1 << random.below(bits.into());
            let place = Point::new(random.bits(bits) as u32, random.bits(bits) as u32);
            let corners = [(); 3].map(|()| corner(&mut random, bits, place, spread));
            within += usize::from(check(&region(&mut random, bits), corners) == Reach::Within);
        }
        assert!(within > 50, "{within} of 4000 triangles of {bits} bits are within");
    }
}

/// Regions whose sides are the last that a disc does not touch, and the first that it touches.
#[test]
fn the_answer_changes_between_two_steps_of_the_grid() {
    let mut random = SplitMix64::new(72);
    for bits in [8, 16, 21, 31, 32] {
        for _ in 0..200 {
            let place = Point::new(random.bits(bits) as u32, random.bits(bits) as u32);
            let corners = [(); 3].map(|()| corner(&mut random, bits, place, 1 << (bits - 3)));
            let end = 1 << bits;
            for axis in 0..2 {
                let on = |side: i64| match axis {
                    0 => Region { east: Some(side), ..Region::WHOLE },
                    _ => Region { north: Some(side), ..Region::WHOLE },
                };
                turn(&on, 0, end, corners);
                let on = |side: i64| match axis {
                    0 => Region { west: Some(end - side), ..Region::WHOLE },
                    _ => Region { south: Some(end - side), ..Region::WHOLE },
                };
                turn(&on, 1, end, corners);
            }
        }
    }
}

/// Finds the side at which the answer changes, between `low` and `high`, and checks both answers there.
fn turn(on: &dyn Fn(i64) -> Region, mut low: i64, mut high: i64, corners: [Point; 3]) {
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        match reach(&on(middle), corners) {
            Reach::Within => high = middle,
            _ => low = middle,
        }
    }
    for side in [low - 1, low, high, high + 1] {
        // The oracle does not know that no grid point has a negative coordinate or one of 33 bits.
        let lines = lines(&on(side));
        if lines.iter().flatten().all(|line| (0.0..4_294_967_296.0).contains(line)) {
            check(&on(side), corners);
        }
    }
}

#[test]
fn a_disc_that_touches_a_side_reaches_beyond() {
    // The circle has its centre in (5, 5) and the radius 5.
    let corners = [(0, 5), (5, 0), (8, 9)].map(Point::from);
    let touched = |east, north| Region { east: Some(east), north: Some(north), ..Region::WHOLE };
    assert_eq!(check(&touched(11, 11), corners), Reach::Within);
    assert_eq!(check(&touched(10, 11), corners), Reach::Beyond);
    assert_eq!(check(&touched(11, 10), corners), Reach::Beyond);
    // The points beyond a west side at 0 have the x -1.
    let moved = corners.map(|p| Point::new(p.x + 7, p.y + 7));
    let from = |west, south| Region { west: Some(west), south: Some(south), ..Region::WHOLE };
    assert_eq!(check(&from(7, 7), moved), Reach::Within);
    assert_eq!(check(&from(8, 7), moved), Reach::Beyond);
    assert_eq!(check(&from(7, 8), moved), Reach::Beyond);
    // The widest circle with such a place: its centre is in the middle of the grid of 32 bits.
    let half = 1 << 31;
    let wide = [(1, half), (half, 1), (half, 2 * (half - 1) + 1)].map(Point::from);
    let end = 1i64 << 32;
    check(&touched(end - 1, end - 1), wide);
    check(&Region { east: Some(end - 1), west: Some(1), ..Region::WHOLE }, wide);
}

#[test]
fn every_side_and_triangle_of_a_small_grid_has_the_exact_answer() {
    let points: Vec<Point> = (0..16).map(|k| Point::new(1 + k / 4, 1 + k % 4)).collect();
    for &a in &points {
        for &b in &points {
            for &c in &points {
                for side in 1..6 {
                    let whole = Region::WHOLE;
                    check(&Region { west: Some(side), ..whole }, [a, b, c]);
                    check(&Region { east: Some(side), ..whole }, [a, b, c]);
                    check(&Region { south: Some(side), ..whole }, [a, b, c]);
                    check(&Region { north: Some(side), ..whole }, [a, b, c]);
                }
            }
        }
    }
}

#[test]
fn points_on_a_line_are_within_the_whole_plane_alone() {
    let end = u32::MAX;
    let lines = [[(3, 3), (3, 3), (3, 3)], [(0, 0), (end, end), (7, 7)], [(0, 5), (end, 5), (1, 5)]];
    for line in lines.map(|line| line.map(Point::from)) {
        assert_eq!(reach(&Region::WHOLE, line), Reach::Within);
        assert_eq!(reach(&Region { north: Some(1 << 31), ..Region::WHOLE }, line), Reach::Beyond);
        let doubles = line.map(|p| [f64::from(p.x), f64::from(p.y)]);
        assert_eq!(reach(&Region::WHOLE, doubles), Reach::Within);
        assert_eq!(reach(&Region { north: Some(1e18), ..Region::WHOLE }, doubles), Reach::Unknown);
    }
}

#[test]
fn sides_that_no_grid_point_is_beyond_are_no_sides() {
    let end = 1 << 32;
    let thin = [(0, 0), (u32::MAX, 0), (1 << 31, 1)].map(Point::from);
    for (low, high) in [(0, end), (i64::MIN, i64::MAX), (-5, end + 5)] {
        let all = Region { west: Some(low), east: Some(high), south: Some(low), north: Some(high) };
        assert_eq!(reach(&all, thin), Reach::Within);
    }
    for nowhere in [
        Region { west: Some(i64::MAX), ..Region::WHOLE },
        Region { east: Some(i64::MIN), ..Region::WHOLE },
        Region { west: Some(end), ..Region::WHOLE },
        Region { north: Some(0), ..Region::WHOLE },
    ] {
        assert_eq!(reach(&nowhere, thin), Reach::Beyond, "{nowhere:?}");
        assert_eq!(reach(&nowhere, [(0, 0), (1, 0), (0, 1)].map(Point::from)), Reach::Beyond, "{nowhere:?}");
    }
}

fn double(random: &mut SplitMix64, exponent: i32) -> f64 {
    let value = (random.unit() - 0.5) * 2f64.powi(exponent);
    match random.below(8) {
        0 => value.round(),
        1 => 0.0,
        _ => value,
    }
}

#[test]
fn the_answer_of_doubles_is_never_wrong_and_seldom_unknown() {
    let mut random = SplitMix64::new(73);
    for exponent in [-1050, -500, -100, -40, 0, 3, 30, 140, 500, 1020] {
        let mut counts = [0; 3];
        for _ in 0..2000 {
            let spread = exponent - random.below(40) as i32;
            let place = [(); 2].map(|()| double(&mut random, exponent));
            let corners = [(); 3].map(|()| place.map(|value| value + double(&mut random, spread)));
            let mut line = || (!random.once_in(3)).then(|| double(&mut random, exponent + 2));
            let region = Region { west: line(), east: line(), south: line(), north: line() };
            let found = reach(&region, corners);
            let is_between = disc_is_between(corners, [region.west, region.east, region.south, region.north]);
            match found {
                Reach::Within => assert!(is_between || region == Region::WHOLE, "{region:?} {corners:?}"),
                Reach::Beyond => assert!(!is_between, "{region:?} {corners:?}"),
                Reach::Unknown => {}
            }
            counts[found as usize] += 1;
        }
        // Triangles of the whole plane are always within.
        let most_unknown = if (-100..=140).contains(&exponent) { 200 } else { 2000 };
        assert!(counts[Reach::Unknown as usize] <= most_unknown, "2^{exponent}: {counts:?}");
    }
}

#[test]
fn values_that_are_no_numbers_are_unknown() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let strange = [[0.0, 0.0], [value, 0.0], [0.0, 1.0]];
        assert_eq!(reach(&Region { east: Some(9.0), ..Region::WHOLE }, strange), Reach::Unknown);
        assert_eq!(reach(&Region { east: Some(9.0), ..Region::WHOLE }, [[value; 2]; 3]), Reach::Unknown);
    }
    assert_ne!(reach(&Region { east: Some(f64::NAN), ..Region::WHOLE }, corners), Reach::Within);
    assert_ne!(reach(&Region { west: Some(f64::NAN), ..Region::WHOLE }, corners), Reach::Within);
    assert_eq!(reach(&Region { east: Some(f64::INFINITY), ..Region::WHOLE }, corners), Reach::Within);
    assert_eq!(reach(&Region { west: Some(-f64::MAX), east: Some(f64::MAX), ..Region::WHOLE }, corners), Reach::Within);
}

/// A triangle of doubles of about the size `2^exponent`. Half of all are thin, with an angle of down to 2^-30. A third
/// has the first corner where the disc ends in the west, so that the first test of the filter decides.
fn double_triangle(random: &mut SplitMix64, exponent: i32) -> [[f64; 2]; 3] {
    let size = 2f64.powi(exponent);
    let thin = if random.once_in(2) { 1.0 } else { 2f64.powi(-(random.below(30) as i32)) };
    let first = if random.once_in(3) { std::f64::consts::PI } else { std::f64::consts::TAU * random.unit() };
    let second = std::f64::consts::TAU * random.unit();
    let mut angles = [first, second, second + thin * (random.unit() - 0.5)];
    angles.rotate_left(random.below(2) as usize);
    let center = [(); 2].map(|()| size * random.unit());
    let radius = size * (0.5 + random.unit());
    angles.map(|angle| [center[0] + radius * angle.cos(), center[1] + radius * angle.sin()])
}

/// The next double in the direction of `step`, that many times.
fn moved(value: f64, steps: i32) -> f64 {
    let next = if steps < 0 { f64::next_down } else { f64::next_up };
    (0..steps.abs()).fold(value, |value, _| next(value))
}

/// Finds the last line east of a triangle that its disc touches or crosses, and checks the answers around that line.
/// `most` is a line beyond the disc; if it is not, nothing is checked.
fn check_beside_the_line(corners: [[f64; 2]; 3], most: f64, counts: &mut [usize; 3]) {
    let is_clear = |line: f64| disc_is_between(corners, [None, Some(line), None, None]);
    let (mut low, mut high) = (-most, most);
    if !is_clear(high) {
        return;
    }
    while moved(low, 1) < high {
        let middle = low + 0.5 * (high - low);
        let middle = if middle > low && middle < high { middle } else { moved(low, 1) };
        if is_clear(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    for steps in (-20..=20).chain([-1000, -100, 100, 1000]) {
        let line = moved(low, steps);
        let found = reach(&Region { east: Some(line), ..Region::WHOLE }, corners);
        let wrong = if steps <= 0 { Reach::Within } else { Reach::Beyond };
        assert_ne!(found, wrong, "{steps} steps from the line {low} {corners:?}");
        counts[found as usize] += 1;
    }
}

#[test]
fn the_answer_of_doubles_is_right_beside_the_line_that_the_disc_touches() {
    let mut random = SplitMix64::new(74);
    let mut counts = [0; 3];
    for exponent in [-178, -149, -100, -20, 0, 1, 40, 149, 170] {
        for _ in 0..40 {
            let corners = double_triangle(&mut random, exponent);
            check_beside_the_line(corners, 2f64.powi(exponent + 40), &mut counts);
        }
    }
    assert!(counts.iter().all(|&count| count > 300), "{counts:?}");
}

/// The square of the short side is too small for a double, and that of the long one is large.
#[test]
fn a_square_that_is_lost_to_underflow_is_no_proof() {
    let mut random = SplitMix64::new(75);
    let mut counts = [0; 3];
    for _ in 0..40 {
        let [near, far] = [-540, 100].map(|exponent| {
            let angle = std::f64::consts::TAU * random.unit();
            [angle.cos(), angle.sin()].map(|value| value * 2f64.powi(exponent))
        });
        check_beside_the_line([[0.0, 0.0], near, far], 2f64.powi(130), &mut counts);
    }
    assert!(counts[Reach::Unknown as usize] > 1000, "{counts:?}");
}
