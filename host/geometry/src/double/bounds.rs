//! The filter of the CPU triangulator, with bounds that hold for a whole set of points.
//!
//! **The bounds.** Let `M` be the larger of width and height of the set, as a rounded difference, and `u = 2^-53`.
//! Rounding never changes the order of two numbers, so each rounded difference of two coordinates is at most `M` in
//! magnitude, and each product of two differences at most `M² (1 + u)`.
//!
//! - A product of two rounded differences has three roundings and errs by at most `(3 u + O(u²)) M²`. A cross or dot
//!   product is made of two such products and one more rounding, of at most `2 u M²`: it errs by `(8 u + O(u²)) M²`.
//! - Cross and dot products are at most `(2 + O(u)) M²`. So `dot(c) cross(d)` has errors of at most `2 · 2 · 8 u M⁴`
//!   from its factors and `4 u M⁴` from its own rounding, `36 u M⁴` in all, and so has `dot(d) cross(c)`. The last
//!   subtraction adds at most `8 u M⁴`. The sum is `(80 u + O(u²)) M⁴`.
//!
//! The bounds below are `9 u M²` and `96 u M⁴`, so there is room for the terms of `u²` and for the rounding of `M²` and
//! `M⁴`.
//!
//! **Underflow** adds at most `2^-1075` to each product. For `M >= 2^-240` that is less than `2^-500` of the bound of a
//! cross product, `9 u M²`. After multiplication by `2 M²` it is less than `2^-500` of the bound of the determinant,
//! `96 u M⁴ >= 2^-1007`. The products of the determinant itself add less than `2^-60` of that bound. The room above
//! covers all of these. **Overflow** does not occur for `M <= 2^250`. Sets of other sizes get infinite bounds, which no
//! number exceeds.

use core::cmp::Ordering;

use super::coordinate::Coordinate;
use super::view::{sign, View, UNIT};

/// The least and the largest size of a set that has finite bounds.
const LEAST: f64 = power_of_two(-240);
const MOST: f64 = power_of_two(250);

const fn power_of_two(exponent: i64) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// Bounds of the rounding errors in the predicates of a set of points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    cross: f64,
    determinant: f64,
}

impl Bounds {
    /// The bounds for all points in the bounding box of `points`.
    #[inline(always)]
    pub(crate) fn of<C: Coordinate, const N: usize>(points: [[C; 2]; N]) -> Self {
        let extent = |axis: usize| {
            let (mut low, mut high) = (points[0][axis], points[0][axis]);
            for point in &points[1..] {
                low = if point[axis] < low { point[axis] } else { low };
                high = if point[axis] > high { point[axis] } else { high };
            }
            high.minus(low)
        };
        let (width, height) = (extent(0), extent(1));
        let size = if width > height { width } else { height };
        let square = if (LEAST..=MOST).contains(&size) { size * size } else { f64::INFINITY };
        Self { cross: 9.0 * UNIT * square, determinant: 96.0 * UNIT * (square * square) }
    }

    /// The side of the edge on which the point of a view lies, if the filter can tell: `Greater` is left.
    #[inline(always)]
    pub(crate) fn side(self, view: View) -> Option<Ordering> {
        (view.cross.abs() > self.cross).then(|| sign(view.cross))
    }

    /// Whether the point of `c` lies to the left of the edge, and the point of `q` inside the circle through both ends
    /// of the edge and the point of `c`, if the filter can tell. The code makes all comparisons, because no processor
    /// would predict branches between them.
    #[inline(always)]
    pub(crate) fn is_left_and_inside(self, c: View, q: View) -> Option<bool> {
        let determinant = c.determinant(q);
        let is = (c.cross > self.cross) & (determinant > self.determinant);
        let is_not = (c.cross < -self.cross) | (determinant < -self.determinant);
        (is | is_not).then_some(is)
    }
}
