//! Adding a vertex: its cavity is removed, and the star of the vertex takes its place.
//!
//! Source: Bowyer, *Computing Dirichlet tessellations*, and Watson, *Computing the n-dimensional Delaunay
//! tessellation*, both 1981. The triangles of a cavity and the edges between them form a tree, because every vertex
//! stays a vertex. So a search in depth meets each triangle once, without marks, and the edges of the border in
//! counter-clockwise order.

use super::level::{Border, Level};
use super::plane::Side;
use super::walk::Place;
use crate::plane_point::PlanePoint;

impl<P: PlanePoint> Level<P> {
    /// Adds a vertex at a place that is no vertex yet; returns its number.
    pub(super) fn add(&mut self, point: P, name: u32, place: Place) -> u32 {
        self.add_among(point, name, place, |_| false)
    }

    /// Adds a vertex to a mesh in which some edges are fixed, given by their ends: no cavity reaches across them.
    pub(super) fn add_among(&mut self, point: P, name: u32, place: Place, is_fixed: impl Fn([u32; 2]) -> bool) -> u32 {
        let vertex = self.allocate(point, name);
        match place {
            Place::Triangle(root) | Place::Outside(root) => self.add_to_plane(vertex, root, is_fixed),
            Place::Edge(side) => self.add_to_plane(vertex, side.triangle(), is_fixed),
            Place::Between(..) | Place::Nowhere | Place::Vertex(_) => self.add_to_line(vertex),
        }
        vertex
    }

    #[inline(always)]
    fn add_to_plane(&mut self, vertex: u32, root: u32, is_fixed: impl Fn([u32; 2]) -> bool) {
        self.collect_cavity(vertex, root, is_fixed);
        let border = core::mem::take(&mut self.border);
        let mut dead = core::mem::take(&mut self.dead);
        // A star has two triangles more than its cavity had.
        while dead.len() < border.len() {
            dead.push(self.plane.allocate());
        }
        let mut last = dead[border.len() - 1];
        for (place, &Border { from, outside }) in border.iter().enumerate() {
            let next = (place + 1) % border.len();
            let (triangle, behind) = (dead[place], dead[next]);
            let across = [outside, Side::new(behind, 2), Side::new(last, 1)];
            self.plane.set(triangle, [vertex, from, border[next].from], across);
            self.plane.link(outside, Side::new(triangle, 0));
            self.note(from, triangle);
            last = triangle;
        }
        self.note(vertex, last);
        (self.border, self.dead) = (border, dead);
    }

    /// Collects the triangles in conflict with a new vertex, and the border around them, counter-clockwise.
    #[inline(always)]
    fn collect_cavity(&mut self, vertex: u32, root: u32, is_fixed: impl Fn([u32; 2]) -> bool) {
        let q = self.site(vertex);
        self.dead.clear();
        self.border.clear();
        self.dead.push(root);
        self.stack.clear();
        self.stack.extend([2, 1, 0].map(|slot| Side::new(root, slot)));
        while let Some(side) = self.stack.pop() {
            let outside = self.plane.across(side);
            if !is_fixed(self.plane.ends(side)) && self.conflicts(outside.triangle(), q) {
                self.dead.push(outside.triangle());
                self.stack.extend([outside.last(), outside.next()]);
            } else {
                self.border.push(Border { from: self.plane.ends(side)[0], outside });
            }
        }
    }
}
