//! The parts into which fixed edges cut the plane, and which of them belong to a domain.
//!
//! A flood across free edges gives each part a number. The outside of the hull is a part, too, unless all triangles are
//! wanted. From a part to the next, across a fixed edge, the number of rings around changes by the constraints along
//! that edge.

use alloc::vec;
use alloc::vec::Vec;

use super::mesh::{Fixed, Part};
use crate::constraints::repeats::Repeats;
use crate::cpu::kernel::Kernel;
use crate::pages;
use crate::plan::Domain;

/// Marks a half-edge whose part is not known.
const NONE: u32 = u32::MAX;

/// The parts of a mesh.
pub(super) struct Parts {
    /// The part at the left of each half-edge.
    of: Vec<u32>,
    /// The number of times that the rings run around each part.
    turns: Vec<i64>,
}

/// The constraints of a boundary.
#[derive(Clone, Copy)]
pub(super) struct Boundary<'a> {
    pub(super) parts: &'a [Part],
    /// The constraints that have the same parts as another.
    pub(super) repeats: &'a Repeats,
    /// The vertices at the ends of all constraints.
    pub(super) ends: &'a [[u32; 2]],
    /// The number of constraints, from the first on, that bound the domain.
    pub(super) count: usize,
    pub(super) domain: Domain,
}

impl Boundary<'_> {
    /// Whether the constraints form rings, as far as the domain needs that.
    pub(super) fn is_closed(&self, vertices: usize) -> bool {
        let mut sums: Vec<i32> = pages::zeros(vertices);
        let back = if self.domain == Domain::NonZero { -1 } else { 1 };
        for &[from, to] in &self.ends[..self.count] {
            sums[from as usize] += 1;
            sums[to as usize] += back;
        }
        match self.domain {
            Domain::All | Domain::Holes => true,
            Domain::EvenOdd => sums.iter().all(|sum| sum % 2 == 0),
            Domain::NonZero => sums.iter().all(|&sum| sum == 0),
        }
    }

    /// By how much the number of turns at the left of the first half of each pair exceeds that at its right.
    fn steps<K: Kernel>(&self, mesh: &Fixed<'_, K>) -> Vec<i32> {
        let rises = |[from, to]: [u32; 2]| mesh.site(from) < mesh.site(to);
        let mut steps = pages::zeros(mesh.halves.len() / 2);
        // A part goes along its constraint, so both rise or both fall.
        let step = |constraint: u32, part_rises: bool| match self.domain {
            _ if constraint as usize >= self.count => 0,
            Domain::NonZero if rises(self.ends[constraint as usize]) != part_rises => -1,
            _ => 1,
        };
        for part in self.parts {
            let pair = part.edge & !1;
            let rises = rises([mesh.origin(pair), mesh.end(pair)]);
            let own = [part.constraint].into_iter().chain(self.repeats.of(part.constraint).iter().map(|pair| pair[1]));
            steps[pair as usize / 2] += own.map(|constraint| step(constraint, rises)).sum::<i32>();
        }
        steps
    }
}

impl Parts {
    /// Numbers the parts. O(n).
    pub(super) fn of<K: Kernel>(mesh: &Fixed<'_, K>, boundary: &Boundary<'_>) -> Self {
        let mut parts = Self { of: vec![NONE; mesh.halves.len()], turns: vec![] };
        let (mut open, mut borders) = (Vec::new(), Vec::new());
        if boundary.domain == Domain::All {
            for edge in mesh.edges().filter(|&edge| !mesh.is_outside(edge)) {
                if parts.of[edge as usize] == NONE {
                    open.push(edge);
                    parts.flood(mesh, 0, &mut open, &mut borders);
                }
            }
            return parts;
        }
        for edge in mesh.edges().filter(|&edge| mesh.is_outside(edge)) {
            parts.of[edge as usize] = 0;
            if mesh.is_fixed(edge) {
                borders.push(edge);
            } else {
                open.push(edge ^ 1);
            }
        }
        parts.flood(mesh, 0, &mut open, &mut borders);
        let steps = boundary.steps(mesh);
        while let Some(border) = borders.pop() {
            if parts.of[border as usize ^ 1] == NONE {
                let step = i64::from(steps[border as usize / 2]) * if border.is_multiple_of(2) { 1 } else { -1 };
                let turns = parts.turns[parts.of[border as usize] as usize] - step;
                open.push(border ^ 1);
                parts.flood(mesh, turns, &mut open, &mut borders);
            }
        }
        parts
    }

    /// Numbers the part of some half-edges, and adds the fixed edges along it to the borders.
    fn flood<K: Kernel>(&mut self, mesh: &Fixed<'_, K>, turns: i64, open: &mut Vec<u32>, borders: &mut Vec<u32>) {
        let number = self.turns.len() as u32;
        self.turns.push(turns);
        while let Some(edge) = open.pop() {
            if self.of[edge as usize] != NONE {
                continue;
            }
            for side in mesh.face(edge) {
                self.of[side as usize] = number;
                if mesh.is_fixed(side) {
                    borders.push(side);
                } else if self.of[side as usize ^ 1] == NONE && !mesh.is_outside(side ^ 1) {
                    open.push(side ^ 1);
                }
            }
        }
    }

    /// The part at the left of a half-edge.
    #[inline(always)]
    pub(super) fn at(&self, edge: u32) -> u32 {
        self.of[edge as usize]
    }

    /// For each part, whether it belongs to the domain, as far as rings decide that.
    pub(super) fn chosen(&self, domain: Domain) -> Vec<bool> {
        match domain {
            Domain::All => vec![true; self.turns.len()],
            Domain::Holes => (0..self.turns.len()).map(|part| part != 0).collect(),
            Domain::EvenOdd => self.turns.iter().map(|turns| turns % 2 != 0).collect(),
            Domain::NonZero => self.turns.iter().map(|&turns| turns != 0).collect(),
        }
    }
}

impl<K: Kernel> Fixed<'_, K> {
    /// The half-edges of all edges.
    pub(super) fn edges(&self) -> impl Iterator<Item = u32> + '_ {
        let is_used = |&edge: &u32| self.end(edge) != self.origin(edge);
        (0..self.halves.len() as u32).filter(is_used)
    }

    /// The half-edges around the triangle to the left of one.
    #[inline(always)]
    pub(super) fn face(&self, edge: u32) -> [u32; 3] {
        let second = self.follower(edge);
        [edge, second, self.follower(second)]
    }

    /// A half-edge with the triangle of a place to its left, by a walk from another. `None` if the place is outside the
    /// hull, at a vertex, or on a fixed edge, or if the walk is long: it turns at random, but a visibility walk may run
    /// in circles on a mesh with constraints.
    pub(super) fn locate(&self, q: K::Site, near: u32) -> Option<u32> {
        let (mut edge, mut state) = (near, 0x9e37_79b9_u32);
        for _ in 0..self.halves.len() {
            // A generator of Marsaglia (2003), good enough to choose between two sides.
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            let mut face = self.face(edge);
            face.rotate_left((state % 3) as usize);
            let turns = face.map(|side| K::orient2d(self.site(self.origin(side)), self.site(self.end(side)), q));
            match turns.iter().position(|turn| turn.is_lt()) {
                Some(place) if self.is_outside(face[place] ^ 1) => return None,
                Some(place) => edge = face[place] ^ 1,
                None => {
                    let on = || face.iter().zip(turns).filter(|(_, turn)| turn.is_eq()).map(|(&side, _)| side);
                    let is_inside = on().count() < 2 && on().all(|side| !self.is_fixed(side));
                    return is_inside.then_some(edge);
                }
            }
        }
        None
    }
}
