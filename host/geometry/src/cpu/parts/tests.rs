//! Joins of parts, compared with the mesh of the whole set.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use super::super::{triangulate, Connectivity};
use super::open::take_open;
use super::{Parts, SolvedPart, Unsound};
use crate::mesh::Mesh;
use crate::order::mix;
use crate::point::Point;
use crate::tiles::reach::{Reach, TilePoint};

const ONE: NonZeroUsize = NonZeroUsize::MIN;

fn mesh_of(points: Vec<Point>) -> Mesh {
    triangulate(points, ONE, &mut |_| ControlFlow::Continue(())).expect("few points")
}

/// Random numbers of one test: number `k` below `limit`.
fn random(k: u64, limit: usize) -> usize {
    (mix(k) % limit.max(1) as u64) as usize
}

/// The solved parts of a set.
fn solved(parts: &Parts) -> Vec<SolvedPart> {
    let solve = |part| {
        let mesh = mesh_of(parts.points(part));
        parts.solved(part, mesh.triangles, &mesh.hull).expect("a sound mesh")
    };
    (0..parts.count()).map(solve).collect()
}

/// Holds the join of parts of up to `most` points against the mesh of the whole set. Returns the number of parts.
fn compare(points: &[Point], most: usize, threads: usize) -> usize {
    let threads = NonZeroUsize::new(threads).unwrap_or(ONE);
    let whole = mesh_of(points.to_vec());
    let parts = Parts::divide(points, most, threads).expect("few points");
    let count = parts.count();
    assert_eq!(count > 1, parts.distinct() > most.max(3));
    assert!((0..count).all(|part| parts.points(part).len() <= most.max(3)));
    let mut solved = solved(&parts);
    // The order of the parts does not matter.
    solved.reverse();
    let joined = parts.join(solved, threads).expect("sound parts");
    let Mesh { triangles, hull, duplicates, .. } = whole;
    assert!(joined == Connectivity { triangles, hull, duplicates }, "{most} of {points:?}");
    count
}

/// A point of a kind of sets that is rich in ties, on a grid of `side` lines.
fn tied(kind: usize, k: u64, side: u32) -> Point {
    let below = |k: u64, limit: u32| random(k, limit as usize) as u32;
    let at = |k| below(2 * k, side);
    let other = |k| below(2 * k + 1, side);
    match kind {
        // A lattice, with duplicates.
        0 => Point::new(at(k), other(k)),
        // Two lines.
        1 => Point::new(at(k), below(2 * k + 1, 2) * (side - 1)),
        // A rising or falling line, and points beside it.
        2 if below(k, 8) > 0 => Point::new(at(k), side - 1 - at(k)),
        // A circle, whose points are all on one circumscribed circle.
        3 => {
            let [x, y] = [[0, 5], [3, 4], [4, 3], [5, 0]][random(3 * k, 4)];
            let sign = |bit: u64, v: u32| if mix(3 * k + 1) >> bit & 1 == 0 { 5 + v } else { 5 - v };
            Point::new(sign(0, x), sign(1, y))
        }
        // A cross.
        4 if below(k, 2) == 0 => Point::new(at(k), side / 2),
        4 => Point::new(side / 2, other(k)),
        // A crowd in a corner, and a few points far from it.
        5 if below(k, 4) > 0 => Point::new(at(k) / 4, other(k) / 4),
        _ => Point::new(at(k), other(k)),
    }
}

#[test]
fn parts_of_tied_points_join_to_the_mesh_of_the_whole() {
    let mut most_parts = 0;
    for case in 0..24_000u64 {
        let (kind, side) = (case as usize % 6, [2, 3, 4, 6, 9, 17][random(case, 6)]);
        let count = random((case + 1) << 20, 60);
        let points: Vec<Point> = (0..count as u64).map(|k| tied(kind, case * 1000 + k, side)).collect();
        most_parts = most_parts.max(compare(&points, 3 + random((case + 2) << 20, 12), 1));
    }
    assert!(most_parts > 10);
}

#[test]
fn parts_of_many_points_join_to_the_mesh_of_the_whole() {
    for bits in [8, 12, 16, 21, 26, 31, 32] {
        let coordinate = |k: u64| (mix(k) >> (64 - bits)) as u32;
        let uniform: Vec<Point> = (0..30_000).map(|k| Point::new(coordinate(2 * k), coordinate(2 * k + 1))).collect();
        let line: Vec<Point> = uniform.iter().map(|p| Point::new(p.x, (p.x / 3).wrapping_add(p.y & 1))).collect();
        let crowd: Vec<Point> = uniform.iter().map(|p| Point::new(p.x >> (p.y & 7), p.y >> (p.x & 7))).collect();
        for points in [&uniform, &line, &crowd] {
            for (most, threads) in [(3, 2), (100, 2), (2048, 3), (8192, 1)] {
                compare(points, most, threads);
            }
        }
    }
}

