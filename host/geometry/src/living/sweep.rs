//! Moving all points at once: one sweep of flips, after the vertices in the way have been taken out.
//!
//! Under the new places most triangles still turn left. Vertices are taken out of the old mesh until all that are left
//! do, and until the hull is convex. Then the mesh is a triangulation of the new places, too, which flips make
//! canonical, and the vertices that were taken out are inserted at their new places.
//!
//! **Why that is a triangulation.** Let all triangles turn left, let the hull turn left or go straight on at each
//! vertex, and let it turn round once. The angles of `2 i + h - 2` triangles then sum up to the angles of a convex
//! polygon of `h` corners, plus at least 2 π for each of the `i` vertices inside. Both sums are equal, so every vertex
//! has exactly 2 π around it, and no two triangles overlap.

use alloc::vec::Vec;

use super::level::Level;
use super::plane::{Side, Triangle, INFINITE};
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// A vertex that was taken out.
pub struct Taken {
    pub vertex: u32,
    pub name: u32,
    /// A vertex that was its neighbour.
    pub near: Option<u32>,
}

/// New places of the vertices of a level, and what was found on the way there.
pub struct Sweep<'a, P: PlanePoint> {
    pub level: &'a mut Level<P>,
    /// The new place of each vertex.
    pub places: &'a [P],
    /// Vertices that were taken out.
    pub taken: Vec<Taken>,
    /// The acute corners of each triangle at the new places, as far as they are known.
    pub acute: Vec<u8>,
    /// The most vertices that may be taken out.
    pub most: usize,
}

impl<P: PlanePoint> Sweep<'_, P> {
    fn site(&self, vertex: u32) -> P::Site {
        self.places[vertex as usize].site()
    }

    /// Moves all vertices but those that had to be taken out. Says whether that was possible; if not, the level is of
    /// no use.
    pub fn run(&mut self) -> bool {
        let mut open: Vec<u32> = Vec::new();
        for triangle in 0..self.level.plane.end() {
            open.push(triangle);
            while let Some(triangle) = open.pop() {
                let Some(vertex) = self.vertex_in_the_way(triangle) else { continue };
                if self.taken.len() == self.most || !self.take_out(vertex, &mut open) {
                    return false;
                }
            }
        }
        if !self.turns_round_once() {
            return false;
        }
        for (vertex, &place) in self.level.vertices.iter_mut().zip(self.places) {
            vertex.point = place;
        }
        self.flip_all();
        true
    }

    /// Takes a vertex out of the old mesh, and has all triangles looked at that change by that; says whether there
    /// still are triangles.
    fn take_out(&mut self, vertex: u32, open: &mut Vec<u32>) -> bool {
        let (name, near) = (self.level.vertices[vertex as usize].name, self.level.some_neighbor(vertex));
        self.taken.push(Taken { vertex, name, near });
        self.level.remove(vertex);
        if !self.level.is_plane() {
            return false;
        }
        for &made in &self.level.made {
            open.push(made);
            // The turns at both ends of a new hull edge are those with the hull edges before and behind it.
            if self.level.plane.get(made).infinite_slot().is_some() {
                open.extend([self.level.plane.last_ghost(made), self.level.plane.next_ghost(made)]);
            }
        }
        true
    }

    /// A vertex whose removal may help if a triangle no longer turns left, or if the hull does not at the far end of
    /// the edge of a ghost triangle.
    fn vertex_in_the_way(&mut self, triangle: u32) -> Option<u32> {
        let found = self.level.plane.get(triangle);
        if found.vertices == [INFINITE; 3] {
            return None;
        }
        if found.infinite_slot().is_some() {
            let next = self.level.plane.next_ghost(triangle);
            let [a, b, c] = [triangle, next, self.level.plane.next_ghost(next)].map(|g| self.level.hull_vertex(g));
            let [from, middle, to] = [a, b, c].map(|vertex| self.site(vertex));
            let turn = P::Site::orient2d(from, middle, to);
            let is_right = turn.is_gt() || turn.is_eq() && P::Site::is_between(from, middle, to);
            return (!is_right).then_some(b);
        }
        let [a, b, c] = found.vertices.map(|vertex| self.site(vertex));
        self.acute[triangle as usize] = P::Site::acute_corners([a, b, c]);
        if P::Site::orient2d(a, b, c).is_gt() {
            return None;
        }
        // The vertex opposite the longest edge has crossed it.
        let lengths = [b.rough_distance(c), c.rough_distance(a), a.rough_distance(b)];
        let longest = (0..3).max_by(|&one, &other| lengths[one].total_cmp(&lengths[other])).unwrap_or(0);
        Some(found.vertices[longest])
    }

    /// Whether the hull, which turns left everywhere, goes round once: it then has one lexicographically smallest
    /// vertex among its neighbours.
    fn turns_round_once(&self) -> bool {
        let plane = &self.level.plane;
        let is_low = |&ghost: &u32| {
            let around = [plane.last_ghost(ghost), ghost, plane.next_ghost(ghost)];
            let [before, own, after] = around.map(|ghost| self.site(self.level.hull_vertex(ghost)));
            own < before && own < after
        };
        self.level.ghosts(plane.ghost).filter(is_low).count() == 1
    }

    /// Makes a triangulation canonical.
    ///
    /// The corners of triangles that flips have changed need not be known: flips have left their edges right.
    fn flip_all(&mut self) {
        let level = &mut *self.level;
        level.stack.clear();
        for triangle in 0..level.plane.end() {
            let Triangle { vertices, across } = *level.plane.get(triangle);
            if vertices == [INFINITE; 3] {
                continue;
            }
            let own = self.acute[triangle as usize];
            for (slot, other) in across.into_iter().enumerate() {
                let theirs = self.acute[other.triangle() as usize] >> other.slot();
                if own >> slot & theirs & 1 == 0 && triangle < other.triangle() {
                    level.stack.push(Side::new(triangle, slot));
                }
            }
            level.repair();
        }
    }
}
