//! The last stage of the predicates: doubles as whole multiples of one power of two, and integers that hold all that
//! is made of them.
//!
//! A double is `m * 2^e` with an integer `m` of 53 bits. The smallest `e` of the points at hand makes all coordinates
//! whole. Where these have at most 61 bits, which is so unless the exponents of neighbours differ much, differences
//! have 62 bits, cross and dot products fit 126 bits, and the determinant of incircle is compared as two products of
//! 256 bits. All others take [`Big`] integers: a coordinate then has up to 2098 bits, and a predicate may take
//! thousands of times as long.

use core::cmp::Ordering;

use super::big::Big;
use super::coordinate::Coordinate;
use crate::product::product;

/// Most bits of a coordinate for which the products are worked out in machine integers.
const NARROW_BITS: i32 = 61;
/// Coordinates of some points as whole multiples of one power of two.
enum Whole<const N: usize> {
    Narrow([[i64; 2]; N]),
    Wide([[Big; 2]; N]),
}

fn whole<C: Coordinate, const N: usize>(points: [[C; 2]; N]) -> Whole<N> {
    let parts = points.map(|point| point.map(C::parts));
    let all = parts.iter().flatten();
    let least = all.clone().map(|&(_, exponent)| exponent).min().unwrap_or(0);
    let bits = |&(odd, exponent): &(i64, i32)| match odd {
        0 => 0,
        odd => (u64::BITS - odd.unsigned_abs().leading_zeros()) as i32 + exponent - least,
    };
    let shift = |exponent: i32| if exponent == i32::MAX { 0 } else { (exponent - least) as u32 };
    if all.map(bits).max().unwrap_or(0) <= NARROW_BITS {
        Whole::Narrow(parts.map(|point| point.map(|(odd, exponent)| odd << shift(exponent))))
    } else {
        Whole::Wide(parts.map(|point| point.map(|(odd, exponent)| Big::shifted(odd, shift(exponent)))))
    }
}

/// `orient2d(a, b, c)` compared with zero, of coordinates that are finite.
#[cold]
pub(super) fn orient2d<C: Coordinate>(a: [C; 2], b: [C; 2], c: [C; 2]) -> Ordering {
    match whole([a, b, c]) {
        Whole::Narrow([a, b, c]) => View::of(a, b, c).cross.cmp(&0),
        Whole::Wide([a, b, c]) => WideView::of(&a, &b, &c).cross.sign(),
    }
}

/// `incircle(a, b, c, d)` compared with zero, of coordinates that are finite.
#[cold]
pub(super) fn incircle<C: Coordinate>(a: [C; 2], b: [C; 2], c: [C; 2], d: [C; 2]) -> Ordering {
    match whole([a, b, c, d]) {
        Whole::Narrow([a, b, c, d]) => {
            let (c, d) = (View::of(a, b, c), View::of(a, b, d));
            signed_product(c.dot, d.cross).cmp(&signed_product(d.dot, c.cross))
        }
        Whole::Wide([a, b, c, d]) => {
            let (c, d) = (WideView::of(&a, &b, &c), WideView::of(&a, &b, &d));
            c.dot.times(&d.cross).minus(&d.dot.times(&c.cross)).sign()
        }
    }
}

/// Compares the distances from `q` to `a` and to `b`, of coordinates that are finite.
#[cold]
pub(super) fn nearer<C: Coordinate>(q: [C; 2], a: [C; 2], b: [C; 2]) -> Ordering {
    match whole([q, a, b]) {
        Whole::Narrow([q, a, b]) => View::of(a, a, q).dot.cmp(&View::of(b, b, q).dot),
        Whole::Wide([q, a, b]) => WideView::of(&a, &a, &q).dot.minus(&WideView::of(&b, &b, &q).dot).sign(),
    }
}

/// Whether `p` lies at most `radius` from `q`. All numbers are finite, and the radius is not negative.
#[cold]
pub(super) fn is_within<C: Coordinate>(q: [C; 2], p: [C; 2], radius: f64) -> bool {
    let parts = [q[0], q[1], p[0], p[1]].map(C::parts);
    let radius = radius.parts();
    let least = parts.iter().fold(radius.1, |least, part| least.min(part.1));
    let big = |(odd, exponent): (i64, i32)| match odd {
        0 => Big::default(),
        odd => Big::shifted(odd, (exponent - least) as u32),
    };
    let [q0, q1, p0, p1] = parts.map(big);
    let radius = big(radius);
    let distance = WideView::of(&[p0.clone(), p1.clone()], &[p0, p1], &[q0, q1]).dot;
    radius.times(&radius).minus(&distance).sign().is_ge()
}

/// Cross and dot product of the vectors from a point to `a` and `b`; see `cpu/view.rs`.
struct View {
    cross: i128,
    dot: i128,
}

impl View {
    fn of(a: [i64; 2], b: [i64; 2], p: [i64; 2]) -> Self {
        // Coordinates have 61 bits, their differences 62, and products of two differences 124.
        let vector = |to: [i64; 2]| [i128::from(to[0] - p[0]), i128::from(to[1] - p[1])];
        let ([ax, ay], [bx, by]) = (vector(a), vector(b));
        Self { cross: ax * by - ay * bx, dot: ax * bx + ay * by }
    }
}

/// A [`View`] in integers of any size.
struct WideView {
    cross: Big,
    dot: Big,
}

impl WideView {
    fn of(a: &[Big; 2], b: &[Big; 2], p: &[Big; 2]) -> Self {
        let vector = |to: &[Big; 2]| [to[0].minus(&p[0]), to[1].minus(&p[1])];
        let ([ax, ay], [bx, by]) = (vector(a), vector(b));
        Self { cross: ax.times(&by).minus(&ay.times(&bx)), dot: ax.times(&bx).plus(&ay.times(&by)) }
    }
}

/// The product as a number of 256 bits in two's complement, the upper half first, so that the order is that of numbers.
fn signed_product(one: i128, other: i128) -> (i128, u128) {
    let (high, low) = product(one.unsigned_abs(), other.unsigned_abs());
    if (one < 0) == (other < 0) {
        return (high as i128, low);
    }
    ((!high).wrapping_add(u128::from(low == 0)) as i128, low.wrapping_neg())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn products_of_256_bits_are_ordered_like_those_of_any_size(
            values in prop::array::uniform4(any::<i64>()),
            shifts in prop::array::uniform4(0u32..62),
        ) {
            let [a, b, c, d] =
                [0, 1, 2, 3].map(|k| (values[k], shifts[k], i128::from(values[k]) << shifts[k]));
            let big = |(value, shift, _): (i64, u32, i128)| Big::shifted(value, shift);
            let expected = big(a).times(&big(b)).minus(&big(c).times(&big(d))).sign();
            prop_assert_eq!(signed_product(a.2, b.2).cmp(&signed_product(c.2, d.2)), expected);
            prop_assert_eq!(signed_product(a.2, b.2).cmp(&signed_product(b.2, a.2)), Ordering::Equal);
            prop_assert_eq!(signed_product(a.2, b.2).cmp(&(0, 0)), big(a).times(&big(b)).sign());
        }
    }
}
