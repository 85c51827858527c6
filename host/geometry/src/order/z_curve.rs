//! Positions along the Z-curve, which visits the quadrants in the order lower left, upper left, lower right, upper
//! right, and each quadrant in the same way.
//!
//! A position has the bits of x and y in turn, so no curve is cheaper to compute; from one half to the other the curve
//! jumps. Source: Morton, *A computer oriented geodetic data base*, 1966.

use crate::point::Point;

/// The position of the cell `(x, y)` along the curve, for any coordinates.
#[inline(always)]
pub fn position(x: u32, y: u32) -> u64 {
    spread(x) << 1 | spread(y)
}

/// The position of the cell `(x, y)` along the curve, for coordinates of up to 16 bits: both are spread at once.
#[inline(always)]
pub fn narrow_position(x: u32, y: u32) -> u64 {
    let fold = |bits: u64, shift: u32, mask: u64| (bits | bits << shift) & mask;
    let both = u64::from(x) << 32 | u64::from(y);
    let both = fold(both, 8, 0x00ff_00ff_00ff_00ff);
    let both = fold(both, 4, 0x0f0f_0f0f_0f0f_0f0f);
    let both = fold(both, 2, 0x3333_3333_3333_3333);
    let both = fold(both, 1, 0x5555_5555_5555_5555);
    both >> 31 & 0xaaaa_aaaa | both & 0x5555_5555
}

/// The cell at a position: the inverse of [`position`].
#[inline(always)]
pub fn point_at(position: u64) -> Point {
    Point::new(gather(position >> 1), gather(position))
}

/// Collects the even bits of a number, side by side.
#[inline(always)]
fn gather(bits: u64) -> u32 {
    let fold = |bits: u64, shift: u32, mask: u64| (bits | bits >> shift) & mask;
    let bits = fold(bits & 0x5555_5555_5555_5555, 1, 0x3333_3333_3333_3333);
    let bits = fold(bits, 2, 0x0f0f_0f0f_0f0f_0f0f);
    let bits = fold(bits, 4, 0x00ff_00ff_00ff_00ff);
    let bits = fold(bits, 8, 0x0000_ffff_0000_ffff);
    fold(bits, 16, 0x0000_0000_ffff_ffff) as u32
}

/// Spreads the bits of a number, each with a zero above it.
#[inline(always)]
fn spread(value: u32) -> u64 {
    let fold = |bits: u64, shift: u32, mask: u64| (bits | bits << shift) & mask;
    let bits = fold(value.into(), 16, 0x0000_ffff_0000_ffff);
    let bits = fold(bits, 8, 0x00ff_00ff_00ff_00ff);
    let bits = fold(bits, 4, 0x0f0f_0f0f_0f0f_0f0f);
    let bits = fold(bits, 2, 0x3333_3333_3333_3333);
    fold(bits, 1, 0x5555_5555_5555_5555)
}

#[cfg(test)]
mod tests {
    use super::{point_at, position};
    use crate::point::Point;

    #[test]
    fn the_widest_coordinates_have_positions() {
        assert_eq!(position(u32::MAX, u32::MAX), u64::MAX);
        assert_eq!(point_at(u64::MAX), Point::new(u32::MAX, u32::MAX));
    }
}