#[test]
fn points_that_need_no_parts_are_right() {
    assert_eq!(compare(&[], 3, 1), 0);
    assert_eq!(compare(&[Point::new(7, 7); 5], 3, 1), 1);
    let line: Vec<Point> = (0..50).map(|k| Point::new(3 * k, 200 - 2 * k)).collect();
    assert!(compare(&line, 4, 1) > 10);
    assert_eq!(compare(&[(0, 0), (1, 0), (0, 1), (1, 1)].map(Point::from), 0, 1), 2);
    let far = [(0, 0), (u32::MAX, u32::MAX), (0, u32::MAX), (u32::MAX, 0), (1 << 31, 1 << 31)];
    assert!(compare(&far.map(Point::from), 3, 1) > 1);
}

#[test]
fn nearly_all_triangles_of_large_parts_are_final() {
    let points: Vec<Point> =
        (0..40_000).map(|k| Point::new(mix(2 * k) as u32 >> 12, mix(2 * k + 1) as u32 >> 12)).collect();
    let parts = Parts::divide(&points, 8192, ONE).expect("few points");
    let solved = solved(&parts);
    let border: usize = solved.iter().map(SolvedPart::border).sum();
    let finals: usize = solved.iter().map(SolvedPart::finals).sum();
    assert!(border * 10 < points.len() && finals * 10 > 17 * points.len(), "{border} {finals}");
}

/// Holds the open triangles that the search finds against a test of each triangle. Returns how many they are.
fn compare_open(points: &[Point], most: usize) -> usize {
    let parts = Parts::divide(points, most, ONE).expect("few points");
    let count = |part: usize| {
        let range = parts.range(part).expect("a part");
        let (region, own) = (parts.region(&range), parts.points(part));
        let Mesh { triangles, hull, .. } = mesh_of(own.clone());
        let mut left = triangles.clone();
        let mut found = take_open(&mut left, &hull, &parts.sites[range], &region, parts.far).expect("a sound mesh");
        let sides = Point::sides(&region);
        let is_open = |corners: &[u32; 3]| Point::reach(&sides, corners.map(|v| own[v as usize])) != Reach::Within;
        let (mut open, mut finals): (Vec<[u32; 3]>, _) = triangles.into_iter().partition(is_open);
        [&mut left, &mut found, &mut open, &mut finals].into_iter().for_each(|list| list.sort_unstable());
        assert!(found == open && left == finals, "part {part} of {most} of {points:?}");
        open.len()
    };
    (0..parts.count()).map(count).sum()
}

#[test]
fn the_search_finds_every_open_triangle() {
    for case in 0..12_000u64 {
        let (kind, side) = (case as usize % 6, [3, 6, 17, 60][random(case, 4)]);
        let points: Vec<Point> = (0..80).map(|k| tied(kind, case * 1000 + k, side)).collect();
        compare_open(&points, 3 + random((case + 2) << 20, 40));
    }
    let coordinate = |k: u64| (mix(k) >> 48) as u32;
    let even: Vec<Point> = (0..20_000).map(|k| Point::new(coordinate(2 * k), coordinate(2 * k + 1))).collect();
    // Discs of open triangles reach far into parts that have a corner in a large hole, and between curves.
    let is_outside =
        |p: &&Point| (i64::from(p.x) - 32_768).pow(2) + (i64::from(p.y) - 32_768).pow(2) > 20_000i64.pow(2);
    let hollow: Vec<Point> = even.iter().filter(is_outside).copied().collect();
    let curve = |p: &Point| Point::new(p.x, p.x / 256 * (p.x / 256) / (1 + (p.y & 1)));
    let curves: Vec<Point> = even.iter().map(curve).collect();
    for points in [&even, &hollow, &curves] {
        for most in [50, 1000, 6000] {
            assert!(compare_open(points, most) > 100);
        }
    }
}

/// Changes a mesh in one of many ways.
fn mutate(change: u64, triangles: &mut Vec<[u32; 3]>, hull: &mut Vec<u32>, points: usize) {
    let pick = |k: u64, length: usize| random(100 * change + k, length);
    let at = pick(1, triangles.len());
    match pick(0, 8) {
        0 if !triangles.is_empty() => drop(triangles.swap_remove(at)),
        1 if !triangles.is_empty() => triangles.push(triangles[at]),
        2 if !triangles.is_empty() => triangles[at].swap(0, 1),
        3 if !triangles.is_empty() => triangles[at][pick(2, 3)] = pick(3, points) as u32,
        4 if !hull.is_empty() => {
            hull.remove(pick(2, hull.len()));
        }
        5 if !hull.is_empty() => {
            let place = pick(2, hull.len());
            hull[place] = pick(3, points) as u32;
        }
        6 => hull.reverse(),
        _ => triangles.iter_mut().flatten().chain(hull).for_each(|v| *v = (*v + 1) % points as u32),
    }
}

