//! Means of values so large that a sum of them leaves the range of doubles.

use crate::lattice::{exponent, scaled};

/// The mean of some values, where a first attempt ended beyond the range of doubles. `mean` works it out again, from
/// values that are divided by two to the power that it is given, and the quotient is multiplied by that power.
///
/// Division by a power of two is exact, except for values that are tiny beside the largest one. A mean is never beyond
/// the smallest and the largest value. If a value is not finite, or the second attempt fails as well, the result is
/// that of the first.
#[cold]
pub(super) fn mean_of_large(first: f64, values: impl Iterator<Item = f64>, mean: impl FnOnce(i32) -> f64) -> f64 {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for value in values {
        if !value.is_finite() {
            return first;
        }
        (low, high) = (low.min(value), high.max(value));
    }
    if low > high {
        return first;
    }
    let shift = exponent(low.abs().max(high.abs())) + 1;
    let second = mean(shift);
    if second.is_finite() {
        scaled(second, shift).clamp(low, high)
    } else {
        first
    }
}
