//! Exact signs for the validator: grid points in 128-bit integers, all others in [`Digits`]
//! behind a floating-point filter.

use core::cmp::Ordering;

use super::digits::Digits;
use crate::point::Point;

/// A point whose predicates are exact.
pub(super) trait ExactPoint: Copy {
    /// The lexicographic order, x before y.
    fn compare(&self, other: &Self) -> Ordering;

    /// The turn from `a` over `b` to `c`: `Greater` if the three turn left.
    fn orient2d(a: Self, b: Self, c: Self) -> Ordering;

    /// Whether `d` is inside (`Greater`), on (`Equal`) or outside (`Less`) the circle of the counter-clockwise
    /// triangle: the sign of the 3x3 determinant of the corners seen from `d` and lifted onto a paraboloid.
    fn incircle(a: Self, b: Self, c: Self, d: Self) -> Ordering;

    /// Twice the signed area of a triangle, or of the sector from the origin to `b` and `c` if `a` is `None`, where
    /// integers of 128 bits can sum all areas of a mesh.
    fn orient2d_value(a: Option<Self>, b: Self, c: Self) -> Option<i128>;

    /// The vector from another point, rounded once.
    fn offset(&self, from: &Self) -> [f64; 2];
}

/// The vector from `from` to `to`.
fn vector(from: Point, to: Point) -> [i128; 2] {
    [i128::from(to.x) - i128::from(from.x), i128::from(to.y) - i128::from(from.y)]
}

fn minor(one: [i128; 2], other: [i128; 2]) -> i128 {
    one[0] * other[1] - one[1] * other[0]
}

impl ExactPoint for Point {
    fn compare(&self, other: &Self) -> Ordering {
        self.cmp(other)
    }

    fn orient2d(a: Self, b: Self, c: Self) -> Ordering {
        minor(vector(a, b), vector(a, c)).cmp(&0)
    }

    /// Differences are below 2^32 and lifts and minors below 2^65, so products may pass 2^127. The determinant does
    /// not: with coordinates up to `S` it is at most `S⁴ / 2`, less than 2^127 (`cpu/view.rs` has a proof), and the sum
    /// of wrapped products is right modulo 2^128.
    fn incircle(a: Self, b: Self, c: Self, d: Self) -> Ordering {
        let [a, b, c] = [a, b, c].map(|corner| vector(d, corner));
        let term = |v: [i128; 2], one, other| (v[0] * v[0] + v[1] * v[1]).wrapping_mul(minor(one, other));
        term(a, b, c).wrapping_add(term(b, c, a)).wrapping_add(term(c, a, b)).cmp(&0)
    }

    fn orient2d_value(a: Option<Self>, b: Self, c: Self) -> Option<i128> {
        let a = a.unwrap_or_default();
        Some(minor(vector(a, b), vector(a, c)))
    }

    fn offset(&self, from: &Self) -> [f64; 2] {
        [f64::from(self.x) - f64::from(from.x), f64::from(self.y) - f64::from(from.y)]
    }
}

/// A number that a coordinate may be.
pub(super) trait ExactNumber: Copy + PartialOrd {
    /// `self - other`, rounded once to a double.
    fn rounded_difference(self, other: Self) -> f64;

    /// The number as it is.
    fn digits(self) -> Digits;
}

impl ExactNumber for f64 {
    fn rounded_difference(self, other: Self) -> f64 {
        self - other
    }

    fn digits(self) -> Digits {
        let bits = self.to_bits();
        let (fraction, biased) = ((bits & ((1 << 52) - 1)) as i64, (bits >> 52 & 0x7ff) as i32);
        let magnitude = if biased == 0 { fraction } else { fraction + (1 << 52) };
        Digits::new(if self < 0.0 { -magnitude } else { magnitude }, biased.max(1) - 1075)
    }
}

impl ExactNumber for i64 {
    fn rounded_difference(self, other: Self) -> f64 {
        (i128::from(self) - i128::from(other)) as f64
    }

    fn digits(self) -> Digits {
        Digits::new(self, 0)
    }
}

/// Bounds of the errors of the filter, in multiples of a sum of magnitudes. Shewchuk's bounds for the same expressions
/// (1997) are `(3 + 16 u) u` and `(10 + 96 u) u` with `u = 2^-53`; the room between holds what underflow adds, if
/// no magnitude is tiny.
const ORIENT2D_BOUND: f64 = 4.0 * f64::EPSILON;
const INCIRCLE_BOUND: f64 = 12.0 * f64::EPSILON;
/// Lifts and sums of magnitudes from which on underflow adds next to nothing: 2^-1074 is below 1e-180 of them, and the
/// product of two is a normal number.
const TINY: f64 = 1e-140;

/// The sign of a rounded value, if it is beyond the bound.
fn filtered(value: f64, magnitude: f64, bound: f64) -> Option<Ordering> {
    let is_certain = magnitude > TINY && value.abs() > bound * magnitude;
    if is_certain {
        value.partial_cmp(&0.0)
    } else {
        None
    }
}

impl<C: ExactNumber> ExactPoint for [C; 2] {
    fn compare(&self, other: &Self) -> Ordering {
        // Coordinates that are not comparable have been refused.
        self.partial_cmp(other).unwrap_or(Ordering::Equal)
    }

