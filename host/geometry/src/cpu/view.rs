//! The exact predicates of the CPU triangulator: how an edge is seen from a point.
//!
//! From a point `p`, the edge from `a` to `b` has the vectors `a - p` and `b - p`. Their cross product is `orient2d(a,
//! b, p)`. Cross product and dot product together give the angle at which the edge is seen from `p`. Let `c` and `q`
//! lie to the left of the edge. Then `q` lies inside the circle through `a`, `b` and `c` iff the edge is seen from `q`
//! at a larger angle than from `c`. In integers, with `(cross, dot)` of `c` and of `q`,
//!
//! ```text
//! incircle(a, b, c, q) = dot(c) cross(q) - dot(q) cross(c)
//! ```
//!
//! which is an identity of polynomials, so `c` and `q` may lie anywhere (Cline and Renka 1984). The view from a point
//! takes four multiplications, once, and each comparison of two views takes two more.
//!
//! **Widths.** Let coordinates have `w` bits and `S = 2^w - 1`. `|cross|` is at most `S²`, `|dot|` at most `2 S²`: both
//! fit 64 bits for `w` up to 31. The determinant is at most `S⁴ / 2` in magnitude, so `4 w` bits hold it with its
//! sign. **For `w` up to 16, 64-bit arithmetic gives the determinant exactly**: its two products may overflow, but
//! their difference is right modulo 2^64. For the same reason 128 bits are enough for `w` up to 32, whose cross and dot
//! products take 128 bits, too.
//!
//! Why `S⁴ / 2`: two points that change places change the sign, so a bound from above is enough. The determinant is `Σ
//! λ_v |v|²` over the four points `v`, where `λ_v` is `orient2d` of the other three up to its sign, and `Σ λ_v = 0`, `Σ
//! λ_v v = 0`. Of all places in the square where the determinant is largest, take one with as many points in corners of
//! the square as possible, and call the other points *free*. As a function of `v` alone the determinant is convex where
//! `λ_v >= 0`, and a free point of that kind could move to a corner at no loss. So every free point has `λ_v < 0`. A
//! corner of the square is never a weighted mean of points elsewhere in the square.
//! - No point is free: the corners lie on one circle, and the determinant is 0.
//! - One point is free: the three corners differ, else the determinant is 0. Their `orient2d` is `S²`, and their circle
//!   has the squared radius `S² / 2`. The determinant is that `orient2d` times `S² / 2` less the squared distance of
//!   the free point from the centre, so at most `S⁴ / 2`.
//! - Two points `u`, `v` are free: both corners have `λ > 0`, else one corner would be a mean of the other points. So
//!   the segment between the corners crosses that between `u` and `v`. The corners are opposite ones, and `u`, `v` lie
//!   on both sides of that diagonal, at distances `h` and `g` from it. With `S = 1` the determinant is at most `√2 (h +
//!   g) (1/2 - h g)`. For a given sum `h + g` this bound is largest where one of both distances is 0, or is `√½`, which
//!   no distance exceeds. Then the bound is at most `1/2`.
//! - Three points are free: the corner would be a mean of them. Four points are free: all `λ_v` would be
//!   negative. Neither is possible.

use core::cmp::Ordering;
use core::marker::PhantomData;

use bytemuck::Zeroable;

use super::kernel::{tie_is_inside, Ends, Kernel};
use crate::point::Point;

/// Determinants fit 64 bits if coordinates have up to this many bits.
pub(super) const NARROW_BITS: u32 = 16;
/// Cross and dot products fit 64 bits if coordinates have up to this many bits.
pub(super) const WIDE_BITS: u32 = 31;

/// A point of the grid: x above y in one word, which compilers keep in one register and compare at once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Zeroable)]
pub(crate) struct Site(u64);

impl Site {
    #[inline(always)]
    pub(super) fn at(x: u32, y: u32) -> Self {
        Self(u64::from(x) << 32 | u64::from(y))
    }

    #[inline(always)]
    pub(super) fn x(self) -> u32 {
        (self.0 >> 32) as u32
    }

    #[inline(always)]
    pub(super) fn y(self) -> u32 {
        self.0 as u32
    }
}

impl From<Point> for Site {
    #[inline(always)]
    fn from(point: Point) -> Self {
        Self::at(point.x, point.y)
    }
}

/// The edge from `a` to `b`, seen from a point.
#[derive(Clone, Copy, Debug, Default)]
pub struct View<P> {
    /// `orient2d` of the edge and the point: positive if the point lies to the left of the edge, zero if on its line.
    pub(crate) cross: P,
    dot: P,
}

/// The integers in which views and determinants are computed.
pub(crate) trait Width: Copy + Sync + 'static {
    /// The integer that holds a cross or a dot product.
    type Product: Copy + Ord + Default;
    /// The integer that holds the determinant.
    type Determinant: Copy + Ord + Default;

    /// Views the edge from `a` to `b` from `p`.
    fn view(a: Site, b: Site, p: Site) -> View<Self::Product>;

    /// Computes the determinant of the views from `c` and `q`, `dot(c) cross(q) - dot(q) cross(c)`.
    fn determinant(c: View<Self::Product>, q: View<Self::Product>) -> Self::Determinant;

    /// The determinant if the cross product is positive, else -1; without a branch.
    fn if_left(cross: Self::Product, determinant: Self::Determinant) -> Self::Determinant;
}

