//! The constrained mesh of a triangulation that has constraints, beside its Delaunay triangulation.
//!
//! Both have the same vertices under the same numbers. The Delaunay triangulation goes on answering which points are
//! near, for which a constrained mesh is of no use: the nearest point may lie behind a constraint.

use alloc::vec::Vec;

use super::level::Level;
use super::parts::Parts;
use super::plane::{Plane, Side, INFINITE};
use super::walk::Place;
use crate::constraints::fixed_mesh::{FixedMesh, Work};
use crate::constraints::force::{step, Stop};
use crate::plane_point::PlanePoint;

/// A mesh with fixed edges.
#[derive(Clone, Debug)]
pub struct ConstrainedLevel<P: PlanePoint> {
    pub level: Level<P>,
    pub parts: Parts,
    /// The constraint whose pieces are being forced.
    at_work: u32,
    /// A bit for each triangle that this constraint crosses.
    crossed: Vec<u64>,
    work: Work,
}

impl<P: PlanePoint> ConstrainedLevel<P> {
    /// The mesh without constraints.
    pub fn new(base: &Level<P>) -> Self {
        Self { level: base.clone(), parts: Parts::default(), at_work: 0, crossed: Vec::new(), work: Work::default() }
    }

    /// Adds a vertex, given one near it; returns its number. A piece that it lies on becomes two.
    pub fn add(&mut self, point: P, name: u32, near: Option<u32>) -> u32 {
        let place = self.level.find_straight(point.site(), near);
        let split = match place {
            Place::Edge(side) => Some(self.level.plane.ends(side)),
            Place::Between(one, other) => Some([one, other]),
            _ => None,
        };
        let own = split.map_or(Vec::new(), |edge| self.parts.take(edge));
        let parts = &self.parts;
        let vertex = self.level.add_among(point, name, place, |edge| parts.has(edge));
        for end in split.into_iter().flatten() {
            own.iter().for_each(|&constraint| self.parts.add([end, vertex], constraint));
        }
        vertex
    }

    /// Two constraints that would cross if the vertex, which is an end of none, were removed.
    pub fn crossing_at(&self, vertex: u32) -> Option<[u32; 2]> {
        let mut around = self.parts.around(vertex);
        let [first, one] = around.next()?;
        let beyond = self.parts.around(vertex).find(|&[other, own]| own == one && other != first)?[0];
        let other = self.parts.around(vertex).find(|&[end, _]| end != first && end != beyond)?[1];
        Some([one.min(other), one.max(other)])
    }

    /// Removes a vertex that is no end of a constraint, and at which no constraints cross. The pieces at it become one.
    pub fn remove(&mut self, vertex: u32) {
        let around: Vec<[u32; 2]> = self.parts.around(vertex).collect();
        around.iter().for_each(|&[other, constraint]| self.parts.remove([vertex, other], constraint));
        self.level.remove_by_ears(vertex);
        self.repair_made();
        if let (Some(first), Some(last)) = (around.first(), around.last()) {
            let mut own = around.iter().filter(|part| part[0] == first[0]);
            let is_free = own.all(|part| self.force(part[1], [first[0], last[0]]).is_ok());
            debug_assert!(is_free, "the line between both was free of crossings before");
        }
    }

    /// Flips the edges of the triangles that were made by a removal.
    fn repair_made(&mut self) {
        for &triangle in &self.level.made {
            self.work.stack.extend((0..3).map(|slot| Side::new(triangle, slot)));
        }
        self.flip_all();
    }

    /// Moves a vertex that may be removed.
    pub fn shift(&mut self, vertex: u32, point: P, name: u32) {
        let is_free = self.parts.around(vertex).next().is_none();
        if is_free && self.level.shift_in_star(vertex, point) {
            self.work.stack.append(&mut self.level.stack);
            return self.flip_all();
        }
        let near = self.level.some_neighbor(vertex);
        self.remove(vertex);
        // The vertex takes the number that has just become free.
        self.add(point, name, near);
    }

