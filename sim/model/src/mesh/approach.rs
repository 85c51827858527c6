//! Walks that begin at a record of the caller's choice.
//!
//! The core has no such insertion (docs/engine.md, "No guides"): it is for studies of orders of insertion and of point location.

use super::{Insertion, Mesh};
use crate::predicate::Point;

impl Mesh {
    /// Walks to a point, from the record `start`, or from where the last walk ended. The point may be inserted afterwards
    /// ([`Approach::insert`]); the mesh is the same wherever the walk begins. `None` before the first triangle, in a batch, and if there is
    /// no record of this number.
    pub fn approach(&mut self, p: Point, start: Option<u32>) -> Option<Approach<'_>> {
        let start = start.unwrap_or(self.starts[0]);
        if self.starts.len() > 1 || start as usize >= self.records.len() {
            return None;
        }
        let root = self.locate(p, start);
        self.starts[0] = root;
        Some(Approach { mesh: self, p, root })
    }
}

/// A walk that has ended at a point.
pub struct Approach<'m> {
    mesh: &'m mut Mesh,
    p: Point,
    /// The record that holds the point.
    root: u32,
}

impl Approach<'_> {
    /// The record that holds the point: a triangle with the point inside or on its border, or a ghost with the point beyond its hull edge. Once
    /// the point is inserted, the record of this number is one of those around its vertex.
    pub fn record(&self) -> u32 {
        self.root
    }

    /// The vertex nearest to the point, of the triangle that holds it or of the hull edge before which it lies: its number of arrival, and its
    /// coordinates.
    pub fn nearest(&self) -> (u32, Point) {
        let vertices = self.mesh.records[self.root as usize].v.into_iter().filter(|&v| v != self.mesh.infinite);
        let at = |v: u32| self.mesh.points[v as usize];
        let square = |one: u32, other: u32| u64::from(one.abs_diff(other)).pow(2);
        let distance = |q: Point| square(q.x, self.p.x) + square(q.y, self.p.y);
        // A record has two finite vertices at least, so the default is never taken.
        vertices.map(|v| (v, at(v))).min_by_key(|&(_, q)| distance(q)).unwrap_or_default()
    }

    /// Inserts the point, without another walk.
    pub fn insert(self) -> Insertion {
        let Self { mesh, p, root } = self;
        mesh.arrive(p).map_or(Insertion::Refused, |id| mesh.insert_in(id, p, root))
    }
}
