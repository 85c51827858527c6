//! Changes of a standing mesh: after each, the records are the canonical mesh of the living points, and what cannot be
//! done leaves them as they were.

use crate::common::sphere::triangles;
use crate::common::Random;
use incircle_model::predicate::{orient2d, Point};
use incircle_model::{Insertion, Mesh};
use incircle_protocol::Outcome;
use std::collections::BTreeSet;

const CAPACITY: u32 = 64;

fn random_point(random: &mut Random, side: u32) -> Point {
    Point { x: random.below(side), y: random.below(side) }
}

/// A mesh beside the list of its living points, by vertex.
struct Bench {
    mesh: Mesh,
    living: Vec<Option<Point>>,
    ring: u32,
}

impl Bench {
    /// Begins with three points that span a triangle.
    fn new(random: &mut Random, side: u32, ring: u32) -> Self {
        let mut mesh = Mesh::new(CAPACITY, ring);
        let mut living = vec![None; CAPACITY as usize];
        let corners = loop {
            let corners = [(); 3].map(|()| random_point(random, side));
            if orient2d(corners[0], corners[1], corners[2]) != 0 {
                break corners;
            }
        };
        for (vertex, p) in living.iter_mut().zip(corners) {
            assert_eq!(mesh.insert(p), Insertion::Inserted);
            *vertex = Some(p);
        }
        Self { mesh, living, ring }
    }

    fn points(&self) -> Vec<Point> {
        self.living.iter().copied().flatten().collect()
    }

    /// Checks the records, and that they are those of the same points inserted in another order.
    fn check(&self, random: &mut Random) {
        let at: Vec<Point> = self.living.iter().map(|p| p.unwrap_or_default()).collect();
        let found = triangles(&self.mesh, &at, CAPACITY);
        assert_eq!(self.mesh.live_records(), 2 * self.mesh.vertices() - 2);
        assert_eq!(self.mesh.vertices() as usize, self.points().len());
        for (vertex, p) in (0..).zip(&self.living) {
            assert_eq!(self.mesh.has_vertex(vertex), p.is_some());
        }
        assert_eq!(found, self.anew(random));
    }

    /// The triangles of the living points in a new mesh.
    fn anew(&self, random: &mut Random) -> BTreeSet<[Point; 3]> {
        let mut points = self.points();
        loop {
            random.shuffle(&mut points);
            let mut mesh = Mesh::new(CAPACITY, 64);
            if points.iter().all(|&p| mesh.insert(p) == Insertion::Inserted) {
                return triangles(&mesh, &points, CAPACITY);
            }
        }
    }

    fn is_flat(points: &[Point]) -> bool {
        let mut different = points.iter().skip(1).filter(|&&p| p != points[0]);
        let second = different.next();
        second.is_none_or(|&second| points.iter().all(|&p| orient2d(points[0], second, p) == 0))
    }

    /// The number of neighbours of a vertex, the infinite one included.
    fn degree(&self, vertex: u32) -> u32 {
        self.mesh.records().iter().filter(|record| record.v.contains(&vertex)).count() as u32
    }

    fn without(&self, vertex: u32) -> Vec<Point> {
        let others = (0..).zip(&self.living).filter(|&(other, _)| other != vertex);
        others.filter_map(|(_, &p)| p).collect()
    }

    /// Why a vertex cannot be taken out; `None` if it can.
    fn refusal(&self, vertex: u32) -> Option<Outcome> {
        match () {
            () if self.living.get(vertex as usize).copied().flatten().is_none() => Some(Outcome::Missing),
            () if self.degree(vertex) > self.ring => Some(Outcome::ManyNeighbors),
            () if Self::is_flat(&self.without(vertex)) => Some(Outcome::Flat),
            () => None,
        }
    }

    fn delete(&mut self, vertex: u32) -> Outcome {
        let expected = self.refusal(vertex).unwrap_or(Outcome::Done);
        let before = self.mesh.records().to_vec();
        assert_eq!(self.mesh.delete(vertex), (expected, vertex));
        if expected == Outcome::Done {
            self.living[vertex as usize] = None;
        } else {
            assert_eq!(self.mesh.records(), before);
        }
        expected
    }

    fn vertex_at(&self, p: Point) -> Option<u32> {
        self.living.iter().position(|&living| living == Some(p)).map(|vertex| vertex as u32)
    }

