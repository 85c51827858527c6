//! The numbers that coordinates of filtered points may be: doubles and integers of 64 bits.

/// A number that the filter of the predicates can round and their exact stage can take apart.
pub trait Coordinate: Copy + PartialOrd + Default + Send + Sync + bytemuck::Zeroable + 'static {
    /// `self - other`, rounded to the nearest double.
    fn minus(self, other: Self) -> f64;

    /// The number as an odd integer times a power of two; zero as `0 * 2^i32::MAX`.
    fn parts(self) -> (i64, i32);

    /// Half of the number, rounded: differences of halves do not overflow.
    fn half(self) -> f64;

    /// The number with zero for minus zero, which is the same place.
    fn positive_zero(self) -> Self;
}

/// Bits of the mantissa of a double behind the leading one.
const FRACTION_BITS: u32 = f64::MANTISSA_DIGITS - 1;

impl Coordinate for f64 {
    #[inline(always)]
    fn minus(self, other: Self) -> f64 {
        self - other
    }

    fn parts(self) -> (i64, i32) {
        let bits = self.to_bits();
        let fraction = (bits & ((1 << FRACTION_BITS) - 1)) as i64;
        let biased = (bits >> FRACTION_BITS & 0x7ff) as i32;
        // Denormals have no leading one and the exponent of the smallest normal double.
        let (mantissa, exponent) = if biased == 0 { (fraction, 1) } else { (fraction | 1 << FRACTION_BITS, biased) };
        if mantissa == 0 {
            return (0, i32::MAX);
        }
        let zeros = mantissa.trailing_zeros();
        let odd = mantissa >> zeros;
        // 1075 = 1023, the bias, and 52 bits of fraction.
        (if self < 0.0 { -odd } else { odd }, exponent - 1075 + zeros as i32)
    }

    #[inline(always)]
    fn half(self) -> f64 {
        0.5 * self
    }

    #[inline(always)]
    fn positive_zero(self) -> Self {
        // In IEEE 754 the sum of both zeros is the positive one.
        self + 0.0
    }
}

impl Coordinate for i64 {
    #[inline(always)]
    fn minus(self, other: Self) -> f64 {
        match self.checked_sub(other) {
            Some(difference) => difference as f64,
            None => (i128::from(self) - i128::from(other)) as f64,
        }
    }

    fn parts(self) -> (i64, i32) {
        match self {
            0 => (0, i32::MAX),
            _ => (self >> self.trailing_zeros(), self.trailing_zeros() as i32),
        }
    }

    #[inline(always)]
    fn half(self) -> f64 {
        0.5 * self as f64
    }

    #[inline(always)]
    fn positive_zero(self) -> Self {
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_double_is_its_parts() {
        for value in
            [0.0, 1.0, -1.0, 0.1, -3.0e300, f64::MAX, f64::MIN_POSITIVE, 5e-324, -2.5e-310, 4_503_599_627_370_497.0]
        {
            let (odd, exponent) = value.parts();
            if value == 0.0 {
                assert_eq!((odd, exponent), (0, i32::MAX));
                continue;
            }
            assert!(odd % 2 != 0, "{value}");
            // In two steps, because 2^exponent may be smaller than all doubles.
            let half = exponent / 2;
            assert_eq!(odd as f64 * 2f64.powi(half) * 2f64.powi(exponent - half), value);
        }
        assert_eq!((-0.0f64).parts(), (0, i32::MAX));
    }

    #[test]
    fn an_integer_is_its_parts() {
        for value in [1, -1, 12, i64::MIN, i64::MAX, -(1 << 40)] {
            let (odd, exponent) = value.parts();
            assert!(odd % 2 != 0);
            assert_eq!(i128::from(odd) << exponent, i128::from(value));
        }
        assert_eq!(i64::MAX.minus(i64::MIN), 2f64.powi(64));
    }
}
