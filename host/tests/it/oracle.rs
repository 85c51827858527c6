//! The software model and the CPU triangulator against a brute-force oracle on tiny grids, and the
//! validator against the oracle's meshes.

use crate::common::{brute_force, by_cpu, by_model, Random};
use incircle::{triangulate, verify, Point};

#[test]
fn every_subset_of_a_three_by_four_grid() {
    let grid: Vec<Point> = (0..12).map(|k| Point::new(k / 4, k % 4)).collect();
    for subset in 0u32..1 << 12 {
        let points: Vec<Point> = (0..12).filter(|k| subset >> k & 1 == 1).map(|k| grid[k as usize * 5 % 12]).collect();
        let solution = by_cpu(&points);
        let expected = brute_force(&points);
        assert_eq!(solution.mesh.triangles, expected, "{points:?}");
        assert_eq!(by_model(&points).mesh.triangles, expected, "{points:?}");
    }
}

#[test]
fn random_sets_with_duplicates_on_a_small_grid() {
    let mut random = Random(1);
    for round in 0..2000 {
        let count = 3 + random.below(14) as usize;
        let points = random.points(count, 3 + round % 8);
        let solution = by_cpu(&points);
        let expected = brute_force(&points);
        assert_eq!(solution.mesh.triangles, expected, "{points:?}");
        assert!(verify(&points, &expected).is_ok(), "{points:?}");
        assert_eq!(by_model(&points).mesh.triangles, expected, "{points:?}");
    }
}

#[test]
fn the_validator_refuses_every_flip_of_the_one_right_mesh() {
    let mut random = Random(2);
    for _ in 0..200 {
        let points = random.points(9, 6);
        let mesh = triangulate(&points).expect("a mesh");
        for (halfedge, &twin) in mesh.halfedges().iter().enumerate() {
            if twin == incircle::EMPTY {
                continue;
            }
            let (t, k) = (halfedge / 3, halfedge % 3);
            let (u, j) = (twin as usize / 3, twin as usize % 3);
            let (a, c) = (mesh.triangles[t][k], mesh.triangles[t][(k + 2) % 3]);
            let (b, d) = (mesh.triangles[u][j], mesh.triangles[u][(j + 2) % 3]);
            let mut flipped = mesh.triangles.clone();
            flipped[t] = [a, d, c];
            flipped[u] = [d, b, c];
            for triangle in [t, u] {
                let smallest = (0..3).min_by_key(|&k| flipped[triangle][k]).unwrap_or(0);
                flipped[triangle].rotate_left(smallest);
            }
            flipped.sort_unstable();
            assert!(verify(&points, &flipped).is_err(), "{points:?} {halfedge}");
        }
    }
}

/// Spoils a canonical list in some way. Every other list is wrong.
fn spoil(triangles: &mut Vec<[u32; 3]>, points: u32, random: &mut Random) {
    let place = random.below(triangles.len() as u32) as usize;
    let corner = random.below(3) as usize;
    match random.below(6) {
        0 => triangles[place][corner] = random.below(points),
        1 => triangles[place].rotate_left(1),
        2 => triangles[place].swap(0, corner),
        3 => drop(triangles.remove(place)),
        4 => triangles.insert(place, triangles[place]),
        _ => triangles[place] = [0, 1 + random.below(points), 1 + random.below(points)],
    }
    if random.below(2) == 0 {
        triangles.sort_unstable();
    }
}

#[test]
fn the_validator_accepts_the_canonical_list_and_no_other() {
    let mut random = Random(14);
    let mut refused = 0;
    for _ in 0..20_000 {
        let points = random.points(8, 5);
        let expected = triangulate(&points).expect("a mesh").triangles;
        if expected.is_empty() {
            continue;
        }
        let mut spoilt = expected.clone();
        for _ in 0..=random.below(2) {
            if !spoilt.is_empty() {
                spoil(&mut spoilt, points.len() as u32, &mut random);
            }
        }
        assert_eq!(verify(&points, &spoilt).is_ok(), spoilt == expected, "{points:?} {spoilt:?}");
        refused += usize::from(spoilt != expected);
    }
    assert!(refused > 15_000, "{refused}");
}
