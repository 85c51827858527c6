//! Grid points.

use std::fmt;

/// A point of the grid: two unsigned integers.
///
/// A device takes coordinates below 2^`coord_bits` (16 in the standard core, 31 at most); nothing is checked here.
/// The order is lexicographic, `x` before `y`: it is the order of the tie rule.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Point {
    /// Horizontal coordinate, in grid units.
    pub x: u32,
    /// Vertical coordinate, in grid units.
    pub y: u32,
}

impl Point {
    /// The point `(x, y)`.
    pub const fn new(x: u32, y: u32) -> Self {
        Self { x, y }
    }
}

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}, {})", self.x, self.y)
    }
}

impl From<(u32, u32)> for Point {
    fn from((x, y): (u32, u32)) -> Self {
        Self { x, y }
    }
}

impl From<[u32; 2]> for Point {
    fn from([x, y]: [u32; 2]) -> Self {
        Self { x, y }
    }
}

impl From<glam::UVec2> for Point {
    fn from(v: glam::UVec2) -> Self {
        Self { x: v.x, y: v.y }
    }
}

impl From<Point> for glam::UVec2 {
    fn from(point: Point) -> Self {
        glam::UVec2::new(point.x, point.y)
    }
}

impl From<Point> for (u32, u32) {
    fn from(point: Point) -> Self {
        (point.x, point.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_is_lexicographic_x_before_y() {
        assert!(Point::new(1, 9) < Point::new(2, 0));
        assert!(Point::new(2, 0) < Point::new(2, 1));
    }

    #[test]
    fn pairs_arrays_and_vectors_convert() {
        let expected = Point::new(3, 4);
        assert_eq!(Point::from((3, 4)), expected);
        assert_eq!(Point::from([3, 4]), expected);
        assert_eq!(Point::from(glam::UVec2::new(3, 4)), expected);
        assert_eq!(glam::UVec2::from(expected), glam::UVec2::new(3, 4));
        assert_eq!(<(u32, u32)>::from(expected), (3, 4));
    }
}
