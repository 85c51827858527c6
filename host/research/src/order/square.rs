//! The smallest square around a set of points.

use incircle_geometry::Point;

/// The square around a set of points: its lower left corner, and the largest difference of a coordinate from there.
pub(super) fn square(points: &[Point]) -> (Point, u32) {
    let low = |get: fn(&Point) -> u32| points.iter().map(get).min().unwrap_or(0);
    let corner = Point::new(low(|p| p.x), low(|p| p.y));
    let extent = points.iter().map(|p| (p.x - corner.x).max(p.y - corner.y)).max().unwrap_or(0);
    (corner, extent)
}
