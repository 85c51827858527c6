//! Points of the integer grid, and duplicates among them.

use core::fmt;

/// The most bits of a coordinate for the predicates of grid points and for the software model: differences then fit 32
/// bits with their sign. The CPU triangulator takes all 32 bits of a coordinate.
pub const MAX_COORD_BITS: u32 = 31;
/// The most points of one set. With this limit the numbers of all half-edges fit 32 bits.
pub const MAX_POINTS: usize = (1 << 29) - 1;

/// A point of the grid: two unsigned integers.
///
/// Points are plain values of 8 bytes. Pairs and arrays of `u32` convert both ways, as do vectors of the crate `glam`
/// with the feature `glam`. Points compare lexicographically, `x` before `y`; the tie rule uses the same order.
///
/// The type accepts any `u32`, and so does the CPU triangulator. The software model takes coordinates below 2^31, and
/// the standard core takes 16 bits. `incircle::quantize` lays points with fractions onto the grid of a device.
///
/// ```
/// use incircle_geometry::Point;
///
/// let points: Vec<Point> = [(1, 9), (2, 0), (2, 1)].map(Point::from).to_vec();
/// assert!(points.is_sorted());
/// assert_eq!(points[0].to_string(), "(1, 9)");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Point {
    /// Horizontal coordinate, in grid units.
    pub x: u32,
    /// Vertical coordinate, in grid units.
    pub y: u32,
}

impl Point {
    /// Makes the point `(x, y)`.
    #[inline]
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

#[cfg(feature = "glam")]
impl From<glam::UVec2> for Point {
    fn from(v: glam::UVec2) -> Self {
        Self { x: v.x, y: v.y }
    }
}

#[cfg(feature = "glam")]
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

/// An input point with the coordinates of an earlier one.
///
/// The mesh has each place once, under its lowest index. All other input points of that place are listed as duplicates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Duplicate {
    /// Input index of the point.
    pub index: u32,
    /// Lowest input index with the same coordinates, which stands for all of them in the mesh.
    pub of: u32,
}

impl From<Point> for [u32; 2] {
    fn from(point: Point) -> Self {
        [point.x, point.y]
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
    fn pairs_and_arrays_convert() {
        let expected = Point::new(3, 4);
        assert_eq!(Point::from((3, 4)), expected);
        assert_eq!(Point::from([3, 4]), expected);
        assert_eq!(<(u32, u32)>::from(expected), (3, 4));
        assert_eq!(<[u32; 2]>::from(expected), [3, 4]);
    }

    #[cfg(feature = "glam")]
    #[test]
    fn vectors_of_glam_convert() {
        let expected = Point::new(3, 4);
        assert_eq!(Point::from(glam::UVec2::new(3, 4)), expected);
        assert_eq!(glam::UVec2::from(expected), glam::UVec2::new(3, 4));
    }
}
