//! Squares of distances, exact for coordinates below 2^31, which are the widest that a device takes.
//!
//! With wider coordinates, squares of 2^64 and more count as equal. All results stay consistent, and no point is lost.

use incircle_geometry::Point;

/// The square of a distance.
pub(super) type Distance = u64;

/// The sum of two squares.
fn squares(x: u32, y: u32) -> Distance {
    let (x, y) = (u64::from(x), u64::from(y));
    (x * x).saturating_add(y * y)
}

/// The square of the distance between two points, or of the diagonal of a box with these corners.
pub(super) fn span(one: Point, other: Point) -> Distance {
    squares(one.x.abs_diff(other.x), one.y.abs_diff(other.y))
}

/// The square of the distance between two boxes, each given by its lowest and its highest corner; 0 if the boxes meet.
pub(super) fn gap([low, high]: [Point; 2], [other_low, other_high]: [Point; 2]) -> Distance {
    // At most one of the two differences of an axis is above 0.
    let x = other_low.x.saturating_sub(high.x) | low.x.saturating_sub(other_high.x);
    let y = other_low.y.saturating_sub(high.y) | low.y.saturating_sub(other_high.y);
    squares(x, y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_are_apart_as_their_nearest_points_are() {
        let at = Point::new;
        assert_eq!(span(at(1, 9), at(4, 5)), 25);
        assert_eq!(gap([at(0, 0), at(3, 3)], [at(6, 7), at(9, 9)]), 25);
        assert_eq!(gap([at(6, 0), at(9, 3)], [at(0, 7), at(3, 9)]), 25);
        assert_eq!(gap([at(0, 0), at(5, 5)], [at(2, 7), at(9, 9)]), 4);
        assert_eq!(gap([at(0, 0), at(5, 5)], [at(2, 5), at(9, 9)]), 0);
    }

    #[test]
    fn the_widest_distances_have_squares() {
        let most = (1 << 31) - 1;
        assert_eq!(span(Point::new(0, most), Point::new(most, 0)), 2 * u64::from(most) * u64::from(most));
        assert_eq!(span(Point::new(0, u32::MAX), Point::new(u32::MAX, 0)), u64::MAX);
    }
}
