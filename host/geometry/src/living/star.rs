//! Walks around a vertex.

use super::level::Level;
use super::plane::{Side, INFINITE};
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// The sides opposite a vertex, counter-clockwise, each in one of the triangles around it.
pub struct Star<'a, P: PlanePoint> {
    level: &'a Level<P>,
    start: Side,
    next: Option<Side>,
}

impl<P: PlanePoint> Iterator for Star<'_, P> {
    type Item = Side;

    #[inline]
    fn next(&mut self) -> Option<Side> {
        let side = self.next?;
        let following = self.level.plane.across(side.next()).next();
        self.next = (following != self.start).then_some(following);
        Some(side)
    }
}

impl<P: PlanePoint> Level<P> {
    /// The sides opposite a vertex, while there are triangles.
    #[inline]
    pub(super) fn star(&self, vertex: u32) -> Star<'_, P> {
        self.star_from(self.side_opposite(vertex))
    }

    /// The sides opposite the vertex that is opposite the given one, which comes first.
    #[inline]
    pub(super) fn star_from(&self, start: Side) -> Star<'_, P> {
        Star { level: self, start, next: Some(start) }
    }

    /// Visits the sides opposite the vertex that is opposite the given one, in both directions by turns, from the given
    /// one on; `is_ahead` is true for those that were found counter-clockwise.
    ///
    /// Each triangle names the next, so a walk around a star waits for memory again and again. Two walks wait at the
    /// same time.
    #[inline(always)]
    pub(super) fn star_both_ways(&self, start: Side, mut visit: impl FnMut(Side, bool)) {
        visit(start, true);
        let (mut ahead, mut behind) = (start, start);
        loop {
            ahead = self.plane.across(ahead.next()).next();
            if ahead == behind {
                return;
            }
            visit(ahead, true);
            behind = self.plane.across(behind.last()).last();
            if behind == ahead {
                return;
            }
            visit(behind, false);
        }
    }

    /// The vertices that have an edge to this one, while there are triangles; also the infinite one.
    #[inline]
    pub(super) fn link(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        self.star(vertex).map(|side| self.plane.ends(side)[0])
    }

    /// The vertex nearest to a place, from a vertex near it. Of vertices at the same distance the lexicographically
    /// smallest is the nearest.
    ///
    /// A vertex that is not the nearest has a neighbour that is nearer: this is so in the canonical mesh because the
    /// order of ties is that of the tie rule, by which smaller vertices are lowered more.
    pub(super) fn nearest(&self, q: P::Site, from: u32) -> u32 {
        if !self.is_plane() {
            return self.nearest_on_line(q).unwrap_or(from);
        }
        let (mut best, mut site) = (from, self.site(from));
        loop {
            let start = best;
            self.star_both_ways(self.side_opposite(start), |side, _| {
                let vertex = self.plane.ends(side)[0];
                if vertex == INFINITE {
                    return;
                }
                let other = self.site(vertex);
                if P::Site::compare_nearness(q, other, site).is_lt() {
                    (best, site) = (vertex, other);
                }
            });
            if best == start {
                return best;
            }
        }
    }

    /// The vertex nearest to a place, while all vertices lie on one line. Along the line distances fall and then rise.
    fn nearest_on_line(&self, q: P::Site) -> Option<u32> {
        let mut best = self.line.range(..q).next_back().or_else(|| self.line.iter().next())?;
        let is_nearer = |one: &P::Site, other: &P::Site| P::Site::compare_nearness(q, *one, *other).is_lt();
        for next in self.line.range(*best.0..).skip(1) {
            if !is_nearer(next.0, best.0) {
                break;
            }
            best = next;
        }
        for next in self.line.range(..*best.0).rev() {
            if !is_nearer(next.0, best.0) {
                break;
            }
            best = next;
        }
        Some(*best.1)
    }
}