    fn orient2d(a: Self, b: Self, c: Self) -> Ordering {
        let seen = |p: Self| [p[0].rounded_difference(a[0]), p[1].rounded_difference(a[1])];
        let (b1, c1) = (seen(b), seen(c));
        let (left, right) = (b1[0] * c1[1], b1[1] * c1[0]);
        filtered(left - right, left.abs() + right.abs(), ORIENT2D_BOUND).unwrap_or_else(|| {
            let seen = |p: Self| exact_vector(a, p);
            exact_minor(&seen(b), &seen(c)).sign()
        })
    }

    fn incircle(a: Self, b: Self, c: Self, d: Self) -> Ordering {
        let seen = |p: Self| [p[0].rounded_difference(d[0]), p[1].rounded_difference(d[1])];
        let rounded = [a, b, c].map(seen);
        let (mut value, mut magnitude, mut least) = (0.0, 0.0, f64::INFINITY);
        for k in 0..3 {
            let [corner, one, other] = [rounded[k], rounded[(k + 1) % 3], rounded[(k + 2) % 3]];
            let lift = corner[0] * corner[0] + corner[1] * corner[1];
            let (left, right) = (one[0] * other[1], one[1] * other[0]);
            value += lift * (left - right);
            let sum = left.abs() + right.abs();
            magnitude += lift * sum;
            least = least.min(lift).min(sum);
        }
        let certain = if least > TINY { filtered(value, magnitude, INCIRCLE_BOUND) } else { None };
        certain.unwrap_or_else(|| {
            let [a, b, c] = [a, b, c].map(|corner| exact_vector(d, corner));
            let term = |v: &[Digits; 2], one: &[Digits; 2], other: &[Digits; 2]| {
                v[0].times(&v[0]).plus(&v[1].times(&v[1])).times(&exact_minor(one, other))
            };
            term(&a, &b, &c).plus(&term(&b, &c, &a)).plus(&term(&c, &a, &b)).sign()
        })
    }

    fn orient2d_value(_: Option<Self>, _: Self, _: Self) -> Option<i128> {
        None
    }

    fn offset(&self, from: &Self) -> [f64; 2] {
        [self[0].rounded_difference(from[0]), self[1].rounded_difference(from[1])]
    }
}

fn exact_vector<C: ExactNumber>(from: [C; 2], to: [C; 2]) -> [Digits; 2] {
    [to[0].digits().minus(&from[0].digits()), to[1].digits().minus(&from[1].digits())]
}

fn exact_minor(one: &[Digits; 2], other: &[Digits; 2]) -> Digits {
    one[0].times(&other[1]).minus(&one[1].times(&other[0]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::{incircle_of_doubles, orient2d_of_doubles, SplitMix64};

    const MAX: u32 = u32::MAX;

    fn p(x: u32, y: u32) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn a_square_is_cocircular_at_full_width() {
        let (a, b, c, d) = (p(0, 0), p(MAX, 0), p(MAX, MAX), p(0, MAX));
        assert_eq!(Point::incircle(a, b, c, d), Ordering::Equal);
        assert_eq!(Point::incircle(a, b, c, p(0, MAX - 1)), Ordering::Greater);
        assert_eq!(Point::incircle(a, b, p(MAX, MAX - 1), d), Ordering::Less);
    }

    #[test]
    fn area_is_positive_to_the_left() {
        let area = |a, b, c| Point::orient2d_value(Some(a), b, c).expect("integers have one");
        assert_eq!(area(p(0, 0), p(MAX, 0), p(0, MAX)), i128::from(MAX) * i128::from(MAX));
        assert_eq!(area(p(0, 0), p(5, 5), p(9, 9)), 0);
        assert_eq!(area(p(0, 0), p(0, 2), p(2, 0)), -4);
        assert_eq!(Point::orient2d(p(0, 0), p(0, 2), p(2, 0)), Ordering::Less);
    }

    #[test]
    fn one_grid_step_decides() {
        let (a, b, c) = (p(10, 0), p(20, 10), p(10, 20));
        assert_eq!(Point::incircle(a, b, c, p(0, 10)), Ordering::Equal);
        assert_eq!(Point::incircle(a, b, c, p(1, 10)), Ordering::Greater);
        assert_eq!(Point::incircle(a, b, c, p(0, 9)), Ordering::Less);
    }

    #[test]
    fn doubles_of_all_sizes_have_the_signs_of_integers_of_any_size() {
        let mut random = SplitMix64::new(41);
        for round in 0..6000 {
            let value = |random: &mut SplitMix64| match round % 6 {
                0 => random.below(4) as f64 * 5e-324,
                1 => (random.below(5) as f64 - 2.0) * 8e307,
                2 => random.below(5) as f64 * 1e-75,
                3 => (random.below(1 << 53) as f64) * 2f64.powi(random.below(1900) as i32 - 1050),
                4 => 0.1 * random.below(4) as f64,
                _ => 1.0 + random.below(4) as f64 * f64::EPSILON,
            };
            let [a, b, c, d] = [(); 4].map(|()| [value(&mut random), value(&mut random)]);
            assert_eq!(<[f64; 2]>::orient2d(a, b, c), orient2d_of_doubles(a, b, c), "{a:?} {b:?} {c:?}");
            assert_eq!(<[f64; 2]>::incircle(a, b, c, d), incircle_of_doubles(a, b, c, d), "{a:?} {b:?} {c:?} {d:?}");
        }
    }
}
