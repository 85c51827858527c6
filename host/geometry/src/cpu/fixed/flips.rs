//! Flips of free edges, until the mesh is canonical again.

use super::mesh::{Fixed, FIXED, VERTEX};
use crate::cpu::kernel::{Ends, Kernel};
use crate::cpu::triangulator::Error;

/// The number of freed edges after which the caller is asked whether the work goes on.
const EDGES_PER_LOOK: usize = 64;

/// The four vertices around an edge from `a` to `b`: its ends, the apex `c` to its left and the apex `d` to its right.
/// The half-edges to both apexes are those around `a` and those around `b`.
struct Around {
    ends: [u32; 2],
    apexes: [u32; 2],
    from_a: [u32; 2],
    from_b: [u32; 2],
}

impl<K: Kernel> Fixed<'_, K> {
    /// Flips inner edges until the mesh is canonical. All inner edges are on the stack.
    ///
    /// No other edge has to be looked at. A triangle that a constraint does not cross stays in the mesh: none of its
    /// edges is crossed, and a point that conflicts with it is not seen from it, with the constraint as without. So the
    /// edges around the room stay, whatever lies behind them.
    pub(super) fn repair_inner(&mut self) {
        while let Some(edge) = self.stack.pop() {
            let around = self.around(edge);
            if self.must_flip(&around) {
                self.flip(edge, &around);
                for beside in around.from_a.into_iter().chain(around.from_b) {
                    if self.is_inner(beside) {
                        self.stack.push(beside);
                    }
                }
            }
        }
    }

    /// Flips edges until the mesh is canonical. All edges that may have to be flipped are on the stack.
    fn repair(&mut self) {
        while let Some(edge) = self.stack.pop() {
            if self.is_fixed(edge) || self.is_outside(edge) || self.is_outside(edge ^ 1) {
                continue;
            }
            let around = self.around(edge);
            if self.must_flip(&around) {
                self.flip(edge, &around);
                self.stack.extend(around.from_a.into_iter().chain(around.from_b));
            }
        }
    }

    /// Frees all fixed edges, and flips edges until the mesh is the canonical one without constraints. Every other edge
    /// is locally Delaunay, so only the freed ones and those around them may have to be flipped.
    ///
    /// # Errors
    /// `go_on`, which is called from time to time, ends the work.
    pub(super) fn release(mut self, go_on: &mut dyn FnMut() -> Result<(), Error>) -> Result<(), Error> {
        let fixed = core::mem::take(&mut self.fixed);
        for &pair in &fixed {
            self.halves[pair as usize].end &= !FIXED;
            self.halves[pair as usize ^ 1].end &= !FIXED;
        }
        // Edges are repaired 64 at a time, so that the caller can end the work between them.
        for some in fixed.chunks(EDGES_PER_LOOK) {
            go_on()?;
            self.stack.extend_from_slice(some);
            self.repair();
        }
        Ok(())
    }

    #[inline(always)]
    fn around(&self, edge: u32) -> Around {
        let (one, other) = (self.half(edge), self.half(edge ^ 1));
        Around {
            ends: [other.end & VERTEX, one.end & VERTEX],
            apexes: [one.next, one.previous].map(|half| self.end(half)),
            from_a: [one.next, one.previous],
            from_b: [other.previous, other.next],
        }
    }

    /// Whether the apex to the right conflicts with the triangle to the left.
    #[inline(always)]
    fn must_flip(&self, around: &Around) -> bool {
        let [a, b, c, d] =
            [around.ends[0], around.ends[1], around.apexes[0], around.apexes[1]].map(|vertex| self.site(vertex));
        // Seen from the edge between `c` and `a`, both `b` and `d` lie to the left if the edge can be flipped. Where
        // `d` does not, it lies in the angle opposite that at `a`, which is outside the circle.
        let ends = Ends { a: c, b: a, bounds: K::bounds(|| [a, b, c, d]) };
        K::is_left_and_inside(ends, K::see(ends, b), K::see(ends, d))
    }

    /// Replaces an edge by the other diagonal. It keeps its marks.
    ///
    /// ```text
    ///      c            c
    ///     / \          /|\
    ///    a-->b   ->   a | b
    ///     \ /          \v/
    ///      d            d
    /// ```
    #[inline(always)]
    fn flip(&mut self, edge: u32, around: &Around) {
        let Around { ends: [a, b], apexes: [c, d], from_a: [ac, ad], from_b: [bc, bd] } = *around;
        let marks = self.half(edge).end & !VERTEX;
        self.unlink(edge, a);
        self.unlink(edge ^ 1, b);
        self.insert(edge, d | marks, ac ^ 1, bc ^ 1);
        self.insert(edge ^ 1, c | marks, bd ^ 1, ad ^ 1);
    }
}
