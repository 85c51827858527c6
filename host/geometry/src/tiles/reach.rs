//! The question that tiles rest on: does the circumscribed disc of a triangle reach beyond a region?
//!
//! **The test.** Let `a` be a corner, `D` (twice the value `cross` below) four times the area of the counter-clockwise
//! triangle, and `U / D` the centre of its circle relative to `a`. A point beyond the east side has an x of at least
//! `east`. No such point is in the closed disc, and none is on its circle, if the centre is more than a radius away
//! from the line `x = east`:
//!
//! - With `K = (east - a.x) D`, the distance times `D` is `K - Ux`, and the radius times `D` is the length of `U`.
//! - `K - Ux > |U|` is the same as `K > 0` and `K (K - 2 Ux) > Uy²`: square both sides, and take `Ux²` away from both.
//!   The sign is safe, because the second form gives `K > 2 Ux` for `K > 0`, so `K - Ux` is positive.
//!
//! The other sides follow by turning the plane. Grid points beyond the west side have an x of at most `west - 1`, so
//! the line there is `x = west - 1`; doubles beyond that side may be arbitrarily near the line `x = west`.
//!
//! **Widths.** For coordinates and sides of `w` bits, differences and distances are at most `2^w` in magnitude. So `D`
//! is below `2^(2w + 1)`, and `K` below `2^(3w + 1)`. `|U|` is the product of the three sides of the triangle, each
//! below `sqrt(2) 2^w`, so it is below `2^(3w + 1.5)`, and `K - 2 Ux` below `2^(3w + 3)`. Grid points have `w = 32`,
//! and all these fit `i128`. Both products are compared in 256 bits (`product`). Up to `w = 20` all factors fit 64
//! bits, and one multiplication gives each product.
//!
//! **The filter** answers nearly all questions in doubles. Let `u = 2^-53`. Differences are exact for grid points, and
//! have one rounding, of `u`, for doubles. The letters stand for computed values:
//!
//! - `cross = p - q` for two products with three roundings each, and one more: the error is at most
//!   `(4 u + O(u²)) (|p| + |q|)`, and the filter takes `6 u`.
//! - `Q = |U|²` is the product of the squared sides. A squared side has a relative error of at most `4 u + O(u²)`, so
//!   `Q` has at most `14 u + O(u²)`.
//! - *First test.* The disc has a diameter of `sqrt(Q) / cross` and contains `a`. So it is inside if `room`, the least
//!   distance of `a` to a line, is longer than that. With `least` for the least value that `cross` may have,
//!   `(room least)²` has a relative error of at most `7 u + O(u²)`. With that of `Q` the sum is below `32 u`. Nearly
//!   all triangles end here, after about 30 operations.
//! - *Second test*, for each side. `U` is made of two products of `7 u + O(u²)` relative error, rounding of the
//!   difference included. `K = 2 d cross` errs by at most `(6 u + O(u²)) 2 d (|p| + |q|)`. The distance `K - U` adds
//!   one rounding. The filter takes `16 u` of the sum of all magnitudes as the error, then compares the square of the
//!   distance with `Q` as above.
//!
//! **Underflow and overflow.** For doubles, the filter answers only if all squared sides are within 2^-300 and 2^300.
//! Then `Q` is at least 2^-900, and `sqrt(Q)` at least 2^-450. Underflow adds at most 2^-1070 to any value, which is
//! nothing beside the room of more than `8 u` that the bounds above leave in `Q`. Coordinates that differ by less than
//! 2^150 are below 2^204, so no distance overflows. Infinities and what is not a number make comparisons false.

use super::product::exceeds_square;
use super::region::Region;
use crate::plane_point::PlanePoint;
use crate::point::Point;

/// The unit of rounding: half of the distance from 1 to the next double.
const UNIT: f64 = f64::EPSILON / 2.0;
/// The factors that make a square smaller or larger by more than its error and that of `Q` together.
const LESS: f64 = 1.0 - 32.0 * UNIT;
const MORE: f64 = 1.0 + 32.0 * UNIT;
/// The squared sides of a triangle of doubles for which the filter answers: 2^-300 to 2^300.
const SQUARES: core::ops::RangeInclusive<f64> = f64::from_bits((1023 - 300) << 52)..=f64::from_bits((1023 + 300) << 52);

/// The position of the closed circumscribed disc of a triangle beside a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reach {
    /// The disc lies strictly within the region: no point beyond the region can be in the disc or on its circle.
    Within,
    /// The disc touches or crosses a side, so a point beyond the region may be in the disc or on its circle. The answer
    /// for three points on one line also, unless the region is the whole plane.
    Beyond,
    /// Rounding hides the answer. A triangle of [`Point`]s never gets this answer.
    Unknown,
}

