//! The model against a brute-force oracle of its own: the same answer in every order and with every length
//! of the boundary list.

use crate::common::sphere::triangles;
use crate::common::Random;
use incircle_model::predicate::Point;
use incircle_model::{Insertion, Mesh};
use std::collections::BTreeSet;

fn build(points: &[Point], ring: u32) -> Option<(Mesh, BTreeSet<[Point; 3]>)> {
    let capacity = points.len().max(4) as u32;
    let mut mesh = Mesh::new(capacity, ring);
    for &p in points {
        if mesh.insert(p) == Insertion::Collinear {
            return None;
        }
    }
    let counts = *mesh.counts();
    assert_eq!(counts.insertions + counts.duplicates, points.len() as u32);
    assert_eq!(mesh.records().len() as u32, 2 * counts.insertions - 2);
    let set = triangles(&mesh, points, capacity);
    Some((mesh, set))
}

#[test]
fn every_order_and_list_size_gives_the_same_mesh() {
    let mut random = Random(1);
    let (mut runs, mut alone) = (0, 0);
    for trial in 0..3000 {
        let side = [2, 3, 4, 6, 9, 100, 1 << 16, 1 << 31][trial % 8];
        let count = 3 + random.below(30);
        let mut points: Vec<Point> =
            (0..count).map(|_| Point { x: random.below(side), y: random.below(side) }).collect();
        let mut first = None;
        for ring in [64, 3, 4, 5, 8] {
            random.shuffle(&mut points);
            let Some((mesh, set)) = build(&points, ring) else {
                continue;
            };
            runs += 1;
            alone += mesh.counts().overflows;
            assert_eq!(first.get_or_insert_with(|| set.clone()), &set, "ring {ring}, points {points:?}");
        }
    }
    assert!(runs > 8000 && alone > 40_000, "{runs} runs, {alone} solo insertions");
}

#[test]
fn a_solo_insertion_makes_two_tests_a_flip_and_three() {
    let mut random = Random(2);
    let points: Vec<Point> = (0..500).map(|_| Point { x: random.below(300), y: random.below(300) }).collect();
    let (mesh, _) = build(&points, 3).unwrap();
    let counts = mesh.counts();
    // A list of three entries has no room for any conflict, so every insertion makes at least the three tests
    // of its first attempt.
    let tests_alone = 2 * counts.flips + 3 * counts.overflows;
    let kept = counts.insertions - 3 - counts.overflows;
    assert_eq!(counts.tests, tests_alone + 3 * counts.overflows + 3 * kept);
    assert!(counts.overflows > 400);
}

#[test]
fn refuses_what_does_not_fit_and_what_follows_a_collinear_start() {
    let mut mesh = Mesh::new(4, 8);
    for (x, y) in [(0, 0), (9, 0), (0, 9), (3, 3)] {
        assert_eq!(mesh.insert(Point { x, y }), Insertion::Inserted);
    }
    assert_eq!(mesh.insert(Point { x: 5, y: 1 }), Insertion::Refused);
    assert_eq!(mesh.records().len(), 6);
    mesh.clear();
    for (x, expected) in
        [(0, Insertion::Inserted), (1, Insertion::Inserted), (2, Insertion::Collinear), (3, Insertion::Refused)]
    {
        assert_eq!(mesh.insert(Point { x, y: 5 }), expected);
    }
    assert!(mesh.records().is_empty());
}
