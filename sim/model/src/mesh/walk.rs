//! Point location by a visibility walk (Devillers, Pion, Teillaud 2002) over finite triangles. In hardware,
//! `hdl/src/engine/visit/verdict_logic.rs` decides each step.

use super::Mesh;
use crate::predicate::{orient2d, Point};

impl Mesh {
    /// The id of the record that holds `p`: a finite triangle with `p` inside or on its border, or a ghost triangle
    /// with `p` strictly beyond its hull edge. From `start` on, the walk leaves each triangle across the edge whose
    /// orient2d is lowest, if that is negative. Of equal ones the first slot counts. No triangle comes twice, because
    /// the mesh is Delaunay (docs/engine.md, "Why some insertion always finishes").
    pub(super) fn locate(&mut self, p: Point, start: u32) -> u32 {
        let mut id = start;
        loop {
            self.counts.walk_visits += 1;
            match self.step(id, p) {
                None => return id,
                Some(next) => id = next,
            }
        }
    }

    /// The record to visit after `id`, or `None` if `id` holds `p`.
    #[inline]
    fn step(&self, id: u32, p: Point) -> Option<u32> {
        let record = &self.records[id as usize];
        let at = |k: usize| self.points[record.v[k] as usize];
        if let Some(slot) = self.infinite_slot(record.v) {
            let beyond = orient2d(at((slot + 1) % 3), at((slot + 2) % 3), p) > 0;
            return (!beyond).then(|| record.n[slot]);
        }
        let corners = [at(0), at(1), at(2)];
        let sides = [
            orient2d(corners[1], corners[2], p),
            orient2d(corners[2], corners[0], p),
            orient2d(corners[0], corners[1], p),
        ];
        let first_two = usize::from(sides[1] < sides[0]);
        let lowest = if sides[2] < sides[first_two] { 2 } else { first_two };
        (sides[lowest] < 0).then(|| record.n[lowest])
    }
}
