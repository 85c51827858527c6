//! Tests of the parts of the CPU triangulator against plain definitions. `host/tests/it/cpu.rs` tests the whole.

use std::cmp::Ordering;

use incircle_testkit::{incircle_of_doubles, orient2d_of_doubles};
use proptest::prelude::*;

use super::edges::{Half, HALVES};
use super::kernel::{Ends, Kernel};
use super::sites::{exact_bits, sort, Sites};
use super::view::{Integers, Narrow, Site, Wide, Widest, Width};
use super::{collect, segments};
use crate::order::mix;
use crate::pages;
use crate::point::Point;

/// A coordinate of up to `bits` bits, often an extreme one.
fn coordinate(bits: u32) -> impl Strategy<Value = u32> {
    let last = ((1u64 << bits) - 1) as u32;
    prop_oneof![2 => 0..=last, 1 => Just(0), 1 => Just(last), 1 => Just(last / 2), 1 => Just(last - last / 2)]
}

fn site(bits: u32) -> impl Strategy<Value = Site> {
    (coordinate(bits), coordinate(bits)).prop_map(|(x, y)| Site::at(x, y))
}

/// The 3x3 determinant of the points seen from `d` and lifted: positive if `d` lies inside the circle of a
/// counter-clockwise triangle. For coordinates of up to 31 bits the determinant fits 128 bits.
fn lifted(a: Site, b: Site, c: Site, d: Site) -> i128 {
    let seen = |p: Site| [i128::from(p.x()) - i128::from(d.x()), i128::from(p.y()) - i128::from(d.y())];
    let [a, b, c] = [a, b, c].map(seen);
    let lift = |v: [i128; 2]| v[0] * v[0] + v[1] * v[1];
    let minor = |u: [i128; 2], v: [i128; 2]| u[0] * v[1] - u[1] * v[0];
    lift(a) * minor(b, c) + lift(b) * minor(c, a) + lift(c) * minor(a, b)
}

/// Whether `q` is inside the circle of `a`, `b`, `c`, with the smallest of the four lowered on the paraboloid.
/// `lowered` is the factor of the smallest point's lift in the determinant.
fn conflicts(a: Site, b: Site, c: Site, q: Site) -> bool {
    let orient2d = |p: Site, q: Site, r: Site| Widest::view(p, q, r).cross;
    let lowered = match [a, b, c, q].into_iter().min() {
        Some(smallest) if smallest == a => -orient2d(q, b, c),
        Some(smallest) if smallest == b => -orient2d(q, c, a),
        Some(smallest) if smallest == c => -orient2d(q, a, b),
        _ => orient2d(a, b, c),
    };
    match lifted(a, b, c, q).cmp(&0) {
        Ordering::Equal => lowered > 0,
        unequal => unequal == Ordering::Greater,
    }
}

/// Compares all ties of a small grid with the definition; returns how many there are.
fn ties_are_decided<W: Width>() -> usize {
    let grid: Vec<Site> = (0..16).map(|k| Site::at(k / 4, k % 4)).collect();
    let mut ties = 0;
    for (&a, &b) in grid.iter().flat_map(|a| grid.iter().map(move |b| (a, b))) {
        let ends = Ends { a, b, bounds: () };
        let seen: Vec<_> = grid.iter().map(|&site| Integers::<W>::see(ends, site)).collect();
        for (&c, &q) in seen.iter().flat_map(|c| seen.iter().map(move |q| (c, q))).filter(|(c, q)| c.site != q.site) {
            let [c_is_left, q_is_left] = [c, q].map(|seen| Integers::<W>::is_left(ends, seen));
            let determinant = lifted(a, b, c.site, q.site);
            // At a tie with a point that does not lie to the left, the answer is no.
            let is_inside = (determinant != 0 || q_is_left) && conflicts(a, b, c.site, q.site);
            assert_eq!(Integers::<W>::is_left_and_inside(ends, c, q), c_is_left && is_inside);
            ties += usize::from(c_is_left && q_is_left && determinant == 0);
        }
    }
    ties
}

#[test]
fn ties_are_decided_by_the_smallest() {
    let ties = ties_are_decided::<Narrow>();
    assert!(ties > 100, "{ties}");
    assert_eq!(ties_are_decided::<Wide>(), ties);
    assert_eq!(ties_are_decided::<Widest>(), ties);
}

/// The position along the curve, bit by bit: the bits of x and y in turn, x first.
fn position(point: Point) -> u64 {
    let bits = |bit: u32| u64::from(point.x >> bit & 1) << 1 | u64::from(point.y >> bit & 1);
    (0..32).rev().fold(0, |position, bit| position << 2 | bits(bit))
}