    /// Forces a constraint between two vertices.
    ///
    /// # Errors
    /// The constraint crosses a piece, which is returned. Pieces before the crossing are fixed already.
    pub fn force(&mut self, constraint: u32, [from, to]: [u32; 2]) -> Result<(), [u32; 2]> {
        self.at_work = constraint;
        if !self.level.is_plane() {
            self.force_on_line(constraint, [from, to]);
            return Ok(());
        }
        let mut at = from;
        while at != to {
            match step(self, at, to) {
                Ok(next) => at = next,
                Err(Stop::Crossing(edge)) => return Err(edge),
                // Not in a mesh.
                Err(Stop::NoMesh) => return Ok(()),
            }
        }
        Ok(())
    }

    fn force_on_line(&mut self, constraint: u32, ends: [u32; 2]) {
        let [a, b] = ends.map(|vertex| self.level.site(vertex));
        let on: Vec<u32> = self.level.line.range(a.min(b)..=a.max(b)).map(|(_, &vertex)| vertex).collect();
        on.windows(2).for_each(|two| self.parts.add([two[0], two[1]], constraint));
    }

    /// Frees the pieces of a constraint that begins at a vertex, as far as they are fixed.
    pub fn free(&mut self, constraint: u32, from: u32) {
        let mut at = from;
        loop {
            let next = self.parts.around(at).find(|part| part[1] == constraint);
            let Some([next, _]) = next else { break };
            self.parts.remove([at, next], constraint);
            if self.level.is_plane() && !self.parts.has([at, next]) {
                let side = self.level.star(at).find(|&side| self.level.plane.ends(side)[0] == next);
                self.work.stack.extend(side.map(Side::last));
            }
            at = next;
        }
        self.flip_all();
    }

    fn flip_all(&mut self) {
        // In a mesh no flip is refused.
        if self.repair().is_err() {
            self.work.stack.clear();
        }
    }
}

impl<P: PlanePoint> FixedMesh for ConstrainedLevel<P> {
    type Site = P::Site;

    #[inline(always)]
    fn site(&self, vertex: u32) -> P::Site {
        self.level.site(vertex)
    }

    #[inline(always)]
    fn plane(&self) -> &Plane {
        &self.level.plane
    }

    #[inline(always)]
    fn plane_mut(&mut self) -> &mut Plane {
        &mut self.level.plane
    }

    #[inline(always)]
    fn work(&mut self) -> &mut Work {
        &mut self.work
    }

    fn is_fixed(&self, side: Side) -> bool {
        self.parts.has(self.level.plane.ends(side))
    }

    fn fix(&mut self, side: Side) {
        self.parts.add(self.level.plane.ends(side), self.at_work);
    }

    fn write(&mut self, triangle: u32, vertices: [u32; 3], links: [(Side, bool); 3]) {
        self.level.plane.set(triangle, vertices, links.map(|(outside, _)| outside));
        for (slot, (outside, _)) in links.into_iter().enumerate() {
            self.level.plane.link(Side::new(triangle, slot), outside);
        }
        if let Some(bits) = self.crossed.get_mut(triangle as usize / 64) {
            *bits &= !(1 << (triangle % 64));
        }
        vertices.into_iter().for_each(|vertex| self.level.note(vertex, triangle));
    }

    fn triangle_at(&self, vertex: u32) -> u32 {
        self.level.side_opposite(vertex).triangle()
    }

    fn note(&mut self, vertex: u32, triangle: u32) {
        self.level.note(vertex, triangle);
    }

    fn mark_crossed(&mut self, triangle: u32) {
        let word = triangle as usize / 64;
        if self.crossed.len() <= word {
            self.crossed.resize(word + 1, 0);
        }
        self.crossed[word] |= 1 << (triangle % 64);
    }

    fn is_crossed(&self, triangle: u32) -> bool {
        self.crossed.get(triangle as usize / 64).is_some_and(|bits| bits >> (triangle % 64) & 1 != 0)
    }

    fn take_spare(&mut self) -> u32 {
        let triangle = self.level.plane.allocate();
        self.level.plane.set(triangle, [0, 1, INFINITE], [Side::new(triangle, 2); 3]);
        triangle
    }

    fn give_spare(&mut self, triangle: u32) {
        self.level.plane.release(triangle);
    }
}