#[test]
fn wrong_meshes_of_parts_end_in_errors_or_wrong_meshes() {
    let (mut refused, mut joined) = (0, 0);
    for case in 0..20_000u64 {
        let side = [5, 17, 200][random(case, 3)];
        let points: Vec<Point> = (0..40).map(|k| tied(0, case * 1000 + k, side)).collect();
        let parts = Parts::divide(&points, 3 + random(case + 7, 12), ONE).expect("few points");
        if parts.count() < 2 {
            continue;
        }
        let wrong = random(case + 9, parts.count());
        let solve = |part| {
            let Mesh { mut triangles, mut hull, .. } = mesh_of(parts.points(part));
            for change in 0..if part == wrong { 1 + random(case, 3) as u64 } else { 0 } {
                mutate(3 * case + change, &mut triangles, &mut hull, parts.points(part).len());
            }
            parts.solved(part, triangles, &hull)
        };
        let solved: Result<Vec<SolvedPart>, Unsound> = (0..parts.count()).map(solve).collect();
        match solved.and_then(|solved| parts.join(solved, ONE)) {
            Ok(_) => joined += 1,
            Err(Unsound) => refused += 1,
        }
    }
    assert!(refused > 5000 && joined > 0, "{refused} refused, {joined} joined");
}

#[test]
fn missing_doubled_and_foreign_parts_are_refused() {
    let points: Vec<Point> = (0..100).map(|k| tied(0, k, 50)).collect();
    let parts = || Parts::divide(&points, 20, ONE).expect("few points");
    let mut missing = solved(&parts());
    missing.pop();
    assert_eq!(parts().join(missing, ONE), Err(Unsound));
    let mut doubled = solved(&parts());
    doubled.extend(solved(&parts()).pop());
    assert_eq!(parts().join(doubled, ONE), Err(Unsound));
    let others: Vec<Point> = (0..100).map(|k| tied(0, k + 1000, 50)).collect();
    let foreign = solved(&Parts::divide(&others, 20, ONE).expect("few points"));
    assert_eq!(parts().join(foreign, ONE), Err(Unsound));
    assert!(parts().solved(99, vec![], &[0]).is_err());
    assert!(parts().solved(0, vec![[0, 1, 99]], &[0]).is_err());
    assert!(parts().solved(0, vec![], &[]).is_err());
}

/// The hull of a part on a line that names vertices twice, or in a wrong order.
#[test]
fn lines_out_of_order_are_refused() {
    let line: Vec<Point> = (0..24).map(|k| Point::new(k, 0)).chain([Point::new(0, 9)]).collect();
    let parts = Parts::divide(&line, 12, ONE).expect("few points");
    let part = (0..parts.count()).find(|&part| mesh_of(parts.points(part)).is_collinear()).expect("a part on the line");
    let count = parts.points_of(part) as u32;
    let sound: Vec<u32> = mesh_of(parts.points(part)).hull;
    assert!(parts.solved(part, vec![], &sound).is_ok());
    let again: Vec<u32> = (0..count).map(|k| sound[k as usize % 2]).collect();
    let backwards: Vec<u32> = sound.iter().rev().copied().collect();
    for wrong in [again, backwards] {
        assert!(parts.solved(part, vec![], &wrong).is_err());
    }
}

/// Triangles that are no plane graph, with as many edges as a part has room for.
#[test]
fn graphs_that_are_not_plane_end_in_errors() {
    for seed in 0..3000u64 {
        let points: Vec<Point> = (0..30).map(|k| tied([0, 2, 5][random(seed, 3)], seed * 100 + k, 9)).collect();
        let parts = Parts::divide(&points, 7, ONE).expect("few points");
        let solve = |part: usize| {
            let (count, mesh) = (parts.points_of(part), mesh_of(parts.points(part)));
            if part != random(seed + 5, parts.count()) {
                return parts.solved(part, mesh.triangles, &mesh.hull);
            }
            // Random triangles, each side at most once in each direction.
            let mut sides = std::collections::BTreeSet::new();
            let mut triangles = Vec::new();
            for k in 0..60 {
                let corner = |c: u64| random(seed * 1000 + 3 * k + c, count) as u32;
                let [a, b, c] = [corner(0), corner(1), corner(2)];
                let own = [(a, b), (b, c), (c, a)];
                if a != b && b != c && c != a && own.iter().all(|side| !sides.contains(side)) {
                    sides.extend(own);
                    triangles.push([a, b, c]);
                }
            }
            let hull: Vec<u32> = (0..count as u32).take(2 + random(seed, 3)).collect();
            parts.solved(part, triangles, &hull)
        };
        let solved: Result<Vec<SolvedPart>, Unsound> = (0..parts.count()).map(solve).collect();
        let _ = solved.and_then(|solved| parts.join(solved, ONE));
    }
}
