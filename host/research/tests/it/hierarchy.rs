//! Tests that points inserted one at a time give the mesh of every other way of insertion, whatever arrives.

use incircle::{triangulate, Point};
use incircle_geometry::cpu::Error;
use incircle_research::Hierarchy;
use incircle_testkit::SplitMix64;

/// Inserts all points, one at a time, and checks the mesh from time to time and at the end.
fn check(points: &[Point]) -> Hierarchy {
    let mut hierarchy = Hierarchy::new();
    for (arrived, &point) in points.iter().enumerate() {
        let first = points[..arrived].iter().position(|&p| p == point).map(|index| index as u32);
        assert_eq!(hierarchy.insert(point).expect("a sound point"), first, "{point}");
        if arrived.is_power_of_two() || arrived + 1 == points.len() {
            let mesh = hierarchy.mesh();
            let other = triangulate(&points[..=arrived]).expect("a mesh");
            assert!(mesh == other, "{arrived} points");
        }
    }
    assert_eq!(hierarchy.points(), points);
    hierarchy
}

#[test]
fn no_points_have_a_mesh() {
    let mesh = Hierarchy::new().mesh();
    assert!(mesh.is_collinear() && mesh.points.is_empty() && mesh.hull.is_empty());
}

#[test]
fn random_points_of_every_width_with_duplicates() {
    let mut random = SplitMix64::new(21);
    for bits in [1, 3, 6, 16, 24, 31] {
        for count in [1, 2, 3, 40, 2000] {
            let hierarchy = check(&random.points(count, 1 << bits));
            hierarchy.mesh().verify().expect("the canonical mesh");
        }
    }
}

#[test]
fn lines_that_are_left_late_or_never() {
    let line = |k: u32| Point::new(1000 + k * 37 % 1009 * 2, 500 + k * 37 % 1009);
    let along: Vec<Point> = (0..1200).map(line).collect();
    assert!(check(&along).mesh().is_collinear());
    for beside in [Point::new(0, 0), Point::new(1_000_000, 3)] {
        let left: Vec<Point> = along.iter().copied().chain([beside]).chain((0..400).map(line)).collect();
        check(&left);
    }
    // The first point lies beside the line, so that the points of the upper levels lie on the line.
    let first: Vec<Point> = [Point::new(9, 4000), Point::new(1000, 500)].into_iter().chain(along).collect();
    check(&first);
}

#[test]
fn lattices_and_parabolas_in_the_order_of_their_rows() {
    check(&(0..1600).map(|k| Point::new(k / 40 * 3, k % 40 * 3)).collect::<Vec<_>>());
    check(&(0..250).map(|k| Point::new(k, k * k)).collect::<Vec<_>>());
}

#[test]
fn walks_do_not_grow_with_the_points() {
    let mut random = SplitMix64::new(22);
    let walk = |points: &[Point]| {
        let mut hierarchy = Hierarchy::new();
        points.iter().for_each(|&point| assert_eq!(hierarchy.insert(point).ok(), Some(None)));
        let counters = hierarchy.counts();
        assert_eq!(counters.insertions as usize, points.len());
        f64::from(counters.walk_visits) / points.len() as f64
    };
    let (few, many) = (walk(&random.points(1000, 1 << 31)), walk(&random.points(64_000, 1 << 31)));
    // Walks lead from one level to the next. A walk from the last point would be eight times as long.
    assert!(many < 2.5 * few && many < 40.0, "{few} and {many} triangles a walk");
}

#[test]
fn points_beyond_the_grid_are_named_and_not_taken() {
    let mut hierarchy = Hierarchy::new();
    assert_eq!(hierarchy.insert(Point::new(1, 1)).ok(), Some(None));
    let error = hierarchy.insert(Point::new(0, 1 << 31)).expect_err("too wide");
    assert!(matches!(error, Error::CoordinateOutOfRange { index: 1, .. }), "{error}");
    assert_eq!(hierarchy.points().len(), 1);
}
