//! The tree of regions.

use core::num::NonZeroUsize;

use incircle_testkit::SplitMix64;

use crate::order::z_curve::position;
use crate::point::Point;
use crate::tiles::{Region, Step, Tree};

fn most(points: usize) -> NonZeroUsize {
    NonZeroUsize::new(points).unwrap()
}

/// Sets with one crowded place, with crowds of several sizes, and with none.
fn sets(seed: u64) -> Vec<Point> {
    let mut random = SplitMix64::new(seed);
    let count = 1 + random.below(300);
    (0..count)
        .map(|_| {
            let bits = random.pick(&[1, 3, 12, 32]);
            Point::new(7 + (random.bits(bits) as u32 >> 1), random.bits(bits) as u32)
        })
        .collect()
}

fn along_the_curve(points: &[Point]) -> Vec<u64> {
    let mut positions: Vec<u64> = points.iter().map(|point| position(point.x, point.y)).collect();
    positions.sort_unstable();
    positions
}

/// Checks that the steps leave one border, that of the whole plane, and that all regions fit. Returns the most borders
/// that are on the stack.
fn check_steps(tree: &Tree) -> usize {
    let (mut stack, mut deepest): (Vec<Region>, usize) = (Vec::new(), 0);
    for step in tree.steps() {
        match step {
            Step::Tile { region, .. } => stack.push(*region),
            Step::Join { region, children } => {
                assert!((2..=4).contains(children), "{children}");
                let regions = stack.split_off(stack.len() - children);
                assert_eq!(Region::union_of(&regions), Some(*region));
                stack.push(*region);
            }
        }
        deepest = deepest.max(stack.len());
    }
    assert_eq!(stack, [Region::WHOLE]);
    deepest
}

#[test]
fn tiles_have_all_points_in_their_regions_and_not_too_many() {
    for seed in 0..300 {
        let points = sets(seed);
        let positions = along_the_curve(&points);
        for limit in [1, 2, 7, 50, 1000] {
            let tree = Tree::of_positions(&positions, most(limit));
            assert!(check_steps(&tree) <= 3 * 32 + 1);
            let mut end = 0;
            for (place, (region, range)) in tree.tiles().enumerate() {
                assert_eq!(range.start, end);
                end = range.end;
                let own = &positions[range];
                assert!(own.len() <= limit || own.first() == own.last(), "{} of {limit}", own.len());
                for &position in own {
                    let point = crate::order::z_curve::point_at(position);
                    assert!(region.contains([point.x.into(), point.y.into()]), "{region:?} {point}");
                    assert_eq!(tree.tile_of(point), place);
                }
            }
            assert_eq!(end, points.len());
        }
    }
}

#[test]
fn every_place_is_in_the_region_of_its_tile_alone() {
    let mut random = SplitMix64::new(4);
    for seed in 0..50 {
        let tree = Tree::of_positions(&along_the_curve(&sets(seed)), most(9));
        let tiles: Vec<Region> = tree.tiles().map(|(region, _)| region).collect();
        for _ in 0..200 {
            let bits = random.pick(&[3, 12, 32]);
            let point = Point::new(random.bits(bits) as u32, random.bits(bits) as u32);
            let place = [point.x.into(), point.y.into()];
            let found: Vec<usize> = (0..tiles.len()).filter(|&tile| tiles[tile].contains(place)).collect();
            assert_eq!(found, [tree.tile_of(point)]);
        }
    }
}

#[test]
fn a_histogram_of_all_cells_gives_the_tree_of_the_positions() {
    for seed in 0..50 {
        let mut random = SplitMix64::new(seed);
        let points: Vec<Point> =
            (0..500).map(|_| Point::new(random.next_u64() as u32, random.next_u64() as u32)).collect();
        let positions = along_the_curve(&points);
        for bits in [0, 1, 5, 10] {
            let mut counts = vec![0; 1 << bits];
            for &position in &positions {
                counts[position.checked_shr(64 - bits).unwrap_or(0) as usize] += 1;
            }
            let tree = Tree::of_histogram(&counts, most(40));
            check_steps(&tree);
            if bits == 10 {
                assert_eq!(tree, Tree::of_positions(&positions, most(40)));
            }
            assert_eq!(tree.tiles().map(|(_, range)| range.len()).sum::<usize>(), points.len());
        }
    }
    for counts in [&[][..], &[0], &[0, 0, 9], &[usize::MAX, usize::MAX, 1]] {
        check_steps(&Tree::of_histogram(counts, most(1)));
    }
}

#[test]
fn few_points_are_one_tile() {
    for positions in [&[][..], &[5], &[5, 5, 5, 5], &[u64::MAX; 9]] {
        let tree = Tree::of_positions(positions, most(1));
        assert_eq!(tree.steps(), [Step::Tile { region: Region::WHOLE, points: 0..positions.len() }]);
        assert_eq!(tree.tile_of(Point::new(3, 4)), 0);
    }
}
