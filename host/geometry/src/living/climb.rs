//! The vertex nearest to a place, by climbing.
//!
//! The neighbours of a vertex, seen from there and inverted (`double/inverse`), are the corners of a convex polygon, in
//! the same order: a circle through the vertex that holds no other one becomes a line with all others on one side. The
//! infinite vertex becomes the vertex itself. So their heights rise and fall only once around the vertex, and a walk
//! around it that climbs finds the highest without visiting all. If that one is not nearer to the place, none is, and
//! the vertex is the nearest of all.
//!
//! Source: Brown, *Voronoi diagrams from convex hulls*, 1979, has the inversion.

use super::level::Level;
use super::plane::{Side, INFINITE};
use crate::double::{height, HEIGHT_BOUND};
use crate::plane_point::PlanePoint;
use crate::site::Site;

impl<P: PlanePoint> Level<P> {
    /// The vertex nearest to a place, from a side opposite a vertex near it. `None` where rounded numbers leave
    /// something open, as they do if two vertices are equally near.
    pub(super) fn climb(&self, q: P::Site, mut side: Side) -> Option<u32> {
        loop {
            let vertex = self.plane.apex(side);
            let site = self.site(vertex);
            let to_q = P::Site::vector(site, q);
            let height_of = |end: u32| match end {
                INFINITE => Some(0.0),
                end => height(to_q, P::Site::vector(site, self.site(end))),
            };
            let [from, to] = self.plane.ends(side).map(height_of);
            let (from, to) = (from?, to?);
            // Counter-clockwise, or the other way.
            let is_ahead = to > from;
            let mut best = from.max(to);
            if (to - from).abs() <= HEIGHT_BOUND {
                return None;
            }
            while best <= 0.5 + HEIGHT_BOUND {
                let next = if is_ahead { side.next() } else { side.last() };
                let other = self.plane.across(next);
                side = if is_ahead { other.next() } else { other.last() };
                let found = height_of(self.plane.ends(side)[usize::from(is_ahead)])?;
                if found < best - HEIGHT_BOUND {
                    return (best < 0.5 - HEIGHT_BOUND).then_some(vertex);
                }
                if found <= best + HEIGHT_BOUND {
                    return None;
                }
                best = found;
            }
            // The last vertex that was looked at is nearer to the place.
            side = if is_ahead { side.last() } else { side.next() };
        }
    }
}