/// The triangles of points that are not on one line, with all stages on `threads` threads, even for few points.
fn triangles(points: &[Point], threads: usize) -> Vec<[u32; 3]> {
    let Sites { sites, ids, .. } = sort(points, threads);
    let mut halves = pages::zeros::<Half>(HALVES * sites.len());
    let whole =
        segments::triangulate::<Integers<Wide>>(&sites, &sites, &mut halves, threads, &mut |_| true).expect("points");
    let hull = collect::hull_of(&mut halves, &ids, whole.leftmost());
    collect::triangles(halves, &ids, points.len(), 2 * ids.len() - 2 - hull.len(), threads)
}

/// If the points come in sorted order, a thread fills few buckets at a time, and the lowest ids have
/// most of the triangles.
#[test]
fn threads_find_the_same_triangles_whatever_the_order_of_the_points() {
    let mut points: Vec<Point> =
        (0..9000u64).map(mix).map(|random| Point::new(random as u32 >> 16, random as u32 & 0xffff)).collect();
    for _ in 0..3 {
        let expected = triangles(&points, 1);
        assert!(expected.is_sorted() && expected.iter().all(|t| t[0] < t[1] && t[0] < t[2]));
        for threads in 2..=5 {
            assert!(triangles(&points, threads) == expected, "{threads}");
        }
        // The second round takes the points along the curve, the third in the opposite order.
        let is_sorted = points.is_sorted_by_key(|&p| position(p));
        if is_sorted {
            points.reverse();
        } else {
            points.sort_by_key(|&p| position(p));
        }
    }
}

/// If there are fewer places than segments, no segment may be a single vertex beside another one.
#[test]
fn many_threads_share_few_places() {
    for side in 2..=12 {
        let points: Vec<Point> = (0..side * side + 5).map(|k| Point::new(k % side, k / side % side)).collect();
        let expected = triangles(&points, 1);
        assert_eq!(expected.len() as u32, 2 * (side - 1) * (side - 1));
        for threads in [2, 3, 4, 5, 9, 16, 64] {
            assert!(triangles(&points, threads) == expected, "{side}, {threads}");
        }
    }
    for seed in 0..200 {
        let random = |k: u64| mix(seed << 32 | k) as u32 & 63;
        let points: Vec<Point> = (0..24 + seed % 40).map(|k| Point::new(random(2 * k), random(2 * k + 1))).collect();
        let expected = triangles(&points, 1);
        for threads in [2, 4, 6, 9] {
            assert!(triangles(&points, threads) == expected, "{seed}, {threads}");
        }
    }
}

/// More points agree in the leading bits of their positions than are sorted by comparison.
#[test]
fn a_crowd_beside_a_far_point_is_sorted() {
    let far = Point::new((1 << 31) - 1, (1 << 31) - 1);
    let crowd = (0..1000u32).map(|k| Point::new(k * 7919 % 1009, k % 13));
    let points: Vec<Point> = std::iter::once(far).chain(crowd).collect();
    let Sites { sites, ids, duplicates, .. } = sort(&points, 1);
    assert!(duplicates.is_empty() && ids.len() == points.len());
    let key = |id: &u32| position(points[*id as usize]);
    assert!(ids.is_sorted_by_key(key) && ids[1000] == 0);
    assert!(sites.iter().zip(&ids).all(|(&site, &id)| site == Site::from(points[id as usize])));
}

/// Covers several buckets, positions that fit a word and positions that do not, and many points of one place.
#[test]
fn many_points_are_sorted_with_their_duplicates() {
    for bits in [1, 5, 11, 16, 24, 31, 32] {
        let random = |k: u64| mix(k) >> 8 & ((1 << bits) - 1);
        let points: Vec<Point> = (0..10_000u64)
            .map(|k| if k % 10 == 7 { 1 << 40 } else { k })
            .map(|k| Point::new(random(2 * k) as u32, random(2 * k + 1) as u32))
            .collect();
        let corner =
            Point::new(points.iter().map(|p| p.x).min().unwrap_or(0), points.iter().map(|p| p.y).min().unwrap_or(0));
        let seen = |id: u32| {
            let point = points[id as usize];
            Point::new(point.x - corner.x, point.y - corner.y)
        };
        let mut expected: Vec<u32> = (0..points.len() as u32).collect();
        expected.sort_by_key(|&id| position(seen(id)));
        expected.dedup_by_key(|id| seen(*id));
        for threads in 1..=4 {
            let sorted = sort(&points, threads);
            assert!(sorted.ids == expected, "{bits} bits, {threads} threads");
            assert!(sorted.sites.iter().zip(&expected).all(|(&site, &id)| site == Site::from(seen(id))));
            assert_eq!(sorted.duplicates.len(), points.len() - expected.len());
            assert!(sorted.duplicates.iter().all(|d| points[d.index as usize] == points[d.of as usize]));
        }
    }
}

