//! Places with fractions as coordinates, such as circumcentres, and the doubles nearest to them.

use core::cmp::Ordering;

use crate::point::Point;

/// A corner of a cell: the exact place `(x / d, y / d)`, in grid units.
///
/// A corner is a Voronoi vertex, a crossing of an edge with the border of a clip, or a corner of the clip. For
/// coordinates of `w` bits, `d` has up to `2 w + 2` bits, and `x` and `y` have up to `3 w + 4` with their signs.
///
/// The fraction is not in lowest terms, so two corners at one place may differ in their numbers: `==` compares
/// numbers. Compare the fractions of [`reduced`](Self::reduced), to compare places.
///
/// ```
/// use incircle_geometry::voronoi::Corner;
/// let third = Corner { x: -5, y: 10, d: 15 };
/// assert_eq!(third.reduced(), Corner { x: -1, y: 2, d: 3 });
/// assert_eq!(third.nearest(), [-1.0 / 3.0, 2.0 / 3.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Corner {
    /// The numerator of the horizontal coordinate.
    pub x: i128,
    /// The numerator of the vertical coordinate.
    pub y: i128,
    /// The denominator of both, which is positive.
    pub d: u64,
}

/// The vector from one point to another. Coordinates below 2^31 have differences of 32 bits with the sign.
#[inline]
pub(super) fn vector(from: Point, to: Point) -> [i64; 2] {
    [i64::from(to.x) - i64::from(from.x), i64::from(to.y) - i64::from(from.y)]
}

/// The dot product of two vectors between points, at most 2^63 - 2^33 + 2 in magnitude.
#[inline]
pub(super) fn dot(one: [i64; 2], other: [i64; 2]) -> i64 {
    one[0] * other[0] + one[1] * other[1]
}

/// The cross product of two vectors between points, with the bound of [`dot`].
#[inline]
pub(super) fn cross(one: [i64; 2], other: [i64; 2]) -> i64 {
    one[0] * other[1] - one[1] * other[0]
}

/// The circumcentre of a counter-clockwise triangle as seen from its first corner, which lies at `a`: the numerators,
/// then the positive denominator. The numerators are below 2^96 in magnitude.
#[inline]
pub(crate) fn center_seen([a, b, c]: [Point; 3]) -> ([i128; 2], u64) {
    let (b, c) = (vector(a, b), vector(a, c));
    let (bb, cc) = (i128::from(dot(b, b)), i128::from(dot(c, c)));
    let x = i128::from(c[1]) * bb - i128::from(b[1]) * cc;
    let y = i128::from(b[0]) * cc - i128::from(c[0]) * bb;
    // All three corners lie in a square of the grid, so the cross product is at most (2^31 - 1)^2.
    ([x, y], 2 * cross(b, c).unsigned_abs())
}

impl Corner {
    /// A grid point as a corner.
    #[inline]
    pub fn of_point(point: Point) -> Self {
        Self { x: point.x.into(), y: point.y.into(), d: 1 }
    }

    /// The circumcentre of a counter-clockwise triangle with coordinates below 2^31.
    #[inline]
    pub(super) fn of_center(abc: [Point; 3]) -> Self {
        let ([x, y], d) = center_seen(abc);
        let from = |origin: u32, seen: i128| i128::from(origin) * i128::from(d) + seen;
        Self { x: from(abc[0].x, x), y: from(abc[0].y, y), d }
    }

    /// The same place as a fraction in lowest terms. About 1 µs.
    pub fn reduced(self) -> Self {
        let factor = common_factor(common_factor(self.x.unsigned_abs(), self.d.into()), self.y.unsigned_abs());
        // The factor divides `d`, so it fits both types.
        let factor = factor.max(1);
        Self { x: self.x / factor as i128, y: self.y / factor as i128, d: self.d / factor as u64 }
    }

    /// The doubles nearest to the two coordinates; halves go to the even double. A zero is positive.
    #[inline]
    pub fn nearest(self) -> [f64; 2] {
        [nearest_of_64_bits(self.x, self.d), nearest_of_64_bits(self.y, self.d)]
    }

    /// Compares the horizontal coordinate with a whole number, exactly.
    #[inline]
    pub fn compare_x(self, with: u32) -> Ordering {
        self.x.cmp(&(i128::from(with) * i128::from(self.d)))
    }

    /// Compares the vertical coordinate with a whole number, exactly.
    #[inline]
    pub fn compare_y(self, with: u32) -> Ordering {
        self.y.cmp(&(i128::from(with) * i128::from(self.d)))
    }
}

/// The greatest number that divides both; the other number if one is zero.
fn common_factor(mut one: u128, mut other: u128) -> u128 {
    while other != 0 {
        (one, other) = (other, one % other);
    }
    one
}

