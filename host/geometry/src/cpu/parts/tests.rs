//! Joins of parts, compared with the mesh of the whole set.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use super::super::{triangulate, Connectivity};
use super::{Parts, SolvedPart, Unsound};
use crate::mesh::Mesh;
use crate::order::mix;
use crate::point::Point;

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
fn missing_and_doubled_parts_are_refused() {
    let points: Vec<Point> = (0..100).map(|k| tied(0, k, 50)).collect();
    let parts = || Parts::divide(&points, 20, ONE).expect("few points");
    let mut missing = solved(&parts());
    missing.pop();
    assert_eq!(parts().join(missing, ONE), Err(Unsound));
    let mut doubled = solved(&parts());
    doubled.extend(solved(&parts()).pop());
    assert_eq!(parts().join(doubled, ONE), Err(Unsound));
    assert!(parts().solved(99, vec![], &[0]).is_err());
    assert!(parts().solved(0, vec![[0, 1, 99]], &[0]).is_err());
    assert!(parts().solved(0, vec![], &[]).is_err());
}