/// Words leave out bits of the position, and hundreds of points in several buckets agree in the bits they have.
#[test]
fn a_dense_lattice_beside_a_far_point_is_sorted() {
    let far = Point::new((1 << 31) - 1, (1 << 31) - 1);
    let mut points: Vec<Point> = (0..250 * 250).map(|k| Point::new(k % 250, k / 250)).collect();
    points.sort_by_key(|point| mix(u64::from(point.x) << 32 | u64::from(point.y)));
    points.insert(777, far);
    for threads in 1..=4 {
        let sorted = sort(&points, threads);
        assert!(sorted.duplicates.is_empty() && sorted.ids.len() == points.len());
        assert!(sorted.ids.is_sorted_by_key(|&id| position(points[id as usize])), "{threads}");
        assert!(sorted.sites.iter().zip(&sorted.ids).all(|(&site, &id)| site == Site::from(points[id as usize])));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_widest_determinants_have_the_right_sign(a in site(32), b in site(32), c in site(32), q in site(32)) {
        let [at_a, at_b, at_c, at_q] = [a, b, c, q].map(|p| [f64::from(p.x()), f64::from(p.y())]);
        let found = Widest::determinant(Widest::view(a, b, c), Widest::view(a, b, q)).cmp(&0);
        prop_assert_eq!(found, incircle_of_doubles(at_a, at_b, at_c, at_q));
        prop_assert_eq!(Widest::view(a, b, c).cross.cmp(&0), orient2d_of_doubles(at_a, at_b, at_c));
    }

    #[test]
    fn narrow_determinants_are_exact(a in site(16), b in site(16), c in site(16), q in site(16)) {
        let expected = lifted(a, b, c, q);
        // The bound by which determinants fit 64 bits.
        let side = i128::from(u16::MAX);
        prop_assert!(2 * expected.abs() <= side * side * side * side);
        let found = Narrow::determinant(Narrow::view(a, b, c), Narrow::view(a, b, q));
        prop_assert_eq!(i128::from(found), expected);
    }

    #[test]
    fn wide_determinants_are_exact(a in site(31), b in site(31), c in site(31), q in site(31)) {
        prop_assert_eq!(Wide::determinant(Wide::view(a, b, c), Wide::view(a, b, q)), lifted(a, b, c, q));
    }

    #[test]
    fn sites_are_the_distinct_points_under_their_lowest_index(
        raw in prop::collection::vec((any::<u32>(), any::<u32>()), 0..700),
        bits in 1u32..=31,
        few in any::<bool>(),
        threads in 1usize..4,
    ) {
        let shift = |value: u32| if few { (value >> 29) << (bits.max(3) - 3) } else { value >> (32 - bits) };
        let points: Vec<Point> = raw.iter().map(|&(x, y)| Point::new(shift(x), shift(y))).collect();
        let sorted = sort(&points, threads);
        prop_assert_eq!(sorted.sites.len(), sorted.ids.len());
        prop_assert_eq!(sorted.ids.len() + sorted.duplicates.len(), points.len());
        let lowest = |point: Point| points.iter().position(|&p| p == point).map(|index| index as u32);
        let corner = |get: fn(&Point) -> u32| points.iter().map(get).min().unwrap_or(0);
        let (left, bottom) = (corner(|p| p.x), corner(|p| p.y));
        for (site, &id) in sorted.sites.iter().zip(&sorted.ids) {
            let point = points[id as usize];
            prop_assert_eq!(lowest(point), Some(id));
            prop_assert_eq!(*site, Site::from(Point::new(point.x - left, point.y - bottom)));
        }
        for duplicate in &sorted.duplicates {
            prop_assert_eq!(lowest(points[duplicate.index as usize]), Some(duplicate.of));
            prop_assert!(duplicate.of < duplicate.index);
        }
        let position = |site: &Site| position(Point::new(site.x(), site.y()));
        prop_assert!(sorted.sites.windows(2).all(|pair| position(&pair[0]) < position(&pair[1])));
    }
}

#[test]
fn words_are_exact_up_to_the_bits_that_say_so() {
    for points in [1, 2, 300, 4096, 16_384, 1_000_000, 1 << 25, (1 << 29) - 1] {
        for threads in [1, 2, 16, 300] {
            let bits = exact_bits(points, threads);
            assert!((22..=32).contains(&bits), "{points} points, {threads} threads: {bits}");
        }
    }
    // All points near the corners of a square are kept, in the widest square whose words are exact and in one of one
    // bit more.
    for bits in [exact_bits(5000, 1), exact_bits(5000, 1) + 1] {
        let last = ((1u64 << bits) - 1) as u32;
        let near = |k: u32| Point::new(if k & 1 == 0 { k } else { last - k }, if k & 2 == 0 { k } else { last - k });
        let points: Vec<Point> = (0..5000).map(near).collect();
        let Sites { sites, ids, duplicates, bits: found } = sort(&points, 1);
        assert_eq!((sites.len(), duplicates.len(), found), (5000, 0, bits));
        assert!(ids.iter().zip(&sites).all(|(&id, &site)| Site::from(points[id as usize]) == site));
        assert!(sites.is_sorted_by_key(|site| position(Point::new(site.x(), site.y()))));
    }
}
