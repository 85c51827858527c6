//! Sets of thousands of points, of every distribution.

use core::num::NonZeroUsize;

use incircle_testkit::{generate, Distribution};

use super::*;
use crate::order::z_curve::position;
use crate::point::Point;
use crate::tiles::{triangulate, Step, Tree};

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

/// A tree of a tenth of the points cuts all of them: points between the cells of the sample belong to tiles, too.
#[test]
fn a_tree_of_a_sample_cuts_the_whole_set() {
    for &distribution in Distribution::all() {
        let Ok(points) = generate(distribution, 2000, 20, 8) else { continue };
        let points: Vec<Point> = points.into_iter().map(Point::from).collect();
        let sample = points.iter().step_by(10).map(|point| position(point.x, point.y));
        let mut sample: Vec<u64> = sample.collect();
        sample.sort_unstable();
        let tree = Tree::of_positions(&sample, NonZeroUsize::new(8).unwrap());
        let mut tiles = vec![Vec::new(); tree.tiles().count()];
        for (id, &point) in (0..).zip(&points) {
            tiles[tree.tile_of(point)].push(id);
        }
        let (mut tiles, mut stack, mut triangles, mut hull) = (tiles.iter(), Vec::new(), Vec::new(), Vec::new());
        for step in tree.steps() {
            let tile = match step {
                Step::Tile { region, .. } => {
                    let ids: &Vec<u32> = tiles.next().unwrap();
                    let own: Vec<Point> = ids.iter().map(|&id| points[id as usize]).collect();
                    local(&mesh_of(&own), ids, *region).unwrap()
                }
                Step::Join { region, children } => join(*region, stack.split_off(stack.len() - children)).unwrap(),
            };
            triangles.extend(tile.finals);
            stack.push(tile.border);
            hull = tile.hull;
        }
        triangles.sort_unstable();
        let expected = mesh_of(&points);
        assert!((triangles, hull) == (expected.triangles, expected.hull), "{}", distribution.name());
    }
}
