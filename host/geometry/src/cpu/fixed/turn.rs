//! The turn around an end of a constraint, up to the edge or the triangle that leads towards its other end.

use core::cmp::Ordering;

use super::mesh::Fixed;
use crate::cpu::kernel::Kernel;

/// Half-edges that are looked at around one end before the other end takes turns with it.
const FEW: usize = 12;

/// Where a constraint goes from one of its ends.
pub(super) enum Way {
    /// Along this half-edge, which leaves the end.
    Along(u32),
    /// Through the triangle to the left of this half-edge, which leaves the end.
    Through(u32),
}

/// A turn around a vertex. Each half-edge that it passes tells on which side the other end lies, so it turns the
/// shorter way round.
struct Turn<K: Kernel> {
    /// The vertex and the other end.
    from: K::Site,
    to: K::Site,
    /// The number of the other end.
    target: u32,
    /// The half-edge that has been reached.
    edge: u32,
    /// Whether the turn is clockwise; not known at the first half-edge.
    is_clockwise: Option<bool>,
}

impl<K: Kernel> Turn<K> {
    fn new(mesh: &Fixed<'_, K>, from: u32, target: u32) -> Self {
        let edge = mesh.at[from as usize];
        Self { from: mesh.site(from), to: mesh.site(target), target, edge, is_clockwise: None }
    }

    /// Looks at one half-edge, and goes on to the next if the way is not found.
    #[inline(always)]
    fn advance(&mut self, mesh: &Fixed<'_, K>) -> Option<Way> {
        let edge = self.edge;
        let end = mesh.end(edge);
        if end == self.target {
            return Some(Way::Along(edge));
        }
        let side = K::orient2d(self.from, mesh.site(end), self.to);
        if side.is_eq() && is_between(self.from, mesh.site(end), self.to) {
            return Some(Way::Along(edge));
        }
        match (self.is_clockwise, side) {
            // The half-edge before this one, clockwise, had the other end to its left.
            (Some(false), Ordering::Less) => return Some(Way::Through(mesh.half(edge).previous)),
            (Some(true), Ordering::Greater) => return Some(Way::Through(edge)),
            (None, _) => self.is_clockwise = Some(side.is_lt()),
            _ => {}
        }
        let half = mesh.half(edge);
        self.edge = if self.is_clockwise == Some(true) { half.previous } else { half.next };
        None
    }
}

/// Whether `q`, a point on the line of `a` and `b`, lies strictly between them.
pub(super) fn is_between<S: Ord>(a: S, q: S, b: S) -> bool {
    (a < q) == (q < b) && q != a && q != b
}

impl<K: Kernel> Fixed<'_, K> {
    /// The way along a constraint, from one of its ends: the first one, unless many edges meet there and fewer at the
    /// other. Which end it is comes first in the result.
    ///
    /// Of two ends that are joined in a plane graph nearly always one has few edges, so many constraints at one vertex
    /// do not cost its whole circle each.
    pub(super) fn way(&self, [from, to]: [u32; 2]) -> (usize, Way) {
        let mut one = Turn::new(self, from, to);
        for _ in 0..FEW {
            if let Some(way) = one.advance(self) {
                return (0, way);
            }
        }
        let mut other = Turn::new(self, to, from);
        loop {
            if let Some(way) = one.advance(self) {
                return (0, way);
            }
            if let Some(way) = other.advance(self) {
                return (1, way);
            }
        }
    }
}