/// The view in 64 bits, of coordinates of up to [`WIDE_BITS`] bits.
#[inline(always)]
fn view_in_64_bits(a: Site, b: Site, p: Site) -> View<i64> {
    let minus = |one: u32, other: u32| i64::from(one) - i64::from(other);
    let (ax, ay, bx, by) = (minus(a.x(), p.x()), minus(a.y(), p.y()), minus(b.x(), p.x()), minus(b.y(), p.y()));
    View { cross: ax * by - ay * bx, dot: ax * bx + ay * by }
}

/// Arithmetic for coordinates of up to [`NARROW_BITS`] bits.
#[derive(Clone, Copy)]
pub(super) struct Narrow;

impl Width for Narrow {
    type Product = i64;
    type Determinant = i64;

    #[inline(always)]
    fn view(a: Site, b: Site, p: Site) -> View<i64> {
        view_in_64_bits(a, b, p)
    }

    #[inline(always)]
    fn determinant(c: View<i64>, q: View<i64>) -> i64 {
        c.dot.wrapping_mul(q.cross).wrapping_sub(q.dot.wrapping_mul(c.cross))
    }

    #[inline(always)]
    fn if_left(cross: i64, determinant: i64) -> i64 {
        determinant | (cross - 1) >> 63
    }
}

/// Arithmetic for coordinates of up to [`WIDE_BITS`] bits.
#[derive(Clone, Copy)]
pub(crate) struct Wide;

impl Width for Wide {
    type Product = i64;
    type Determinant = i128;

    #[inline(always)]
    fn view(a: Site, b: Site, p: Site) -> View<i64> {
        view_in_64_bits(a, b, p)
    }

    #[inline(always)]
    fn determinant(c: View<i64>, q: View<i64>) -> i128 {
        i128::from(c.dot) * i128::from(q.cross) - i128::from(q.dot) * i128::from(c.cross)
    }

    #[inline(always)]
    fn if_left(cross: i64, determinant: i128) -> i128 {
        determinant | i128::from((cross - 1) >> 63)
    }
}

/// Arithmetic for coordinates of up to 32 bits.
#[derive(Clone, Copy)]
pub(crate) struct Widest;

impl Width for Widest {
    type Product = i128;
    type Determinant = i128;

    #[inline(always)]
    fn view(a: Site, b: Site, p: Site) -> View<i128> {
        let minus = |one: u32, other: u32| i64::from(one) - i64::from(other);
        let (ax, ay, bx, by) = (minus(a.x(), p.x()), minus(a.y(), p.y()), minus(b.x(), p.x()), minus(b.y(), p.y()));
        let times = |one: i64, other: i64| i128::from(one) * i128::from(other);
        View { cross: times(ax, by) - times(ay, bx), dot: times(ax, bx) + times(ay, by) }
    }

    #[inline(always)]
    fn determinant(c: View<i128>, q: View<i128>) -> i128 {
        c.dot.wrapping_mul(q.cross).wrapping_sub(q.dot.wrapping_mul(c.cross))
    }

    #[inline(always)]
    fn if_left(cross: i128, determinant: i128) -> i128 {
        determinant | (cross - 1) >> 127
    }
}

/// The edge from `a` to `b`, seen from `p`, for all coordinates of 32 bits.
#[inline]
pub(crate) fn view_of_32_bits(a: Point, b: Point, p: Point) -> View<i128> {
    Widest::view(a.into(), b.into(), p.into())
}

/// The kernel of grid points.
#[derive(Clone, Copy)]
pub(super) struct Integers<W>(PhantomData<W>);

/// A point and the base edge seen from it.
#[derive(Clone, Copy)]
pub(super) struct Seen<P> {
    pub(super) site: Site,
    pub(super) view: View<P>,
}

impl<W: Width> Kernel for Integers<W> {
    type Site = Site;
    type Seen = Seen<W::Product>;
    type Place = Site;
    type Bounds = ();

    #[inline(always)]
    fn bounds<const N: usize>(_: impl FnOnce() -> [Site; N]) {}

    #[inline(always)]
    fn swapped(site: Site) -> Site {
        Site(site.0.rotate_left(32))
    }

    #[inline(always)]
    fn orient2d(a: Site, b: Site, c: Site) -> Ordering {
        W::view(a, b, c).cross.cmp(&W::Product::default())
    }

    #[inline(always)]
    fn see(ends: Ends<Self>, site: Site) -> Self::Seen {
        Seen { site, view: W::view(ends.a, ends.b, site) }
    }

    #[inline(always)]
    fn is_left(_: Ends<Self>, seen: Self::Seen) -> bool {
        seen.view.cross > W::Product::default()
    }

    /// Computes the cross product and the determinant without a branch in between.
    #[inline(always)]
    fn is_left_and_inside(ends: Ends<Self>, c: Self::Seen, q: Self::Seen) -> bool {
        let determinant = W::if_left(c.view.cross, W::determinant(c.view, q.view));
        let zero = W::Determinant::default();
        if determinant == zero {
            return tie_is_inside::<Self>(ends.a, ends.b, c.site, q.site, Self::is_left(ends, q));
        }
        determinant > zero
    }

    #[inline(always)]
    fn level(one: Site, other: Site) -> u32 {
        level(one.x() ^ other.x(), one.y() ^ other.y())
    }
}

/// The level in the quadtree of the cut between two cells whose coordinates differ in these bits: each bit of x, then
/// of y, from the lowest on; odd for x.
#[inline(always)]
pub(super) fn level(x: u32, y: u32) -> u32 {
    let bits = |difference: u32| u32::BITS - difference.leading_zeros();
    (2 * bits(x) + 1).max(2 * bits(y))
}
