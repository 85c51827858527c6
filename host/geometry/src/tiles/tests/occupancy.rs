//! Meshes by tiles that know where points are.

use core::num::NonZeroUsize;

use incircle_testkit::{generate, Distribution, SplitMix64};

use super::sets::{tie_rich, SIDE};
use super::*;
use crate::order::z_curve::position;
use crate::point::Point;
use crate::tiles::{join_among, local_among, Border, Occupancy, OccupiedCells, Step, Tree};

fn occupancy_of(points: &[Point], bits: u32) -> Occupancy {
    let mut cells = OccupiedCells::new(bits);
    points.iter().for_each(|&point| cells.add(point));
    cells.finish()
}

/// The mesh by tiles of at most `most` points, and the number of points in the joins of the last one.
fn by_tiles(points: &[Point], most: usize, occupancy: &Occupancy) -> (Mesh, usize) {
    let mut curve: Vec<u32> = (0..points.len() as u32).collect();
    curve.sort_by_key(|&id| position(points[id as usize].x, points[id as usize].y));
    let positions: Vec<u64> = curve.iter().map(|&id| position(points[id as usize].x, points[id as usize].y)).collect();
    let tree = Tree::of_positions(&positions, NonZeroUsize::new(most).unwrap());
    let mut found = Found { points: points.to_vec(), triangles: Vec::new(), duplicates: Vec::new(), unknown: 0 };
    let mut borders: Vec<Border<Point, u32>> = Vec::new();
    let (mut hull, mut last) = (Vec::new(), 0);
    for step in tree.steps() {
        let tile = match step {
            Step::Tile { region, points: range } => {
                let ids = &curve[range.clone()];
                let mesh = mesh_of(&ids.iter().map(|&id| points[id as usize]).collect::<Vec<_>>());
                found.duplicates.extend(mesh.duplicates.iter().map(|duplicate| {
                    let [index, of] = [duplicate.index, duplicate.of].map(|place| ids[place as usize]);
                    Duplicate { index, of }
                }));
                local_among(&mesh, ids, *region, occupancy)
            }
            Step::Join { region, children } => {
                let children = borders.split_off(borders.len() - children);
                last = children.iter().map(|child| child.points.len()).sum();
                join_among(*region, children, occupancy)
            }
        };
        let tile = tile.expect("the steps fit");
        found.triangles.extend(tile.finals);
        borders.push(tile.border);
        hull = tile.hull;
    }
    let Found { points, mut triangles, mut duplicates, .. } = found;
    triangles.sort_unstable();
    duplicates.sort_unstable();
    (Mesh { points, triangles, hull, duplicates }, last)
}

#[test]
fn tie_rich_sets_have_the_mesh_of_all_points() {
    for seed in 0..10_000 {
        let points = tie_rich(seed);
        let expected = mesh_of(&points);
        let occupancy = occupancy_of(&points, 4);
        for most in [1, 2, 4, 7] {
            assert!(by_tiles(&points, most, &occupancy).0 == expected, "{seed} {most}: {points:?}");
        }
    }
}

/// Sets at the ends of the grid of 32 bits, where cells have 2^20 places on a side.
#[test]
fn wide_sets_have_the_mesh_of_all_points() {
    for seed in 0..1000 {
        let mut random = SplitMix64::new(seed);
        let scale = u32::MAX / (SIDE - 1);
        let mut points: Vec<Point> =
            tie_rich(seed).iter().map(|point| Point::new(scale * point.x, scale * point.y)).collect();
        points.extend((0..9).map(|_| Point::new(random.next_u64() as u32, random.next_u64() as u32)));
        let expected = mesh_of(&points);
        let occupancy = occupancy_of(&points, 32);
        for most in [2, 5] {
            assert!(by_tiles(&points, most, &occupancy).0 == expected, "{seed} {most}: {points:?}");
        }
    }
}

/// The sets have points on the hull that no join can leave out: about 5,000 of the circle and of the parabola.
#[test]
fn the_large_empty_discs_of_curves_are_final() {
    use Distribution::{Circle, Parabola, Spiral, TwoChains};
    for (set, share) in [(Parabola, 0.5), (Circle, 0.5), (TwoChains, 0.7), (Spiral, 0.95)] {
        let points = generate(set, 60_000, 18, 1).expect("a set of 18 bits");
        let points: Vec<Point> = points.into_iter().map(Point::from).collect();
        let expected = mesh_of(&points);
        let everywhere = Occupancy::of_stretches(20, vec![[0, 1 << 24]]).expect("all cells of the grid");
        let [plain, knowing] =
            [everywhere, occupancy_of(&points, 18)].map(|occupancy| by_tiles(&points, 8_000, &occupancy));
        assert!(plain.0 == expected && knowing.0 == expected, "{set:?}");
        let [plain, knowing] = [plain.1, knowing.1];
        assert!((knowing as f64) < share * plain as f64, "{set:?}: {plain} and {knowing} points are joined last");
    }
}

/// A point that was left out would be in the disc of a triangle that counts as final.
#[test]
fn points_of_more_bits_than_announced_are_kept() {
    for seed in 0..2000 {
        let points = tie_rich(seed);
        let expected = mesh_of(&points);
        for bits in [0, 1, 2] {
            let found = by_tiles(&points, 2, &occupancy_of(&points, bits)).0;
            assert!(found == expected, "{seed} {bits}: {points:?}");
        }
    }
    let far = [(u32::MAX, 0), (0, u32::MAX), (5, 5)].map(Point::from);
    for bits in [0, 5, 11, 13] {
        let occupancy = occupancy_of(&far, bits);
        // The corners of the grid are in three of the cells, which follow each other only if they are few.
        let cells: u32 = occupancy.stretches().iter().map(|[first, end]| end - first).sum();
        assert_eq!(cells, 3, "{bits}: {occupancy:?}");
        assert!(!occupancy
            .beyond(&crate::tiles::Region { east: Some(9), ..crate::tiles::Region::WHOLE })
            .is_clear(far));
    }
}

#[test]
fn cells_become_larger_where_there_are_too_many_stretches() {
    let board: Vec<Point> = (0..1u32 << 20).map(|k| Point::new(2 * (k % 1024), 2 * (k / 1024))).collect();
    let occupancy = occupancy_of(&board, 11);
    assert_eq!((occupancy.shift(), occupancy.stretches()), (1, &[[0, 1 << 20]][..]));
    let read = Occupancy::of_stretches(occupancy.shift(), occupancy.stretches().to_vec());
    assert_eq!(read, Some(occupancy));
    for wrong in [vec![[0, 5], [5, 9]], vec![[3, 3]], vec![[9, 7]], vec![[0, (1 << 24) + 1]]] {
        assert_eq!(Occupancy::of_stretches(3, wrong.clone()), None, "{wrong:?}");
    }
    assert_eq!(Occupancy::of_stretches(33, Vec::new()), None);
}
