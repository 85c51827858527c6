//! Walks that begin at a record of the caller's choice.
//!
//! The core has no such insertion (docs/engine.md, "No guides"). The module is for studies of orders of insertion
//! and of point location.

use super::{Insertion, Mesh};
use crate::predicate::Point;

impl Mesh {
    /// Walks to a point, from the record `start` or from where the last walk ended. The point may be inserted
    /// afterwards ([`Approach::insert`]); the mesh is the same wherever the walk begins. Returns `None` before the
    /// first triangle, in a batch, and if there is no record of this number.
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

/// A walk that has reached its point.
pub struct Approach<'m> {
    mesh: &'m mut Mesh,
    p: Point,
    /// Id of the record that holds the point.
    root: u32,
}

impl Approach<'_> {
    /// Id of the record that holds the point: a triangle with the point inside or on its border, or a ghost triangle
    /// with the point beyond its hull edge. After the insertion of the point, the record with this id is one of those
    /// around the new vertex.
    pub fn record(&self) -> u32 {
        self.root
    }

    /// Inserts the point without another walk.
    pub fn insert(self) -> Insertion {
        let Self { mesh, p, root } = self;
        mesh.arrive(p).map_or(Insertion::Refused, |id| mesh.insert_in(id, p, root))
    }
}
