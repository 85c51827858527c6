//! The exact predicates of the CPU triangulator: how an edge is seen from a point.
//!
//! From a point `p`, the edge from `a` to `b` has the vectors `a - p` and `b - p`. The cross product of both is
//! `orient2d(a, b, p)`. Cross product and dot product together give the angle at which the edge is seen, and that angle
//! says everything about circles: `q` lies inside the circle through `a`, `b` and `c` iff the edge is seen from `q` at
//! a larger angle than from `c`. In integers, with `(cross, dot)` of `c` and of `q`,
//!
//! ```text
//! incircle(a, b, c, q) = dot(c) cross(q) - dot(q) cross(c)
//! ```
//!
//! which is an identity of polynomials (Cline and Renka 1984). A point is viewed once, with four multiplications, and
//! compared with several others, with two each.
//!
//! **Widths.** Let coordinates have `w` bits and `S = 2^w - 1`. `|cross|` is at most `S²`, `|dot|` at most `2 S²`: both
//! fit 64 bits for `w` up to 31. The determinant is at most `S⁴ / 2` in magnitude, so it has `4 w` bits with its sign,
//! and **for `w` up to 16 64-bit arithmetic gives it exactly, however its two products overflow**, because their
//! difference is right modulo 2^64.
//!
//! Why `S⁴ / 2`: the determinant is `Σ λ_v |v|²` over the four points, where `λ_v` does not depend on `v` and
//! `Σ λ_v = 0`, `Σ λ_v v = 0`. Take a place of its maximum over the square with as many points in corners as possible.
//! As a function of `v` alone it is convex where `λ_v >= 0`, so such a point can be moved to a corner: all points
//! outside corners have `λ_v < 0`.
//! - One point is outside: three corners make a right triangle whose `orient2d` is `S²` and whose circle has the
//!   squared radius `S² / 2`, and the determinant, that `orient2d` times the power of the point, is at most `S⁴ / 2`.
//! - Two points `u`, `v` are outside: the segment between the two corners crosses theirs (the signs of `λ` say so), so
//!   the corners are opposite ones, and `u`, `v` lie on both sides of that diagonal, at distances `h` and `g` from it.
//!   With `S = 1` the determinant is at most `√2 (h + g) (1/2 - h g)`. For a given sum that is largest where one of
//!   both is 0, or one is `√½`, its largest value, and then at most `1/2`.
//! - Three points are outside: a corner would lie inside their triangle, which cannot be.

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
/// lexicographically smallest of the four points is lowered on the lifted paraboloid.
///
/// `c` must lie to the left of the edge from `a` to `b`. The answer is `false` for a `q` that does not lie to the left:
/// the merge asks only where no such point can be inside the circle, and a tie with such a point is refused.
#[inline(always)]
pub(super) fn incircle<W: Width>(a: Site, b: Site, c: Seen, q: Seen) -> bool {
    let determinant = W::determinant(c.view, q.view);
    let zero = W::Determinant::default();
    if determinant == zero {
        return tie_is_inside(a, b, c.site, q);
    }
    determinant > zero
}

/// Decides a tie: `a`, `b`, `c`, `q` lie on one circle, or `q` is on the line of `a` and `b`.
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
