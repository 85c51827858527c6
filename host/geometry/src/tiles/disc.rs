//! The circumscribed disc of a triangle beside a rectangle.
//!
//! **The test.** Let `a` be a corner and `C` the centre relative to `a`. A place `p` relative to `a` lies outside the
//! closed disc if `|p|² - 2 p·C > 0`. This sum has a part for each axis, `t (t - 2 C)`, which is least at the `t` of
//! the rectangle that is nearest to `C`. So the rectangle misses the disc if the least parts of both axes have a
//! positive sum.
//!
//! **Rounding.** Let `e = 2^-52`. For 32 bits, the numerators and the denominator of `C` are whole numbers below 2^100,
//! so `C` has an error of at most `2 e |C|`: both are rounded once, and so is the quotient. Differences of places are
//! below 2^34 and exact. If `m` is the largest magnitude of `t` in the rectangle, the error of `C` changes each part by
//! at most `4 e m |C|`, also where it moves the nearest `t`. The product has two roundings more, below
//! `2 e m (m + 2 |C|)`, and the sum has one. All together are below `16 e m (m + 2 |C|)`, summed for both axes.

use crate::point::Point;

/// A disc whose circle goes through a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    /// A point on the circle.
    start: [f64; 2],
    /// The centre, relative to that point.
    centre: [f64; 2],
}

impl Disc {
    /// The disc through three points; `None` if they are on one line.
    pub(super) fn of([a, b, c]: [Point; 3]) -> Option<Self> {
        let seen = |p: Point| [i128::from(p.x) - i128::from(a.x), i128::from(p.y) - i128::from(a.y)];
        let (b, c) = (seen(b), seen(c));
        let cross = b[0] * c[1] - b[1] * c[0];
        let square = |v: [i128; 2]| v[0] * v[0] + v[1] * v[1];
        let (of_b, of_c) = (square(b), square(c));
        let along = [c[1] * of_b - b[1] * of_c, b[0] * of_c - c[0] * of_b];
        let centre = along.map(|value| value as f64 / (2 * cross) as f64);
        (cross != 0).then_some(Self { start: [a.x.into(), a.y.into()], centre })
    }

    /// Whether no place of a rectangle is in the closed disc. `low` and `high` are the least and the greatest place, of
    /// whole coordinates within 2^33. An answer that rounding hides is `false`.
    #[inline(always)]
    pub(super) fn misses(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        let (mut value, mut magnitude) = (0.0, 0.0);
        for axis in 0..2 {
            let [least, most] = [low, high].map(|place| place[axis] - self.start[axis]);
            let centre = self.centre[axis];
            let nearest = centre.clamp(least, most);
            let largest = least.abs().max(most.abs());
            value += nearest * (nearest - 2.0 * centre);
            magnitude += largest * (largest + 2.0 * centre.abs());
        }
        value > 16.0 * f64::EPSILON * magnitude
    }
}

#[cfg(test)]
mod tests {
    use incircle_testkit::SplitMix64;

    use super::*;
    use crate::predicate::{incircle, orient2d};

    #[test]
    fn a_rectangle_that_misses_a_disc_has_no_place_in_it() {
        let mut random = SplitMix64::new(3);
        let (mut missed, mut touched) = (0, 0);
        for round in 0..20_000u32 {
            let bits = [3, 8, 20, 31][round as usize % 4];
            let mut point = || Point::new(random.bits(bits) as u32, random.bits(bits) as u32);
            let [a, b, c, one, other] = [(); 5].map(|()| point());
            let Some(disc) = Disc::of([a, b, c]) else {
                assert_eq!(orient2d(a, b, c), 0);
                continue;
            };
            let [b, c] = if orient2d(a, b, c) < 0 { [c, b] } else { [b, c] };
            let [low, high] = [[one.x.min(other.x), one.y.min(other.y)], [one.x.max(other.x), one.y.max(other.y)]];
            let wide = |place: [u32; 2]| place.map(f64::from);
            // The place of the rectangle that is nearest to the centre is one of a few.
            let mut places = alloc::vec::Vec::new();
            for axis_x in near(&disc, 0, low[0], high[0]) {
                places.extend(near(&disc, 1, low[1], high[1]).map(|y| Point::new(axis_x, y)));
            }
            let is_free = places.iter().all(|&place| incircle(a, b, c, place) < 0);
            if disc.misses(wide(low), wide(high)) {
                missed += 1;
                assert!(is_free, "{a:?} {b:?} {c:?} {low:?} {high:?}");
            } else {
                touched += usize::from(!is_free);
            }
        }
        assert!(missed > 3000 && touched > 3000, "{missed} {touched}");
    }

    /// The places beside the centre on an axis, within a rectangle.
    fn near(disc: &Disc, axis: usize, low: u32, high: u32) -> [u32; 3] {
        let centre = disc.centre[axis] + disc.start[axis];
        [-1.0, 0.0, 1.0].map(|step| (centre + step).clamp(low.into(), high.into()) as u32)
    }

    #[test]
    fn a_place_on_the_circle_is_not_missed() {
        let disc = Disc::of([(0, 0), (4, 0), (0, 4)].map(Point::from)).expect("a triangle");
        let end = [9.0, 9.0];
        assert!(!disc.misses([4.0, 4.0], end) && disc.misses([5.0, 4.0], end));
        assert!(!disc.misses([1.0, 1.0], [2.0, 2.0]) && !disc.misses([-5.0, -5.0], end));
    }
}
