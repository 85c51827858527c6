//! From points on one line to triangles, and back.

use alloc::vec::Vec;

use super::level::Level;
use super::plane::Side;
use crate::plane_point::PlanePoint;
use crate::site::Site;

impl<P: PlanePoint> Level<P> {
    /// Puts a new vertex beside those on the line. If it does not lie on the line, triangles are made.
    pub(super) fn add_to_line(&mut self, vertex: u32) {
        let q = self.site(vertex);
        let (first, last) = (self.line.first_key_value(), self.line.last_key_value());
        if let (Some((&a, _)), Some((&b, _))) = (first, last) {
            let turn = P::Site::orient2d(a, b, q);
            // A single vertex is on the line of itself and any other.
            if turn.is_ne() {
                return self.unfold(vertex, turn.is_gt());
            }
        }
        self.line.insert(q, vertex);
    }

    /// Makes the triangles of all vertices on the line and one apex, which lies to the left of the line or to the
    /// right.
    fn unfold(&mut self, apex: u32, apex_is_left: bool) {
        let line = core::mem::take(&mut self.line);
        let chain: Vec<u32> =
            if apex_is_left { line.into_values().collect() } else { line.into_values().rev().collect() };
        // The hull, counter-clockwise: the chain, and the apex.
        let corners = chain.len() + 1;
        self.plane.reserve(2 * corners - 2);
        for _ in 0..2 * corners - 2 {
            self.plane.allocate();
        }
        let ghost = |corner: usize| (chain.len() - 1 + corner % corners) as u32;
        for (corner, &from) in chain.iter().enumerate() {
            let to = chain.get(corner + 1).copied().unwrap_or(apex);
            self.plane.set_ghost(ghost(corner), [from, to]);
        }
        self.plane.set_ghost(ghost(chain.len()), [apex, chain[0]]);
        for corner in 0..corners {
            self.plane.link(Side::new(ghost(corner), 1), Side::new(ghost(corner + 1), 0));
        }
        for (triangle, ends) in (0u32..).zip(chain.windows(2)) {
            self.plane.set(triangle, [ends[0], ends[1], apex], [Side::new(0, 0); 3]);
            self.note(ends[0], triangle);
            self.note(ends[1], triangle);
            self.note(apex, triangle);
        }
        for triangle in 0..chain.len() - 1 {
            let (side, before) = (|slot| Side::new(triangle as u32, slot), triangle.wrapping_sub(1) as u32);
            self.plane.link(side(2), Side::new(ghost(triangle), 2));
            let behind = if triangle == 0 { Side::new(ghost(chain.len()), 2) } else { Side::new(before, 0) };
            self.plane.link(side(1), behind);
        }
        self.plane.link(Side::new(chain.len() as u32 - 2, 0), Side::new(ghost(chain.len() - 1), 2));
    }

    /// Puts the given vertices, which are all that are left, onto a line, if they lie on one; says whether they do.
    pub(super) fn fold(&mut self, left: &[u32]) -> bool {
        if let [one, other, rest @ ..] = left {
            let (a, b) = (self.site(*one), self.site(*other));
            if rest.iter().any(|&vertex| P::Site::orient2d(a, b, self.site(vertex)).is_ne()) {
                return false;
            }
        }
        self.plane.clear();
        for &vertex in left {
            self.note(vertex, 0);
        }
        self.line = left.iter().map(|&vertex| (self.site(vertex), vertex)).collect();
        true
    }
}
