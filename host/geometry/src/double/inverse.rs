//! Inverses of points with respect to a circle, which tell by products whether a neighbour of a vertex is nearer to a
//! place than the vertex itself.
//!
//! Let a vertex be the origin, `q` the place and `w` another point. The inverse of `w` is `w / |w|²`. Then `w` is
//! nearer to `q` than the vertex is if the product of `q` and the inverse of `w`, the *height* of `w`, is larger than
//! 1/2, because `|q - w|² - |q|² = |w|² - 2 q w`.
//!
//! **The bound.** Let `u = 2^-53`. The product `q w` errs by at most `(4 u + O(u²)) s`, where `s` is its size, and
//! `|w|²` by `4 u` of itself. So a height errs by at most `(9 u + O(u²)) s / |w|²`. Here `|q|` is at most about `2^10
//! |w|`, so the error is less than `2^-39`. The bound is `2^-30`, because nothing is lost if the exact stage decides a
//! few more. **Underflow** of the products of `q w` adds less than `2^-114`, because `|w|²` is at least `2^-960`, and
//! nothing **overflows** because it is at most `2^1000`. Points outside these ranges have no height.

use super::LEAST_SIZE;

/// Heights that differ by more than this, from one another or from 1/2, have the right order.
pub(crate) const HEIGHT_BOUND: f64 = 1.0 / (1u64 << 30) as f64;
/// The largest square of the distance from the vertex to the place, in multiples of that to the other point.
const FARTHEST: f64 = (1u64 << 20) as f64;
/// The largest square of a distance: `2^1000`.
const LARGEST: f64 = f64::from_bits((1023 + 1000) << 52);

/// The height of a point, given the vectors from the vertex to the place and to the point, whose coordinates are
/// rounded differences. `None` if its bound does not hold.
#[inline(always)]
pub(crate) fn height(q: [f64; 2], w: [f64; 2]) -> Option<f64> {
    let product = |one: [f64; 2], other: [f64; 2]| one[0] * other[0] + one[1] * other[1];
    let square = product(w, w);
    let is_sure = (LEAST_SIZE..=LARGEST).contains(&square) && product(q, q) <= FARTHEST * square;
    is_sure.then(|| product(q, w) / square)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::double::nearer_of;
    use incircle_testkit::SplitMix64;

    #[test]
    fn heights_beyond_the_bound_tell_what_is_nearer() {
        let mut random = SplitMix64::new(26);
        let (mut sure, mut open) = (0, 0);
        for round in 0..40_000u32 {
            let scale = 2f64.powi(random.below(1200) as i32 - 600);
            let part = 2f64.powi(-(random.below(50) as i32));
            let mut value = |size: f64| scale * size * (random.below(1 << 20) as f64 / 1048576.0 - 0.5);
            let (v, q) = ([value(1.0), value(1.0)], [value(1.0), value(1.0)]);
            // Nearly as far from the place as the vertex, on the other side.
            let w = [2.0 * q[0] - v[0] + value(part), 2.0 * q[1] - v[1] + value(part)];
            let minus = |one: [f64; 2]| [one[0] - v[0], one[1] - v[1]];
            match height(minus(q), minus(w)) {
                Some(height) if (height - 0.5).abs() > HEIGHT_BOUND => {
                    assert_eq!(nearer_of(q, w, v).is_lt(), height > 0.5, "{round}: {v:?} {q:?} {w:?}");
                    sure += 1;
                }
                _ => open += 1,
            }
        }
        assert!(sure > 10_000 && open > 5_000, "{sure} {open}");
    }

    #[test]
    fn points_out_of_range_have_no_height() {
        assert_eq!(height([1.0, 0.0], [2.0, 2.0]), Some(0.25));
        for (q, w) in [([1.0, 0.0], [0.0, 0.0]), ([1.0, 0.0], [1e-4, 0.0]), ([1e-200, 0.0], [1e-200, 0.0])] {
            assert_eq!(height(q, w), None);
        }
        assert_eq!(height([1.0, 0.0], [1e300, 0.0]), None);
        assert_eq!(height([f64::INFINITY, 0.0], [1.0, 0.0]), None);
    }
}
