//! Finding the triangle at a place.

use core::cmp::Ordering;

use super::fixed_mesh::FixedMesh;
use super::network::Network;
use crate::living::plane::{Side, INFINITE};
use crate::site::Site;

/// The triangle or the edge at a place.
pub(super) enum Found {
    /// The place lies in this triangle: inside, on a free edge, or at a vertex without fixed edges.
    Inside(u32),
    /// The place lies on this fixed edge, or at one of its ends.
    OnFixed([u32; 2]),
    Outside,
}

impl<S: Site> Network<'_, S> {
    /// Finds what is at a place by a walk from a triangle. On a mesh with constraints a walk may run in circles, so it
    /// turns at random, and after as many steps as there are triangles all triangles are tried.
    pub fn locate(&self, q: S, near: u32) -> Found {
        let (mut triangle, mut state) = (near, 0x9e37_79b9_u32);
        for _ in 0..self.plane.len() {
            // The hull is convex, so a place behind one of its edges lies outside.
            if self.is_ghost(triangle) {
                return Found::Outside;
            }
            // A generator of Marsaglia (2003), good enough to choose between two sides.
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            let first = (state % 3) as usize;
            let behind =
                (0..3).map(|step| Side::new(triangle, (first + step) % 3)).find(|&side| self.is_behind(side, q));
            match behind {
                Some(side) => triangle = self.plane.across(side).triangle(),
                None => return self.at_place(triangle, q),
            }
        }
        let mut all = self.plane.iter().map(|(triangle, _)| triangle).filter(|&triangle| !self.is_ghost(triangle));
        let holds = |triangle: &u32| (0..3).all(|slot| !self.is_behind(Side::new(*triangle, slot), q));
        all.find(holds).map_or(Found::Outside, |triangle| self.at_place(triangle, q))
    }

    fn turn(&self, side: Side, q: S) -> Ordering {
        let [a, b] = self.plane.ends(side);
        S::orient2d(self.site(a), self.site(b), q)
    }

    fn is_behind(&self, side: Side, q: S) -> bool {
        !self.plane.ends(side).contains(&INFINITE) && self.turn(side, q).is_lt()
    }

    /// The triangle or the fixed edge at a place in a triangle or on its border.
    fn at_place(&self, triangle: u32, q: S) -> Found {
        let sides = [0, 1, 2].map(|slot| Side::new(triangle, slot));
        let corner = self.plane.get(triangle).vertices.into_iter().find(|&vertex| self.site(vertex) == q);
        if let Some(corner) = corner {
            let mut around = self.around(corner, triangle).flat_map(|side| [side.next(), side.last()]);
            let fixed = around.find(|&side| self.is_fixed(side));
            return fixed.map_or(Found::Inside(triangle), |side| Found::OnFixed(self.edge(side)));
        }
        let on_fixed = sides.into_iter().find(|&side| self.is_fixed(side) && self.turn(side, q).is_eq());
        on_fixed.map_or(Found::Inside(triangle), |side| Found::OnFixed(self.edge(side)))
    }
}
