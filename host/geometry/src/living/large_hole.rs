//! Filling the hole of a vertex with many neighbours: the CPU triangulator makes the mesh of the neighbours, and the
//! part of that mesh inside the hole is copied.
//!
//! Gift wrapping takes O(k²) tests for `k` neighbours, at worst a wheel with all points around its hub. The triangles
//! that fill a hole have empty circles, so each of them is a triangle of the mesh of the neighbours alone, too.

use alloc::vec;
use alloc::vec::Vec;

use super::level::{Border, Level};
use super::load::connected;
use super::plane::{Plane, Side, INFINITE};
use crate::plane_point::PlanePoint;

/// Marks a triangle of the mesh of the neighbours that is outside the hole, or not known to be inside.
const OUTSIDE: u32 = u32::MAX;

/// The mesh of the vertices around a hole, by their ranks in the border.
struct Patch<'b> {
    plane: Plane,
    border: &'b [Border],
    /// The place in the border of the finite vertex of each rank.
    places: Vec<usize>,
    /// The place in the border of the infinite vertex.
    infinite: Option<usize>,
    /// For each triangle of the patch, the triangle that is made of it.
    copies: Vec<u32>,
}

impl Patch<'_> {
    /// The place in the border of a vertex of the patch.
    fn place(&self, vertex: u32) -> Option<usize> {
        match vertex {
            INFINITE => self.infinite,
            vertex => Some(self.places[vertex as usize]),
        }
    }

    /// The vertex of the mesh that a vertex of the patch is.
    fn vertex(&self, vertex: u32) -> u32 {
        match vertex {
            INFINITE => INFINITE,
            vertex => self.border[self.places[vertex as usize]].from,
        }
    }

    /// The edge of the border that has this side inside the hole.
    fn border_of(&self, side: Side) -> Option<&Border> {
        let [from, to] = self.plane.ends(side);
        let edge = self.border.get(self.place(from)?)?;
        let next = (self.place(from)? + 1) % self.border.len();
        (self.border[next].from == self.vertex(to)).then_some(edge)
    }
}

impl<P: PlanePoint> Level<P> {
    /// Fills a hole with triangles, which take the numbers of dead ones. O(k log k).
    pub(super) fn fill_large(&mut self, border: &[Border]) {
        self.made.clear();
        let places: Vec<usize> = (0..border.len()).filter(|&place| border[place].from != INFINITE).collect();
        let points: Vec<P> = places.iter().map(|&place| self.vertices[border[place].from as usize].point).collect();
        let mesh = connected(&points);
        if mesh.triangles.is_empty() {
            return self.fill_flat(border);
        }
        let mut plane = Plane::default();
        plane.load(&mesh.triangles, &mesh.hull, points.len());
        let copies = vec![OUTSIDE; plane.end() as usize];
        let infinite = border.iter().position(|edge| edge.from == INFINITE);
        self.copy(Patch { plane, border, places, infinite, copies });
    }

    /// Copies the triangles of the patch that are inside the hole.
    fn copy(&mut self, mut patch: Patch<'_>) {
        let sides = |triangle: u32| (0..3).map(move |slot| Side::new(triangle, slot));
        let begins = |&triangle: &u32| sides(triangle).any(|side| patch.border_of(side).is_some());
        let mut open: Vec<u32> = (0..patch.plane.end()).filter(begins).collect();
        let mut inside = Vec::new();
        while let Some(triangle) = open.pop() {
            if patch.copies[triangle as usize] != OUTSIDE {
                continue;
            }
            let copy = self.next_made();
            patch.copies[triangle as usize] = copy;
            inside.push(triangle);
            let inner = sides(triangle).filter(|&side| patch.border_of(side).is_none());
            open.extend(inner.map(|side| patch.plane.across(side).triangle()));
        }
        for triangle in inside {
            let copy = patch.copies[triangle as usize];
            let vertices = patch.plane.get(triangle).vertices.map(|vertex| patch.vertex(vertex));
            let across = patch.plane.get(triangle).across;
            let across = across.map(|side| Side::new(patch.copies[side.triangle() as usize], side.slot()));
            self.plane.set(copy, vertices, across);
            vertices.into_iter().for_each(|vertex| self.note(vertex, copy));
            for side in sides(triangle) {
                if let Some(edge) = patch.border_of(side) {
                    self.plane.link(Side::new(copy, side.slot()), edge.outside);
                }
            }
        }
    }

    /// Fills the hole of a vertex on the hull whose neighbours lie on one line: each edge gets a ghost triangle.
    fn fill_flat(&mut self, border: &[Border]) {
        let infinite = border.iter().position(|edge| edge.from == INFINITE).unwrap_or(0);
        let length = border.len();
        let edge = |step: usize| border[(infinite + step) % length];
        // The side of the edge from the infinite vertex to the first one.
        let mut last = edge(0).outside;
        for step in 1..length - 1 {
            let ghost = self.next_made();
            let ends = [edge(step + 1).from, edge(step).from];
            self.plane.set_ghost(ghost, ends);
            ends.into_iter().for_each(|vertex| self.note(vertex, ghost));
            self.plane.link(Side::new(ghost, 2), edge(step).outside);
            self.plane.link(Side::new(ghost, 1), last);
            last = Side::new(ghost, 0);
        }
        self.plane.link(last, edge(length - 1).outside);
    }
}