/// A type of points whose sets can be cut into tiles: [`Point`] and `[f64; 2]`.
pub trait TilePoint: PlanePoint {
    /// The numbers of the sides of a region.
    type Side: Copy + PartialOrd + core::fmt::Debug;

    /// The coordinates of the point, x and y.
    fn place(self) -> [Self::Side; 2];

    /// The sides of a region, prepared for many triangles.
    fn sides(region: &Region<Self::Side>) -> Sides;

    /// Tells where the disc of a triangle lies; see [`reach`].
    fn reach(sides: &Sides, corners: [Self; 3]) -> Reach;
}

/// Tells where the closed circumscribed disc of a triangle lies: strictly within a region, or not.
///
/// The corners may turn either way. For [`Point`]s the answer is exact, and a side that no point of 32 bits is beyond
/// counts as infinitely far away. For doubles, [`Reach::Within`] is always true, and other answers prove nothing.
///
/// Costs about 5 ns for most triangles, and 20 to 40 ns for a disc that touches a side. [`TilePoint::sides`] prepares a
/// region once for many triangles. The head of this file derives the test and the bounds of its filter.
///
/// ```
/// use incircle_geometry::tiles::{reach, Reach, Region};
/// use incircle_geometry::Point;
///
/// let corners = [(0, 0), (4, 0), (0, 4)].map(Point::from);
/// // The rightmost place of the disc has the x 2 + sqrt(8) = 4.83.
/// assert_eq!(reach(&Region { east: Some(5), ..Region::WHOLE }, corners), Reach::Within);
/// assert_eq!(reach(&Region { east: Some(4), ..Region::WHOLE }, corners), Reach::Beyond);
/// ```
#[inline]
pub fn reach<P: TilePoint>(region: &Region<P::Side>, corners: [P; 3]) -> Reach {
    P::reach(&P::sides(region), corners)
}

/// The four lines that a disc must not touch, as doubles. A line that is infinitely far away is no side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sides {
    low: [f64; 2],
    high: [f64; 2],
}

impl TilePoint for Point {
    type Side = i64;

    #[inline(always)]
    fn place(self) -> [i64; 2] {
        [self.x.into(), self.y.into()]
    }

    fn sides(&Region { west, east, south, north }: &Region) -> Sides {
        // One step beyond the grid on either side is as far as one needs to look; so all lines are exact doubles.
        const END: i64 = 1 << u32::BITS;
        let low = |side: Option<i64>| match side {
            Some(side) if side > 0 => side.min(END + 1) as f64 - 1.0,
            _ => f64::NEG_INFINITY,
        };
        let high = |side: Option<i64>| match side {
            Some(side) if side < END => side.max(-1) as f64,
            _ => f64::INFINITY,
        };
        Sides { low: [low(west), low(south)], high: [high(east), high(north)] }
    }

    #[inline(always)]
    fn reach(sides: &Sides, corners: [Self; 3]) -> Reach {
        match sides.filter::<false>(corners.map(|corner| [corner.x.into(), corner.y.into()])) {
            Reach::Unknown => sides.exact(corners),
            known => known,
        }
    }
}

impl TilePoint for [f64; 2] {
    type Side = f64;

    #[inline(always)]
    fn place(self) -> [f64; 2] {
        self
    }

    fn sides(&Region { west, east, south, north }: &Region<f64>) -> Sides {
        // A side that is not a number is beyond every place, so that no triangle is within it.
        let line = |side: Option<f64>, none: f64| match side {
            Some(side) if side.is_nan() => -none,
            side => side.unwrap_or(none),
        };
        let low = |side| line(side, f64::NEG_INFINITY);
        let high = |side| line(side, f64::INFINITY);
        Sides { low: [low(west), low(south)], high: [high(east), high(north)] }
    }

    #[inline(always)]
    fn reach(sides: &Sides, corners: [Self; 3]) -> Reach {
        sides.filter::<true>(corners)
    }
}

/// The values of a triangle that both tests of the filter need, relative to the corner `a`.
#[derive(Clone, Copy)]
struct Rounded {
    a: [f64; 2],
    b: [f64; 2],
    c: [f64; 2],
    cross: f64,
    /// The sum of the magnitudes of the two products of `cross`.
    magnitude: f64,
    /// The squared lengths of `b` and `c`.
    squares: [f64; 2],
    /// The product of the squared sides.
    product: f64,
}

