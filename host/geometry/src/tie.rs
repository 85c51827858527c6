//! The tie rule, in the form that the CPU triangulator and the living mesh share.

use core::cmp::Ordering;

/// Decides a tie: whether `q`, a point of the circle through the counter-clockwise triangle `a`, `b`, `c`, counts as
/// inside. The lexicographically smallest of the four points is lowered on the lifted paraboloid.
///
/// Lowering `q` always moves it inside. Lowering a corner moves `q` inside iff `q` lies beyond the opposite edge.
#[inline(always)]
pub(crate) fn is_inside_at_tie<S: Copy + Ord>([a, b, c]: [S; 3], q: S, orient2d: impl Fn(S, S, S) -> Ordering) -> bool {
    let smallest = a.min(b).min(c).min(q);
    let (from, to) = if smallest == q {
        return true;
    } else if smallest == a {
        (b, c)
    } else if smallest == b {
        (c, a)
    } else {
        (a, b)
    };
    orient2d(from, to, q).is_lt()
}
