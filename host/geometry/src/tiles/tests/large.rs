//! Sets of thousands of points, of every distribution.

use core::num::NonZeroUsize;

use incircle_testkit::{generate, Distribution};

use super::*;
use crate::order::z_curve::position;
use crate::point::Point;
use crate::tiles::{triangulate, Tree};

#[test]
fn every_distribution_has_the_mesh_of_all_points() {
    for &distribution in Distribution::all() {
        for (count, bits, most) in [(3000, 31, 100), (3000, 12, 40), (500, 5, 16)] {
            let Ok(points) = generate(distribution, count, bits, 11) else { continue };
            let points: Vec<Point> = points.into_iter().map(Point::from).collect();
            let expected = mesh_of(&points);
            let most = NonZeroUsize::new(most).unwrap();
            assert!(triangulate(points, most) == Ok(expected), "{} {count} {bits}", distribution.name());
        }
    }
}

/// An even set has about `12 sqrt(n)` points of `n` in the border of a tile; the share is printed by the example.
#[test]
fn most_points_of_a_tile_are_final() {
    let points: Vec<Point> =
        generate(Distribution::Uniform, 40_000, 24, 5).unwrap().into_iter().map(Point::from).collect();
    let mut curve: Vec<(u64, u32)> = points.iter().map(|point| position(point.x, point.y)).zip(0..).collect();
    curve.sort_unstable();
    let positions: Vec<u64> = curve.iter().map(|&(position, _)| position).collect();
    let tree = Tree::of_positions(&positions, NonZeroUsize::new(8192).unwrap());
    let mut border = 0;
    for (region, range) in tree.tiles() {
        let ids: Vec<u32> = curve[range].iter().map(|&(_, id)| id).collect();
        let own: Vec<Point> = ids.iter().map(|&id| points[id as usize]).collect();
        let tile = local(&mesh_of(&own), &ids, region).unwrap();
        assert_eq!(tile.unknown, 0);
        border += tile.border.points.len();
    }
    assert!(border < points.len() / 6, "{border} of {} points are in borders", points.len());
}
