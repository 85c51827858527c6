//! Small sets, cut in every way.

use core::num::NonZeroUsize;

use incircle_testkit::SplitMix64;

use super::sets::{tie_rich, SIDE};
use super::*;
use crate::point::Point;
use crate::tiles::triangulate;

/// The number of small sets.
const SETS: u64 = 10_000;

fn check(points: &[Point], expected: &Mesh, division: &Division<i64>) {
    let (found, unknown) = Found::mesh(points, division);
    assert!(found == *expected, "{division:?}: {found:?} instead of {expected:?}");
    assert_eq!(unknown, 0, "the answer of grid points is always known");
}

fn halves(regions: [Region; 2]) -> Division<i64> {
    Division::Areas(regions.map(|region| (region, Division::Tile)).to_vec())
}

#[test]
fn sets_cut_at_any_line_have_the_mesh_of_all_points() {
    for seed in 0..SETS {
        let points = tie_rich(seed);
        let expected = mesh_of(&points);
        for at in 0..=i64::from(SIDE) {
            check(&points, &expected, &halves(Region::WHOLE.split_at_x(at)));
            check(&points, &expected, &halves(Region::WHOLE.split_at_y(at)));
        }
    }
}

/// Divides a region into four at random lines, and their quarters again, and joins all four or two by two.
fn quarters(random: &mut SplitMix64, region: Region, levels: u32) -> Division<i64> {
    if levels == 0 {
        return Division::Tile;
    }
    let [x, y] = [(); 2].map(|()| random.below(u64::from(SIDE) + 1) as i64);
    // The sides of the region bound the lines, so some parts have no place.
    let inner = |low: Option<i64>, high: Option<i64>, at: i64| at.max(low.unwrap_or(at)).min(high.unwrap_or(i64::MAX));
    let (x, y) = (inner(region.west, region.east, x), inner(region.south, region.north, y));
    let mut divided = |region: Region, levels: u32| (region, quarters(random, region, levels));
    let halves = region.split_at_x(x);
    if levels.is_multiple_of(2) {
        return Division::Areas(
            halves.iter().flat_map(|half| half.split_at_y(y)).map(|area| divided(area, levels - 1)).collect(),
        );
    }
    let by_half = |half: Region| {
        let areas = half.split_at_y(y).map(|area| divided(area, levels - 1));
        (half, Division::Areas(areas.to_vec()))
    };
    Division::Areas(halves.map(by_half).to_vec())
}

#[test]
fn sets_cut_into_quarters_again_and_again_have_the_mesh_of_all_points() {
    let mut random = SplitMix64::new(17);
    for seed in 0..SETS {
        let points = tie_rich(seed);
        let expected = mesh_of(&points);
        for levels in 1..=3 {
            check(&points, &expected, &quarters(&mut random, Region::WHOLE, levels));
        }
    }
}

#[test]
fn sets_cut_along_the_curve_have_the_mesh_of_all_points() {
    for seed in 0..SETS {
        let points = tie_rich(seed);
        let expected = mesh_of(&points);
        for most in [1, 2, 4, 7] {
            let most = NonZeroUsize::new(most).unwrap();
            assert_eq!(triangulate(points.clone(), most).as_ref(), Ok(&expected), "{seed} {most}");
        }
    }
}

/// Sets whose coordinates reach the ends of the grid of 32 bits, and of others on which the exact stage of `reach`
/// changes its width.
#[test]
fn the_widest_sets_have_the_mesh_of_all_points() {
    for bits in [16, 19, 20, 21, 31, 32] {
        let end = ((1u64 << bits) - 1) as u32;
        for seed in 0..400 {
            let mut random = SplitMix64::new(seed);
            let scale = end / (SIDE - 1);
            let mut points = tie_rich(seed);
            for point in &mut points {
                *point = Point::new(scale * point.x, scale * point.y);
            }
            points.extend([(0, 0), (end, 0), (0, end), (end, end)].map(Point::from));
            points.extend((0..4).map(|_| Point::new(random.bits(bits) as u32, random.bits(bits) as u32)));
            let expected = mesh_of(&points);
            for at in [1, i64::from(scale), i64::from(scale) + 1, i64::from(end / 2), i64::from(end)] {
                check(&points, &expected, &halves(Region::WHOLE.split_at_x(at)));
                check(&points, &expected, &halves(Region::WHOLE.split_at_y(at)));
            }
            assert_eq!(triangulate(points, NonZeroUsize::new(3).unwrap()), Ok(expected));
        }
    }
}

/// A region need not have a point, and a join may have a single child.
#[test]
fn regions_without_points_change_nothing() {
    for seed in 0..200 {
        let points = tie_rich(seed);
        let expected = mesh_of(&points);
        let [low, high] = Region::WHOLE.split_at_x(100);
        let nested = Division::Areas(vec![(low, Division::Areas(vec![(low, Division::Tile)])), (high, Division::Tile)]);
        check(&points, &expected, &nested);
        check(&points, &expected, &Division::Areas(vec![(Region::WHOLE, Division::Tile)]));
    }
    assert_eq!(Found::<Point>::mesh(&[], &Division::Areas(Vec::new())).0, mesh_of::<Point>(&[]));
}

/// All triangles of the set are final in one tile, so none is left at the join; the hull of the whole set must begin
/// with its lowest index nevertheless.
#[test]
fn the_hull_is_canonical_where_no_triangle_is_left_for_a_join() {
    let points = [(1, 3), (0, 5), (1, 2)].map(Point::from);
    let [south, north] = Region::WHOLE.split_at_y(200);
    let division = Division::Areas(vec![
        (south, Division::Areas(south.split_at_x(1).map(|region| (region, Division::Tile)).to_vec())),
        (north, Division::Tile),
    ]);
    for order in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1]] {
        let points = order.map(|place: usize| points[place]);
        check(&points, &mesh_of(&points), &division);
    }
}

/// Ids may be of any type and in any order: here they count backwards from a number that 32 bits do not hold.
#[test]
fn triangles_and_hull_name_points_by_the_ids_of_the_caller() {
    for seed in 0..500 {
        let mut points = tie_rich(seed);
        points.sort_unstable();
        points.dedup();
        let name = |place: usize| (1 << 40) + (points.len() - 1 - place) as u64;
        let (mut triangles, mut borders) = (Vec::new(), Vec::new());
        for region in Region::WHOLE.split_at_x(5) {
            let own: Vec<usize> = (0..points.len()).filter(|&k| region.contains(points[k].place())).collect();
            let ids: Vec<u64> = own.iter().map(|&place| name(place)).collect();
            let mesh = mesh_of(&own.iter().map(|&place| points[place]).collect::<Vec<_>>());
            let tile = local(&mesh, &ids, region).unwrap();
            triangles.extend(tile.finals);
            borders.push(tile.border);
        }
        let last = join(Region::WHOLE, borders).unwrap();
        triangles.extend(last.finals);
        triangles.sort_unstable();
        let backwards: Vec<Point> = points.iter().rev().copied().collect();
        let expected = mesh_of(&backwards);
        let named = |place: u32| (1 << 40) + u64::from(place);
        assert_eq!(triangles, expected.triangles.iter().map(|t| t.map(named)).collect::<Vec<_>>());
        assert_eq!(last.hull, expected.hull.iter().map(|&place| named(place)).collect::<Vec<_>>());
    }
}
