//! Rounded cotangents of the angles of a triangle, which tell by one sum whether an edge is Delaunay.
//!
//! An edge between two counter-clockwise triangles is Delaunay if the angles opposite it add up to less than π, that
//! is, if the sum of their cotangents is positive. A mesh that keeps the cotangents of its triangles decides nearly all
//! of its edges by a look at two small numbers.
//!
//! **The bound.** Let `u = 2^-53`, let `l` be the sum of the squares of the three edges, and `c` twice the area. Each
//! cotangent is half the sum of two squares less the third, divided by `c`. Only triangles with `l <= 128 c` have
//! cotangents here, so these are at most 64. The products of `c` have the size `l / 2` or less, so `c` errs by at most
//! `4 u (l / 2) <= 256 u c`, and the numerator by `8 u l / 2 <= 512 u c`, up to terms of `u²`. A cotangent then errs by
//! less than `2^17 u = 2^-36` before it is rounded to a multiple of 1/128. The rounding adds half such a multiple. So
//! the sum of two, in multiples of 1/128, errs by hardly more than 1, and from 2 on its sign is right.
//!
//! **Overflow** makes `l` infinite, and **underflow** is less than `2^-115` of an `l` of `2^-960` or more, as in the
//! head of `double`. Outside that range a triangle has no cotangents.

use super::LEAST_SIZE;

/// A sum of two cotangents of this size or larger has the right sign.
pub(crate) const LEAST_SUM: i32 = 2;
/// The largest size of a cotangent.
pub(crate) const MOST: i32 = 64 * 128;
/// The largest sum of squares of edges, in multiples of twice the area, of triangles that have cotangents.
const MOST_SLENDER: f64 = 128.0;
/// A double of this size has no bits for fractions, and its last bits are those of an integer: what is added to it is
/// rounded to the nearest integer.
const ROUNDING: f64 = 1.5 * (1u64 << 52) as f64;

/// The cotangents of the angles of a triangle in multiples of 1/128, or `None` if it is slender, or may not be
/// counter-clockwise. The vectors are the edges opposite the three corners, which go once around the triangle. Their
/// coordinates are rounded differences.
#[inline(always)]
pub(crate) fn cotangents([a, b, c]: [[f64; 2]; 3]) -> Option<[i16; 3]> {
    let square = |[x, y]: [f64; 2]| x * x + y * y;
    let (aa, bb, cc) = (square(a), square(b), square(c));
    let (sum, area) = (aa + bb + cc, a[0] * b[1] - a[1] * b[0]);
    let is_sure = sum <= MOST_SLENDER * area && (LEAST_SIZE..=f64::MAX).contains(&sum);
    let scale = 64.0 / area;
    is_sure.then(|| [bb + cc - aa, cc + aa - bb, aa + bb - cc].map(|twice| (twice * scale + ROUNDING).to_bits() as i16))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::double::{incircle, orient2d, Coordinate};
    use incircle_testkit::SplitMix64;

    fn cotangents_of<C: Coordinate>(a: [C; 2], b: [C; 2], c: [C; 2]) -> Option<[i16; 3]> {
        let minus = |one: [C; 2], other: [C; 2]| [one[0].minus(other[0]), one[1].minus(other[1])];
        cotangents([minus(c, b), minus(a, c), minus(b, a)])
    }

    #[test]
    fn sums_beyond_the_bound_tell_the_side_of_the_circle() {
        let mut random = SplitMix64::new(25);
        let (mut sure, mut near) = (0, 0);
        for round in 0..60_000i32 {
            // Four corners of a square that is turned and scaled, each moved by as little as one part in 2^16.
            let scale = 2f64.powi(random.below(1200) as i32 - 600);
            let part = 2f64.powi(-(round % 17));
            let [p, q] = [(); 2].map(|()| random.below(1 << 20) as f64 / 1048576.0 - 0.5);
            let [a, b, c, d] = [[p, q], [-q, p], [-p, -q], [q, -p]].map(|corner| {
                corner.map(|value| scale * (1.0 + value + part * (random.below(1 << 20) as f64 / 1048576.0 - 0.5)))
            });
            // The edge is that from `a` to `c`.
            let (Some([_, at_b, _]), Some([.., at_d])) = (cotangents_of(a, b, c), cotangents_of(a, c, d)) else {
                continue;
            };
            assert!(orient2d(a, b, c).is_gt() && orient2d(a, c, d).is_gt());
            let (sum, side) = (i32::from(at_b) + i32::from(at_d), incircle(a, b, c, d));
            assert!(i32::from(at_b).abs().max(i32::from(at_d).abs()) <= MOST);
            if sum.abs() >= LEAST_SUM {
                assert_eq!(side.is_lt(), sum > 0, "{a:?} {b:?} {c:?} {d:?}: {sum}");
                sure += 1;
            } else {
                near += 1;
            }
        }
        assert!(sure > 10_000 && near > 10_000, "{sure} {near}");
    }

    #[test]
    fn triangles_that_rounding_may_turn_have_no_cotangents() {
        for scale in [1.0, 1e-150, 1e150, 5e-324, 1e308] {
            let [a, b, c] = [[0.0, 0.0], [scale, 0.0], [0.0, scale]];
            let is_plain = scale == 1.0 || scale == 1e150;
            assert_eq!(cotangents_of(a, b, c), is_plain.then_some([0, 128, 128]), "{scale}");
            assert_eq!(cotangents_of(a, c, b), None);
            assert_eq!(cotangents_of(a, b, [0.5 * scale, 0.0]), None);
        }
        assert_eq!(cotangents_of([0.0, 0.0], [1.0, 0.0], [0.5, 1e-3]), None);
        assert_eq!(cotangents_of([f64::MAX, 0.0], [f64::MIN, 0.0], [0.0, f64::MIN]), None);
        assert!(cotangents_of([i64::MIN; 2], [i64::MAX, i64::MIN], [i64::MIN, i64::MAX]).is_some());
    }
}