/// The double nearest to `n / d`, for a `d` that is not zero; halves go to the even double.
#[inline]
fn nearest_of_64_bits(n: i128, d: u64) -> f64 {
    const EXACT: u64 = 1 << 53;
    if n.unsigned_abs() <= u128::from(EXACT) && d <= EXACT {
        // Both operands are exact, so the quotient is rounded once.
        return n as f64 / d as f64;
    }
    rounded_to_odd(n, d.into())
}

/// The double nearest to `n / d`; halves go to the even double. `None` if `d` is zero, or 2^72 or more.
///
/// ```
/// use incircle_geometry::voronoi::nearest_quotient;
/// assert_eq!(nearest_quotient(-2, 3), Some(-2.0 / 3.0));
/// assert_eq!(nearest_quotient((1 << 53) * 3 + 1, 3), Some((1u64 << 53) as f64));
/// assert_eq!(nearest_quotient(1, 0), None);
/// ```
pub fn nearest_quotient(n: i128, d: u128) -> Option<f64> {
    (d != 0 && d >> WIDEST == 0).then(|| rounded_to_odd(n, d))
}

/// The most bits of a denominator in [`nearest_quotient`], so that a shifted numerator has at most 127.
const WIDEST: u32 = 72;

/// The double nearest to `n / d`, for a `d` of 1 to 72 bits. The quotient is worked out to 55 bits or more, and its
/// lowest bit is set if there is a remainder: rounding that integer to 53 bits is then the same as rounding the
/// quotient.
fn rounded_to_odd(n: i128, d: u128) -> f64 {
    let bits = |value: u128| u128::BITS - value.leading_zeros();
    let (size, d) = (n.unsigned_abs(), d.max(1));
    if size == 0 {
        return 0.0;
    }
    // The shifted numerator has at most 55 + 72 bits, or the bits of the numerator.
    let shift = (55 + bits(d)).saturating_sub(bits(size));
    let (quotient, remainder) = ((size << shift) / d, (size << shift) % d);
    let odd = quotient | u128::from(remainder != 0);
    // A power of two, at least 2^-127.
    let value = odd as f64 * f64::from_bits(u64::from(1023 - shift) << 52);
    if n < 0 {
        -value
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_bigint::BigInt;
    use proptest::prelude::*;

    /// Whether `value` is the double nearest to `n / d`, by distances to the middles between doubles.
    fn is_nearest(value: f64, n: i128, d: u128) -> bool {
        // In units of 2^-200 every double here is whole.
        let exact = |double: f64| {
            let bits = double.to_bits();
            let (mantissa, exponent) = (bits & ((1 << 52) - 1) | 1 << 52, (bits >> 52 & 0x7ff) as i32 - 1075 + 200);
            let whole = if exponent < 0 { BigInt::ZERO } else { BigInt::from(mantissa) << exponent };
            if double < 0.0 {
                -whole
            } else {
                whole
            }
        };
        let twice = BigInt::from(n) << 201;
        let middle = |other: f64| (exact(value) + exact(other)) * BigInt::from(d);
        let (below, above) = (middle(value.next_down()), middle(value.next_up()));
        let is_even = value.to_bits().is_multiple_of(2);
        (below < twice && twice < above) || (is_even && (below == twice || above == twice))
    }

    proptest! {
        #[test]
        fn quotients_are_rounded_once(n in any::<i128>(), d in 1u64.., cut in 28u32..120, cut_d in 0u32..63) {
            let (n, d) = (n >> cut, (d >> cut_d).max(1));
            prop_assume!(n != 0);
            prop_assert!(is_nearest(nearest_of_64_bits(n, d), n, d.into()), "{} / {}", n, d);
            let wide = u128::from(d) << (cut_d % 9);
            prop_assert!(is_nearest(nearest_quotient(n, wide).expect("72 bits"), n, wide), "{} / {}", n, wide);
            // Halves between doubles, and their neighbours.
            let odd = (1 << 54) + (n & 0xffff_ffff) * 2 + 1;
            for n in [odd * i128::from(d), odd * i128::from(d) + 1, odd * i128::from(d) - 1] {
                prop_assert!(is_nearest(nearest_of_64_bits(n, d), n, d.into()), "{} / {}", n, d);
            }
        }
    }

    #[test]
    fn the_largest_triangle_fits() {
        const MAX: u32 = (1 << 31) - 1;
        let center = Corner::of_center([(0, 0), (MAX, 0), (MAX, MAX)].map(Point::from));
        assert_eq!(center.reduced(), Corner { x: MAX.into(), y: MAX.into(), d: 2 });
        let far = Corner::of_center([Point::new(0, 0), Point::new(MAX, MAX - 1), Point::new(MAX - 1, MAX - 2)]);
        assert_eq!(far.d, 2);
        assert!(far.nearest().iter().all(|value| value.abs() > 2e18));
    }
}
