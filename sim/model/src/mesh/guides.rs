//! Walks that begin at a vertex: a finite triangle of each is kept, from the first guide on.
//!
//! The core has no such table (docs/engine.md, "No guides").

use super::{Insertion, Mesh, Record};
use crate::predicate::Point;

/// A finite triangle of each vertex, once somebody has asked for it.
#[derive(Clone, Debug, Default)]
pub(super) struct Guides {
    is_kept: bool,
    /// By vertex. A point that fell onto a vertex has a triangle near it, a point before the first triangle has record 0.
    triangle_of: Vec<u32>,
}

impl Guides {
    /// Forgets all triangles; they are no longer kept.
    pub(super) fn clear(&mut self) {
        self.is_kept = false;
        self.triangle_of.clear();
    }

    /// Makes room for a vertex.
    #[inline]
    pub(super) fn add_vertex(&mut self) {
        if self.is_kept {
            self.triangle_of.push(0);
        }
    }

    /// Notes a triangle of these vertices.
    #[inline]
    pub(super) fn note<const N: usize>(&mut self, triangle: u32, vertices: [u32; N]) {
        if self.is_kept {
            for vertex in vertices {
                self.triangle_of[vertex as usize] = triangle;
            }
        }
    }
}

impl Mesh {
    /// Inserts one point. The search for it begins at a triangle of the vertex `guide`, by number of arrival; where the last one ended if
    /// that is no earlier point, and in a batch. The mesh is the same wherever it begins.
    ///
    /// From the first guide on four bytes more are kept per point, and written with each triangle. O(n) for the first since the last clear.
    pub fn insert_near(&mut self, p: Point, guide: u32) -> Insertion {
        self.keep_triangles();
        self.insert_from(p, Some(guide))
    }

    /// Walks to a point that may be inserted afterwards, from a triangle of the vertex `guide`, or from where the last walk ended. `None`
    /// before the first triangle, and in a batch.
    pub fn approach(&mut self, p: Point, guide: Option<u32>) -> Option<Approach<'_>> {
        if self.records.is_empty() || self.starts.len() > 1 {
            return None;
        }
        self.keep_triangles();
        let start = guide.and_then(|vertex| self.triangle_of(vertex)).unwrap_or(self.starts[0]);
        let root = self.locate(p, start);
        self.starts[0] = root;
        Some(Approach { mesh: self, p, root })
    }

    /// A finite triangle with this vertex; `None` if there is none, or none is kept because no point has been guided.
    pub fn triangle_of(&self, vertex: u32) -> Option<u32> {
        let found = self.guides.triangle_of.get(vertex as usize).copied()?;
        self.records.get(found as usize)?.v.contains(&vertex).then_some(found)
    }

    /// Where the walk to a guided point begins.
    #[inline]
    pub(super) fn guided_start(&self, guide: Option<u32>) -> Option<u32> {
        let is_batch = self.starts.len() > 1;
        let start = self.guides.triangle_of.get(guide? as usize).copied();
        // The place of the point itself has been made, and says nothing yet.
        start.filter(|_| !is_batch && guide.is_some_and(|guide| guide + 1 < self.counts.arrived))
    }

    /// Notes the triangles round the point that was inserted last, of which this is one: all vertices of those that are gone are at them.
    #[inline]
    pub(super) fn note_star(&mut self, of_star: u32) {
        if !self.guides.is_kept {
            return;
        }
        let mut triangle = of_star;
        loop {
            let Record { v, n } = self.records[triangle as usize];
            self.note_finite(triangle, v);
            triangle = n[1];
            if triangle == of_star {
                return;
            }
        }
    }

    /// Notes a triangle of its vertices, unless it is a ghost.
    fn note_finite(&mut self, triangle: u32, vertices: [u32; 3]) {
        if !vertices.contains(&self.infinite) {
            self.guides.note(triangle, vertices);
        }
    }

    /// Finds a triangle of each vertex, and keeps it right from now on.
    fn keep_triangles(&mut self) {
        if self.guides.is_kept {
            return;
        }
        self.guides = Guides { is_kept: true, triangle_of: vec![0; self.points.len()] };
        for triangle in 0..self.records.len() as u32 {
            self.note_finite(triangle, self.records[triangle as usize].v);
        }
    }
}

/// A walk has ended at a point.
pub struct Approach<'m> {
    mesh: &'m mut Mesh,
    p: Point,
    /// The record that holds it.
    root: u32,
}

impl Approach<'_> {
    /// The nearest of the vertices of the triangle that holds the point, of the hull edge it lies before: by number of arrival, and where it lies.
    pub fn nearest(&self) -> (u32, Point) {
        let vertices = self.mesh.records[self.root as usize].v.into_iter().filter(|&v| v != self.mesh.infinite);
        let at = |v: u32| self.mesh.points[v as usize];
        let square = |one: u32, other: u32| u64::from(one.abs_diff(other)).pow(2);
        let distance = |q: Point| square(q.x, self.p.x) + square(q.y, self.p.y);
        // A record has two finite vertices at least, so the default is never taken.
        vertices.map(|v| (v, at(v))).min_by_key(|&(_, q)| distance(q)).unwrap_or_default()
    }

    /// Inserts the point. It walks no more.
    pub fn insert(self) -> Insertion {
        let Self { mesh, p, root } = self;
        mesh.arrive(p).map_or(Insertion::Refused, |id| mesh.insert_in(id, p, root))
    }
}
