//! Removing a vertex from a mesh with constraints: the hole is filled by cutting ears, and flips do the rest.
//!
//! Gift wrapping ([`hole`](super::hole)) wants every edge of the border to be an edge of the Delaunay triangulation,
//! which constraints do not promise. The vertex saw the whole hole, so an ear that leaves the vertex on its inner side
//! leaves a hole that the vertex still sees, and there always is such an ear (Devillers, *On deletion in Delaunay
//! triangulations*, 1999).

use super::level::{Border, Level};
use super::plane::{Side, INFINITE};
use crate::plane_point::PlanePoint;
use crate::site::Site;

impl<P: PlanePoint> Level<P> {
    /// Removes a vertex at which no edge is fixed, and lists the triangles that fill its hole as
    /// [`made`](Self::made). Their edges may have to be flipped.
    pub(super) fn remove_by_ears(&mut self, vertex: u32) {
        self.made.clear();
        if !self.is_plane() {
            self.line.remove(&self.site(vertex));
            return self.release(vertex);
        }
        self.collect_star(vertex);
        let mut border = core::mem::take(&mut self.border);
        if !self.folds(&border) {
            match border.iter().position(|edge| edge.from == INFINITE) {
                Some(place) => {
                    border.rotate_left(place);
                    self.fill_open(&border);
                }
                None => self.fill_closed(&border, self.site(vertex)),
            }
            while let Some(triangle) = self.dead.pop() {
                self.plane.release(triangle);
            }
        }
        self.border = border;
        self.release(vertex);
    }

    /// Cuts the ears of a hole inside the hull, all of which `center` sees. O(k).
    fn fill_closed(&mut self, border: &[Border], center: P::Site) {
        let count = border.len();
        let mut edges = border.to_vec();
        let mut next: alloc::vec::Vec<usize> = (1..=count).map(|place| place % count).collect();
        let mut last: alloc::vec::Vec<usize> = (0..count).map(|place| (place + count - 1) % count).collect();
        let (mut tip, mut left) = (0, count);
        while left > 3 {
            let (before, after) = (last[tip], next[tip]);
            let [a, b, c] = [before, tip, after].map(|place| self.site(edges[place].from));
            if P::Site::orient2d(a, b, c).is_le() || P::Site::orient2d(a, c, center).is_lt() {
                tip = after;
                continue;
            }
            edges[before] = self.cut(edges[before], edges[tip], edges[after].from);
            (next[before], last[after]) = (after, before);
            left -= 1;
            tip = before;
        }
        let (before, after) = (last[tip], next[tip]);
        let closing = self.cut(edges[before], edges[tip], edges[after].from);
        self.plane.link(closing.outside, edges[after].outside);
    }

    /// Cuts the ears of a hole at the hull. The border begins with the infinite vertex. Edges at which no ear is left
    /// become hull edges. O(k).
    fn fill_open(&mut self, border: &[Border]) {
        let (first, last) = (border[0], border[border.len() - 1]);
        let mut open: alloc::vec::Vec<Border> = alloc::vec::Vec::new();
        for pair in border[1..].windows(2) {
            let (mut edge, to) = (pair[0], pair[1].from);
            while let Some(&before) = open.last() {
                let [a, b, c] = [before.from, edge.from, to].map(|vertex| self.site(vertex));
                if P::Site::orient2d(a, b, c).is_le() {
                    break;
                }
                edge = self.cut(before, edge, to);
                open.pop();
            }
            open.push(edge);
        }
        let mut behind = first.outside;
        for (place, &Border { from, outside }) in open.iter().enumerate() {
            let to = open.get(place + 1).map_or(last.from, |next| next.from);
            let ghost = self.make([from, to, INFINITE], outside);
            self.plane.link(Side::new(ghost, 1), behind);
            [from, to, INFINITE].into_iter().for_each(|vertex| self.note(vertex, ghost));
            behind = Side::new(ghost, 0);
        }
        self.plane.link(behind, last.outside);
    }

    /// Makes the triangle on two edges of a border that follow one another; returns the edge that takes their place.
    fn cut(&mut self, one: Border, other: Border, to: u32) -> Border {
        let corners = [one.from, other.from, to];
        let triangle = self.make(corners, one.outside);
        self.plane.link(Side::new(triangle, 0), other.outside);
        corners.into_iter().for_each(|vertex| self.note(vertex, triangle));
        Border { from: one.from, outside: Side::new(triangle, 1) }
    }
}