    fn insert(&mut self, vertex: u32, p: Point) -> Outcome {
        let expected = match self.vertex_at(p) {
            _ if vertex >= CAPACITY => (Outcome::Full, vertex),
            _ if self.living[vertex as usize].is_some() => (Outcome::InUse, vertex),
            Some(other) => (Outcome::Duplicate, other),
            None => (Outcome::Done, vertex),
        };
        assert_eq!(self.mesh.insert_as(vertex, p), expected);
        if expected.0 == Outcome::Done {
            self.living[vertex as usize] = Some(p);
        }
        expected.0
    }

    fn move_to(&mut self, vertex: u32, p: Point) -> Outcome {
        let old = self.living.get(vertex as usize).copied().flatten();
        let expected = match (self.refusal(vertex), self.vertex_at(p)) {
            (Some(Outcome::Flat), _) if old == Some(p) => (Outcome::Done, vertex),
            (Some(refusal), _) => (refusal, vertex),
            (None, Some(other)) if other != vertex => (Outcome::Duplicate, other),
            (None, _) => (Outcome::Done, vertex),
        };
        assert_eq!(self.mesh.move_to(vertex, p), expected);
        match expected.0 {
            Outcome::Done => self.living[vertex as usize] = Some(p),
            Outcome::Duplicate => self.living[vertex as usize] = None,
            _ => {}
        }
        expected.0
    }
}

#[test]
fn every_change_leaves_the_one_mesh_of_the_living_points() {
    let mut random = Random(251);
    let mut seen = [0u32; Outcome::ALL.len()];
    for trial in 0..if cfg!(debug_assertions) { 1000 } else { 4000 } {
        let side = [3, 4, 5, 7, 40, 1 << 31][trial % 6];
        let ring = [64, 5, 8][trial / 6 % 3];
        let mut bench = Bench::new(&mut random, side, ring);
        // Insertions come more often in some scripts, deletions in others.
        let growth = 2 + random.below(6);
        for _ in 0..40 {
            let (vertex, p) = (random.below(CAPACITY + 1), random_point(&mut random, side));
            let outcome = match random.below(10) {
                kind if kind < growth => bench.insert(vertex, p),
                8 | 9 => bench.move_to(vertex, p),
                _ => bench.delete(vertex),
            };
            seen[outcome as usize] += 1;
            bench.check(&mut random);
        }
    }
    for outcome in [
        Outcome::Done,
        Outcome::Duplicate,
        Outcome::Missing,
        Outcome::InUse,
        Outcome::Full,
        Outcome::ManyNeighbors,
        Outcome::Flat,
    ] {
        assert!(seen[outcome as usize] > 100, "{outcome:?} came {} times", seen[outcome as usize]);
    }
}

#[test]
fn free_records_are_used_again() {
    let mut random = Random(252);
    let mut bench = Bench::new(&mut random, 1000, 64);
    let mut most = 0;
    for _ in 0..4000 {
        // All vertices come and go, so the memory is full of vertices again and again.
        let (vertex, p) = (random.below(CAPACITY), random_point(&mut random, 1000));
        if bench.insert(vertex, p) == Outcome::InUse && random.below(2) == 0 {
            bench.delete(vertex);
        }
        most = most.max(bench.mesh.records().len() as u32);
        assert!(most <= 2 * CAPACITY - 2, "{most} records");
    }
    bench.check(&mut random);
    assert!(most > CAPACITY, "only {most} records were used");
}

#[test]
fn an_insertion_without_a_chosen_vertex_counts_on() {
    let mut mesh = Mesh::new(8, 32);
    for (x, y) in [(0, 0), (9, 0), (0, 9)] {
        mesh.insert(Point { x, y });
    }
    assert_eq!(mesh.insert_as(5, Point { x: 3, y: 3 }), (Outcome::Done, 5));
    assert_eq!(mesh.insert(Point { x: 4, y: 3 }), Insertion::Inserted);
    assert!(mesh.has_vertex(6) && !mesh.has_vertex(4));
    assert_eq!(mesh.delete(5), (Outcome::Done, 5));
    assert_eq!(mesh.insert(Point { x: 3, y: 3 }), Insertion::Inserted);
    assert_eq!(mesh.insert(Point { x: 2, y: 3 }), Insertion::Refused);
    assert_eq!(mesh.insert_as(5, Point { x: 2, y: 3 }), (Outcome::Done, 5));
    assert_eq!((mesh.vertices(), mesh.live_records()), (6, 10));
}
