//! The theorem needs discs that lie strictly within a region: those that touch a side must not count.

use std::collections::BTreeSet;

use incircle_testkit::SplitMix64;

use super::*;
use crate::point::Point;

/// Whether the closed disc of a counter-clockwise triangle stays on one side of the lines that the points beyond a
/// region are on at the nearest. It may touch them if `touching` is true. For coordinates of few bits.
fn is_within(region: &Region, [a, b, c]: [Point; 3], touching: bool) -> bool {
    let vector = |p: Point| [i128::from(p.x) - i128::from(a.x), i128::from(p.y) - i128::from(a.y)];
    let (b, c) = (vector(b), vector(c));
    let lift = |v: [i128; 2]| v[0] * v[0] + v[1] * v[1];
    let twice = 2 * (b[0] * c[1] - b[1] * c[0]);
    let center = [c[1] * lift(b) - b[1] * lift(c), b[0] * lift(c) - c[0] * lift(b)];
    let radius = lift(center);
    let a = [i128::from(a.x), i128::from(a.y)];
    let clears = |gap: i128| gap > 0 && (gap * gap > radius || touching && gap * gap == radius);
    let is_above = |line: Option<i64>, axis: usize| {
        line.is_none_or(|line| clears(center[axis] - (i128::from(line) - 1 - a[axis]) * twice))
    };
    let is_below = |line: Option<i64>, axis: usize| {
        line.is_none_or(|line| clears((i128::from(line) - a[axis]) * twice - center[axis]))
    };
    is_above(region.west, 0) && is_below(region.east, 0) && is_above(region.south, 1) && is_below(region.north, 1)
}

/// The triangles of a set by four quadrants and one join, in the plainest form: sets of points and triangles.
fn by_quadrants(points: &[Point], at: i64, touching: bool) -> BTreeSet<[Point; 3]> {
    let corners = |mesh: &Mesh| -> BTreeSet<[Point; 3]> {
        mesh.triangles.iter().map(|t| t.map(|place| mesh.points[place as usize])).collect()
    };
    let (mut kept, mut open, mut border) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
    let quadrants: Vec<Region> = Region::WHOLE.split_at_x(at).iter().flat_map(|half| half.split_at_y(at)).collect();
    for quadrant in &quadrants {
        // Sorted, so that triangles of quadrants and of the join have the same corner first.
        let own: BTreeSet<Point> = points.iter().copied().filter(|point| quadrant.contains(point.place())).collect();
        let mesh = mesh_of(&own.into_iter().collect::<Vec<_>>());
        border.extend(mesh.hull.iter().map(|&place| mesh.points[place as usize]));
        for triangle in corners(&mesh) {
            if is_within(quadrant, triangle, touching) {
                kept.insert(triangle);
            } else {
                border.extend(triangle);
                open.insert(triangle);
            }
        }
    }
    let quadrant_of = |point: Point| quadrants.iter().position(|quadrant| quadrant.contains(point.place()));
    let joined = corners(&mesh_of(&border.into_iter().collect::<Vec<_>>()));
    kept.extend(joined.into_iter().filter(|triangle| {
        let [a, b, c] = triangle.map(quadrant_of);
        a != b || b != c || open.contains(triangle)
    }));
    kept
}

#[test]
fn a_disc_that_touches_a_side_must_not_count_as_within() {
    let (mut wrong, mut strict_wrong, sets) = (0, 0, 2000);
    for seed in 0..sets {
        let mut random = SplitMix64::new(seed);
        let side = random.pick(&[6, 8]);
        let points: BTreeSet<Point> =
            (0..30).map(|_| Point::new(random.below_u32(side), random.below_u32(side))).collect();
        let points: Vec<Point> = points.into_iter().collect();
        let mesh = mesh_of(&points);
        let expected: BTreeSet<[Point; 3]> =
            mesh.triangles.iter().map(|t| t.map(|place| points[place as usize])).collect();
        strict_wrong += usize::from(by_quadrants(&points, i64::from(side / 2), false) != expected);
        wrong += usize::from(by_quadrants(&points, i64::from(side / 2), true) != expected);
    }
    assert_eq!(strict_wrong, 0);
    assert!(wrong > sets as usize / 100, "only {wrong} of {sets} meshes are wrong if discs may touch sides");
    println!("{wrong} of {sets} meshes are wrong if discs may touch sides");
}
