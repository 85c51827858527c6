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
//!
//! **Edges.** The sweep keeps the cotangents of all corners, so it decides an edge by one sum (`double/cotangents`). It
//! sums at the later of the two triangles of each edge, and notes the edges that are not surely right. Flips work on
//! from these.

use alloc::vec::Vec;

use super::level::Level;
use super::plane::{Side, Triangle, INFINITE};
use crate::double::{LEAST_SUM, MOST};
use crate::pages;
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// Stands for the cotangents of a triangle that has no edges to decide: a triangle that has not been looked at, a free
/// triangle or a ghost triangle. Its sum with any cotangent is large.
const NO_CORNER: i16 = i16::MAX;
/// Stands for a cotangent that is not known. Its sum with a cotangent is smaller than that of any two cotangents, and
/// with `NO_CORNER` it is -1, so exact predicates decide.
const UNKNOWN: i16 = i16::MIN;

/// A vertex that was taken out.
pub struct Taken {
    pub vertex: u32,
    pub name: u32,
    /// A vertex that was its neighbour.
    pub near: Option<u32>,
}

/// New places of the vertices of a level, and what was found on the way there.
pub struct Sweep<'a, P: PlanePoint> {
    level: &'a mut Level<P>,
    /// The new place of each vertex.
    places: &'a [P],
    /// Vertices that were taken out.
    taken: Vec<Taken>,
    /// The most vertices that may be taken out.
    most: usize,
    /// The cotangent at the new places of the corner opposite each side, by the number of the side.
    cotangents: Vec<i16>,
    /// Sides whose edges may have to be flipped, and after these some that mean nothing.
    edges: Vec<Side>,
    /// The number of sides whose edges may have to be flipped.
    noted: usize,
}

impl<'a, P: PlanePoint> Sweep<'a, P> {
    /// Moves all vertices of a level but those that had to be taken out, and returns these. `None` if more than `most`
    /// would have to be; the level is then of no use.
    pub fn run(level: &'a mut Level<P>, places: &'a [P], most: usize) -> Option<Vec<Taken>> {
        let sides = 4 * level.plane.end() as usize;
        let mut cotangents = pages::with_room(sides);
        cotangents.resize(sides, NO_CORNER);
        let edges = core::mem::take(&mut level.stack);
        let mut sweep = Self { level, places, taken: Vec::new(), most, cotangents, edges, noted: 0 };
        if !sweep.look_at_all() || !sweep.turns_round_once() {
            return None;
        }
        for (vertex, &place) in sweep.level.vertices.iter_mut().zip(places) {
            vertex.point = place;
        }
        sweep.edges.truncate(sweep.noted);
        sweep.level.stack = core::mem::take(&mut sweep.edges);
        sweep.flip_all();
        Some(sweep.taken)
    }

    fn site(&self, vertex: u32) -> P::Site {
        self.places[vertex as usize].site()
    }

    /// Looks at all triangles at the new places, and takes out the vertices in the way. Says whether that was possible.
    fn look_at_all(&mut self) -> bool {
        let mut open: Vec<u32> = Vec::new();
        for triangle in 0..self.level.plane.end() {
            let Triangle { vertices, across } = *self.level.plane.get(triangle);
            // Free triangles and ghost triangles have a vertex without a place.
            let [a, b, c] = vertices.map(|vertex| self.places.get(vertex as usize));
            let cotangents = match (a, b, c) {
                (Some(a), Some(b), Some(c)) => P::Site::cotangents([a.site(), b.site(), c.site()]),
                _ => None,
            };
            let Some(cotangents) = cotangents else {
                open.push(triangle);
                if !self.work_off(&mut open) {
                    return false;
                }
                continue;
            };
            let first = Side::new(triangle, 0).number();
            self.cotangents[first..first + 3].copy_from_slice(&cotangents);
            let others = across.map(|other| self.cotangents[other.number()]);
            let sums = [0, 1, 2].map(|slot| i32::from(cotangents[slot]) + i32::from(others[slot]));
            self.note_edges(triangle, sums.map(|sum| sum < LEAST_SUM));
        }
        true
    }

    /// Notes some of the edges of a triangle. Always writes all three and counts those that are meant: no processor
    /// would predict branches here.
    #[inline(always)]
    fn note_edges(&mut self, triangle: u32, is_meant: [bool; 3]) {
        if self.edges.len() < self.noted + 3 {
            self.edges.resize(2 * self.noted + 64, Side::new(0, 0));
        }
        for (slot, is_meant) in is_meant.into_iter().enumerate() {
            self.edges[self.noted] = Side::new(triangle, slot);
            self.noted += usize::from(is_meant);
        }
    }

    /// Looks at the triangles of a list, and at all that change by that. Says whether no more vertices were in the way
    /// than may be.
    fn work_off(&mut self, open: &mut Vec<u32>) -> bool {
        while let Some(triangle) = open.pop() {
            let Some(vertex) = self.vertex_in_the_way(triangle) else { continue };
            if self.taken.len() == self.most || !self.take_out(vertex, open) {
                return false;
            }
        }
        true
    }

    /// Takes a vertex out of the old mesh, and has all triangles looked at that change by that; says whether there
    /// still are triangles.
    fn take_out(&mut self, vertex: u32, open: &mut Vec<u32>) -> bool {
        let (name, near) = (self.level.vertices[vertex as usize].name, self.level.some_neighbor(vertex));
        self.taken.push(Taken { vertex, name, near });
        for side in self.level.star(vertex) {
            let first = Side::new(side.triangle(), 0).number();
            self.cotangents[first..first + 3].fill(NO_CORNER);
        }
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
    /// the edge of a ghost triangle. If the triangle turns left, all its edges are noted.
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
        if P::Site::orient2d(a, b, c).is_gt() {
            self.note_edges(triangle, [true; 3]);
            self.measure(triangle);
            return None;
        }
        // The vertex opposite the longest edge has crossed it.
        let lengths = [b.rough_distance(c), c.rough_distance(a), a.rough_distance(b)];
        let longest = (0..3).max_by(|&one, &other| lengths[one].total_cmp(&lengths[other])).unwrap_or(0);
        Some(found.vertices[longest])
    }

    /// Notes the cotangents of a triangle that turns left.
    #[inline(always)]
    fn measure(&mut self, triangle: u32) {
        let sites = self.level.plane.get(triangle).vertices.map(|vertex| self.site(vertex));
        let first = Side::new(triangle, 0).number();
        let cotangents = P::Site::cotangents(sites).unwrap_or([UNKNOWN; 3]);
        self.cotangents[first..first + 3].copy_from_slice(&cotangents);
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

    /// Makes a triangulation canonical. All edges that may have to be flipped are on the stack of the level.
    fn flip_all(&mut self) {
        while let Some(side) = self.level.stack.pop() {
            let own = self.cotangents[side.number()];
            // A free triangle has no other sides, and ghost triangles have no edges to flip.
            if own == NO_CORNER {
                continue;
            }
            let other = self.level.plane.across(side);
            let sum = i32::from(own) + i32::from(self.cotangents[other.number()]);
            if sum >= LEAST_SUM {
                continue;
            }
            if (-2 * MOST..=-LEAST_SUM).contains(&sum) || self.level.must_flip(side) {
                self.level.flip(side);
                self.measure(side.triangle());
                self.measure(other.triangle());
            }
        }
    }
}
