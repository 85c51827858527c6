//! The exact predicates of the CPU triangulator: how an edge is seen from a point.
//!
//! From a point `p`, the edge from `a` to `b` has the vectors `a - p` and `b - p`. Their cross product is
//! `orient2d(a, b, p)`. Cross product and dot product together give the angle at which the edge is seen from `p`. Let
//! `c` and `q` lie to the left of the edge. Then `q` lies inside the circle through `a`, `b` and `c` iff the edge is
//! seen from `q` at a larger angle than from `c`. In integers, with `(cross, dot)` of `c` and of `q`,
//!
//! ```text
//! incircle(a, b, c, q) = dot(c) cross(q) - dot(q) cross(c)
//! ```
//!
//! which is an identity of polynomials, so `c` and `q` may lie anywhere (Cline and Renka 1984). The view from a point
//! takes four multiplications, once, and each comparison of two views takes two more.
//!
//! **Widths.** Let coordinates have `w` bits and `S = 2^w - 1`. `|cross|` is at most `S²`, `|dot|` at most `2 S²`: both
//! fit 64 bits for `w` up to 31. The determinant is at most `S⁴ / 2` in magnitude, so `4 w` bits hold it with its sign.
//! **For `w` up to 16, 64-bit arithmetic gives the determinant exactly**: its two products may overflow, but their
//! difference is right modulo 2^64.
//!
//! Why `S⁴ / 2`: two points that change places change the sign, so a bound from above is enough. The determinant is
//! `Σ λ_v |v|²` over the four points `v`, where `λ_v` is `orient2d` of the other three up to its sign, and `Σ λ_v = 0`,
//! `Σ λ_v v = 0`. Of all places in the square where the determinant is largest, take one with as many points in corners
//! of the square as possible, and call the other points *free*. As a function of `v` alone the determinant is convex
//! where `λ_v >= 0`, and a free point of that kind could move to a corner at no loss. So every free point has
//! `λ_v < 0`. A corner of the square is never a weighted mean of points elsewhere in the square.
//! - No point is free: the corners lie on one circle, and the determinant is 0.
//! - One point is free: the three corners differ, else the determinant is 0. Their `orient2d` is `S²`, and their circle
//!   has the squared radius `S² / 2`. The determinant is that `orient2d` times `S² / 2` less the squared distance of
//!   the free point from the centre, so at most `S⁴ / 2`.
//! - Two points `u`, `v` are free: both corners have `λ > 0`, else one corner would be a mean of the other points. So
//!   the segment between the corners crosses that between `u` and `v`. The corners are opposite ones, and `u`, `v` lie
//!   on both sides of that diagonal, at distances `h` and `g` from it. With `S = 1` the determinant is at most
//!   `√2 (h + g) (1/2 - h g)`. For a given sum `h + g` this bound is largest where one of both distances is 0, or is
//!   `√½`, which no distance exceeds. Then the bound is at most `1/2`.
//! - Three points are free: the corner would be a mean of them. Four points are free: all `λ_v` would be negative.
//!   Neither is possible.

use bytemuck::Zeroable;

use crate::point::Point;

/// Determinants fit 64 bits if coordinates have up to this many bits.
pub(super) const NARROW_BITS: u32 = 16;

/// A point of the grid with signed coordinates from 0 to 2^31 - 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Zeroable)]
pub(super) struct Site {
    pub(super) x: i32,
    pub(super) y: i32,
}

impl Site {
    /// The site with its axes swapped, which compares by y, then x.
    #[inline(always)]
    pub(super) fn swapped(self) -> Self {
        Self { x: self.y, y: self.x }
    }
}

impl From<Point> for Site {
    /// Converts a point with coordinates below 2^31.
    fn from(point: Point) -> Self {
        Self { x: point.x as i32, y: point.y as i32 }
    }
}

/// The edge from `a` to `b`, seen from a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// `orient2d` of the edge and the point: positive if the point lies to the left of the edge, zero if on its line.
    pub(super) cross: i64,
    dot: i64,
}

impl View {
    /// The edge from `a` to `b`, seen from `p`.
    #[inline(always)]
    pub(super) fn of(a: Site, b: Site, p: Site) -> Self {
        let minus = |one: i32, other: i32| i64::from(one) - i64::from(other);
        let (ax, ay, bx, by) = (minus(a.x, p.x), minus(a.y, p.y), minus(b.x, p.x), minus(b.y, p.y));
        Self { cross: ax * by - ay * bx, dot: ax * bx + ay * by }
    }
}

/// Twice the signed area of a triangle: positive if the triangle is counter-clockwise.
#[inline(always)]
pub(super) fn orient2d(a: Site, b: Site, p: Site) -> i64 {
    View::of(a, b, p).cross
}

/// The integers in which determinants are computed.
pub(super) trait Width: Copy + Sync {
    /// The integer that holds the determinant.
    type Determinant: Ord + Default;

    /// Computes the determinant of the views from `c` and `q`, `dot(c) cross(q) - dot(q) cross(c)`.
    fn determinant(c: View, q: View) -> Self::Determinant;
}

/// Arithmetic for coordinates of up to [`NARROW_BITS`] bits.
#[derive(Clone, Copy)]
pub(super) struct Narrow;

impl Width for Narrow {
    type Determinant = i64;

    #[inline(always)]
    fn determinant(c: View, q: View) -> i64 {
        c.dot.wrapping_mul(q.cross).wrapping_sub(q.dot.wrapping_mul(c.cross))
    }
}

/// Arithmetic for coordinates of up to 31 bits.
#[derive(Clone, Copy)]
pub(super) struct Wide;

impl Width for Wide {
    type Determinant = i128;

    #[inline(always)]
    fn determinant(c: View, q: View) -> i128 {
        i128::from(c.dot) * i128::from(q.cross) - i128::from(q.dot) * i128::from(c.cross)
    }
}

/// A point and the base edge seen from it.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    pub(super) site: Site,
    pub(super) view: View,
}

impl Seen {
    #[inline(always)]
    pub(super) fn new(a: Site, b: Site, site: Site) -> Self {
        Self { site, view: View::of(a, b, site) }
    }
}

/// Whether `q` lies inside the circle through `a`, `b` and `c`. If `q` lies on the circle, the tie rule decides: the
/// lexicographically smallest of the four points is lowered below the paraboloid of the lifting.
///
/// The point `c` must lie to the left of the edge from `a` to `b`. If `q` does not, the caller knows that `q` lies
/// outside the circle or on it, and the answer is `false`.
#[inline(always)]
pub(super) fn incircle<W: Width>(a: Site, b: Site, c: Seen, q: Seen) -> bool {
    let determinant = W::determinant(c.view, q.view);
    let zero = W::Determinant::default();
    if determinant == zero {
        return tie_is_inside(a, b, c.site, q);
    }
    determinant > zero
}

/// Decides a determinant of zero: `q` lies on the circle through `a`, `b`, `c`, and may be `a` or `b` itself.
#[inline(never)]
fn tie_is_inside(a: Site, b: Site, c: Site, q: Seen) -> bool {
    if q.view.cross <= 0 {
        return false;
    }
    let smallest = a.min(b).min(c).min(q.site);
    // Lowering a corner moves `q` inside iff the other three turn right around that corner. Lowering `q` always moves
    // it inside, and lowering `c` never does, because `c` and `q` lie on one side of the edge.
    if smallest == a {
        orient2d(q.site, b, c) < 0
    } else if smallest == b {
        orient2d(q.site, c, a) < 0
    } else {
        smallest == q.site
    }
}
