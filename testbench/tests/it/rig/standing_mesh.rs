//! A mesh that stands, as records of plain code, and what a place in it is by definition.

use std::collections::{BTreeMap, BTreeSet};

use crate::rig::visit_model::{orientation, Point, Record};

/// Number of the infinite vertex.
pub const INFINITE: u64 = 0x7fff;

/// Records and points.
pub struct Mesh {
    pub points: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    pub records: Vec<Record>,
}

impl Mesh {
    /// The records of these triangles: of each of them, and a ghost triangle behind each edge of the hull.
    pub fn new(points: Vec<Point>, triangles: Vec<[u32; 3]>) -> Self {
        let mut corners: Vec<[u64; 3]> = triangles.iter().map(|triangle| triangle.map(u64::from)).collect();
        let edges = |corners: &[u64; 3]| [0, 1, 2].map(|slot| (corners[(slot + 1) % 3], corners[(slot + 2) % 3]));
        let inner: BTreeSet<(u64, u64)> = corners.iter().flat_map(edges).collect();
        corners.extend(inner.iter().filter(|&&(a, b)| !inner.contains(&(b, a))).map(|&(a, b)| [b, a, INFINITE]));
        let by_edge: BTreeMap<(u64, u64), u64> =
            corners.iter().enumerate().flat_map(|(id, corners)| edges(corners).map(|edge| (edge, id as u64))).collect();
        let records = corners.iter().map(|v| Record { v: *v, n: edges(v).map(|(a, b)| by_edge[&(b, a)]) }).collect();
        Self { points, triangles, records }
    }

    /// Places of the corners of a record, with any place for the infinite vertex.
    pub fn corners(&self, record: &Record) -> [Point; 3] {
        record.v.map(|v| self.points.get(v as usize).copied().unwrap_or((5, 7)))
    }

    /// Checks the weights of the vertices that an answer names: with them the place is the mean of these vertices, and
    /// their sum is twice the area of a triangle that has them all as corners.
    pub fn check_weights(&self, place: Point, outcome: u64, vertices: [u64; 3], weights: [u64; 3]) {
        let count = if outcome == 4 { 0 } else { outcome as usize };
        assert_eq!(weights[count..], [0; 3][count..], "{place:?}: only vertices that an answer names have a weight");
        if count == 0 {
            return;
        }
        let named = || vertices.into_iter().zip(weights).take(count);
        let at = |vertex: u64| self.points[vertex as usize];
        let sum: i64 = named().map(|(_, weight)| weight as i64).sum();
        let weighed: i64 = named().map(|(vertex, weight)| at(vertex).0 * weight as i64).sum();
        let weighed_y: i64 = named().map(|(vertex, weight)| at(vertex).1 * weight as i64).sum();
        let is_mean = (weighed, weighed_y) == (place.0 * sum, place.1 * sum);
        let has_area = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|corner| at(corner.into()));
            named().all(|(vertex, _)| corners.contains(&(vertex as u32))) && orientation(a, b, c) == sum
        };
        assert!(
            is_mean && self.triangles.iter().any(has_area) && named().all(|(_, weight)| weight > 0),
            "{place:?}: vertices {vertices:?}, weights {weights:?}"
        );
    }

    /// Checks an answer by the definition of its outcome.
    pub fn check(&self, place: Point, outcome: u64, [v0, v1, v2]: [u64; 3]) {
        let at = |vertex: u64| self.points[vertex as usize];
        let is_edge = |a: u64, b: u64| self.records.iter().any(|record| record.v.contains(&a) && record.v.contains(&b));
        let is_right = match outcome {
            1 => at(v0) == place && [v1, v2] == [0, 0],
            2 => {
                let (low, high) = (at(v0).min(at(v1)), at(v0).max(at(v1)));
                is_edge(v0, v1) && orientation(low, high, place) == 0 && low < place && place < high && v2 == 0
            }
            3 => {
                let sides = [(v0, v1), (v1, v2), (v2, v0)].map(|(a, b)| orientation(at(a), at(b), place));
                let mut sorted = [v0, v1, v2];
                let smallest = (0..3).min_by_key(|&slot| sorted[slot]).unwrap_or(0);
                sorted.rotate_left(smallest);
                sides.iter().all(|&side| side > 0) && self.triangles.contains(&sorted.map(|v| v as u32))
            }
            4 => {
                let sees = |ghost: &&Record| orientation(at(ghost.v[1]), at(ghost.v[0]), place) < 0;
                let ghosts = self.records.iter().filter(|record| record.v[2] == INFINITE);
                let seen: Vec<[u64; 2]> = ghosts.filter(sees).map(|ghost| [ghost.v[1], ghost.v[0]]).collect();
                seen.contains(&[v0, v1]) && seen.iter().all(|edge| edge[1] != v0) && v2 == 0
            }
            _ => false,
        };
        assert!(is_right, "{place:?}: outcome {outcome}, vertices {v0}, {v1}, {v2}");
    }
}
