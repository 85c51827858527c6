//! The arithmetic that the CPU triangulator needs for one kind of coordinates.

use core::cmp::Ordering;

use bytemuck::Zeroable;

use crate::tie::is_inside_at_tie;

/// Exact arithmetic for one kind of coordinates.
///
/// Divide and conquer knows points only through these functions: [`Integers`](super::view::Integers) of up to 32 bits,
/// and [`Filtered`](super::filtered::Filtered) numbers, which a floating-point filter decides before exact integers do.
pub(super) trait Kernel: Copy + Sync + 'static {
    /// A point. The order is lexicographic, x before y, as the tie rule wants.
    type Site: Copy + Ord + Send + Sync + Zeroable;
    /// A point, with a base edge as seen from the point.
    type Seen: Copy;
    /// The place of a point in the tree of cuts.
    type Place: Copy + Send + Sync;
    /// Numbers that a kernel computes once for a set of points, so that the predicates cost less.
    type Bounds: Copy;

    /// The bounds for all points in the bounding box of `sites`. A kernel that needs no bounds does not call `sites`.
    fn bounds<const N: usize>(sites: impl FnOnce() -> [Self::Site; N]) -> Self::Bounds;

    /// Swaps the axes of a point, so that points compare by y, then x.
    fn swapped(site: Self::Site) -> Self::Site;

    /// The turn from `a` over `b` to `c`: `Greater` if it is counter-clockwise, `Equal` if the three lie on a line.
    fn orient2d(a: Self::Site, b: Self::Site, c: Self::Site) -> Ordering;

    /// The turn from `a` over `b` to `c`: the answer of `orient2d`, at less cost thanks to the bounds.
    #[inline(always)]
    fn turn(ends: Ends<Self>, c: Self::Site) -> Ordering {
        Self::orient2d(ends.a, ends.b, c)
    }

    /// The view of the base edge from a point.
    fn see(ends: Ends<Self>, site: Self::Site) -> Self::Seen;

    /// Whether the point lies strictly to the left of the base edge.
    fn is_left(ends: Ends<Self>, seen: Self::Seen) -> bool;

    /// Whether the point of `c` lies to the left of the base edge, and the point of `q` inside the circle through both
    /// ends of the edge and the point of `c`. If `q` lies on the circle, the tie rule decides: the lexicographically
    /// smallest of the four points is lowered on the lifted paraboloid.
    ///
    /// The answer is `false` for a `q` that does not lie to the left: the merge asks only where no such point can be
    /// inside the circle, and a tie with such a point is refused.
    fn is_left_and_inside(ends: Ends<Self>, c: Self::Seen, q: Self::Seen) -> bool;

    /// The level of the cut that separates two places: odd if all x of the first are at most those of the second and
    /// equal only with smaller y, even if the same holds with the axes swapped. Of three places in a row, the outer two
    /// are separated at the higher of the two levels.
    fn level(one: Self::Place, other: Self::Place) -> u32;
}

/// Both ends of an edge from `a` to `b`, with the bounds of a set that holds them and all points seen from the edge.
#[derive(Clone, Copy)]
pub(super) struct Ends<K: Kernel> {
    pub(super) a: K::Site,
    pub(super) b: K::Site,
    pub(super) bounds: K::Bounds,
}

/// Decides a tie: `a`, `b`, `c`, `q` lie on one circle, or `q` is on the line of `a` and `b`. Given are all four points
/// and whether `q` lies to the left of the edge from `a` to `b`.
#[inline(never)]
pub(super) fn tie_is_inside<K: Kernel>(a: K::Site, b: K::Site, c: K::Site, q: K::Site, q_is_left: bool) -> bool {
    q_is_left && is_inside_at_tie([a, b, c], q, K::orient2d)
}