impl Sides {
    /// The answer in doubles, as far as rounding allows one. `CHECKED` is for corners that are not grid points.
    #[inline(always)]
    fn filter<const CHECKED: bool>(&self, [a, b, c]: [[f64; 2]; 3]) -> Reach {
        let minus = |one: [f64; 2], other: [f64; 2]| [one[0] - other[0], one[1] - other[1]];
        let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
        let third = square(minus(c, b));
        let (b, c) = (minus(b, a), minus(c, a));
        let (p, q) = (b[0] * c[1], b[1] * c[0]);
        let squares = [square(b), square(c)];
        let (cross, magnitude) = (p - q, p.abs() + q.abs());
        let product = squares[0] * squares[1] * third;
        let least = cross.abs() - 6.0 * UNIT * magnitude;
        let room = self.room(a);
        let is_in_range = !CHECKED || [squares[0], squares[1], third].iter().all(|square| SQUARES.contains(square));
        let is_near = (room * least) * (room * least) * LESS > product;
        if is_in_range & is_near & (room > 0.0) & (least > 0.0) {
            return Reach::Within;
        }
        self.near_a_side(Rounded { a, b, c, cross, magnitude, squares, product }, is_in_range & (least > 0.0))
    }

    /// The least distance of a place to a side; infinite if there is none.
    #[inline(always)]
    fn room(&self, place: [f64; 2]) -> f64 {
        let mut room = f64::INFINITY;
        for (value, (low, high)) in place.into_iter().zip(self.low.into_iter().zip(self.high)) {
            for distance in [value - low, high - value] {
                room = if distance < room { distance } else { room };
            }
        }
        room
    }

    /// The second test of the filter, for triangles that the first one has not found inside.
    #[inline(never)]
    fn near_a_side(&self, triangle: Rounded, is_sure: bool) -> Reach {
        if self.is_nowhere() {
            return Reach::Within;
        }
        if !is_sure {
            return Reach::Unknown;
        }
        let mut answer = Reach::Within;
        for axis in 0..2 {
            for (line, outward) in [(self.low[axis], -1.0), (self.high[axis], 1.0)] {
                match triangle.reach_line(line, axis, outward) {
                    Reach::Within => {}
                    Reach::Beyond => return Reach::Beyond,
                    Reach::Unknown => answer = Reach::Unknown,
                }
            }
        }
        answer
    }

    /// Whether no side is there, because the region is the whole plane.
    fn is_nowhere(&self) -> bool {
        self.low == [f64::NEG_INFINITY; 2] && self.high == [f64::INFINITY; 2]
    }

    /// The exact answer for grid points.
    #[cold]
    #[inline(never)]
    fn exact(&self, [a, b, c]: [Point; 3]) -> Reach {
        let from_a = |p: Point| [i128::from(p.x) - i128::from(a.x), i128::from(p.y) - i128::from(a.y)];
        let (b, c) = (from_a(b), from_a(c));
        let cross = b[0] * c[1] - b[1] * c[0];
        // A clockwise triangle has the same circle as the counter-clockwise one.
        let (b, c) = if cross < 0 { (c, b) } else { (b, c) };
        if cross == 0 {
            return Reach::Beyond;
        }
        let square = |v: [i128; 2]| v[0] * v[0] + v[1] * v[1];
        let center = [c[1] * square(b) - b[1] * square(c), b[0] * square(c) - c[0] * square(b)];
        let a = a.place().map(i128::from);
        for axis in 0..2 {
            for (line, outward) in [(self.low[axis], -1), (self.high[axis], 1)] {
                if line.is_infinite() {
                    continue;
                }
                let k = outward * (line as i128 - a[axis]) * 2 * cross.abs();
                let is_within = k > 0 && exceeds_square(k, k - 2 * outward * center[axis], center[1 - axis]);
                if !is_within {
                    return Reach::Beyond;
                }
            }
        }
        Reach::Within
    }
}

impl Rounded {
    /// The position of the disc beside one line, as far as rounding allows an answer. `outward` is 1 if the region lies
    /// on the lower side of the line, else -1.
    fn reach_line(&self, line: f64, axis: usize, outward: f64) -> Reach {
        if line == f64::INFINITY * outward {
            return Reach::Within;
        }
        // The centre relative to `a`, turned towards the line; a clockwise triangle has all signs changed.
        let turn = if self.cross < 0.0 { -outward } else { outward };
        let (p, q) = (self.c[1 - axis] * self.squares[0], self.b[1 - axis] * self.squares[1]);
        let toward = if axis == 0 { p - q } else { q - p };
        let distance = outward * (line - self.a[axis]);
        let gap = 2.0 * distance * self.cross.abs() - turn * toward;
        let error = 16.0 * UNIT * (2.0 * distance.abs() * self.magnitude + p.abs() + q.abs());
        let (least, most) = (gap - error, gap + error);
        if least > 0.0 && least * least * LESS > self.product {
            Reach::Within
        } else if most < 0.0 || most * most * MORE < self.product {
            Reach::Beyond
        } else {
            Reach::Unknown
        }
    }
}

#[cfg(test)]
mod tests;
