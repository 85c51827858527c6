//! Points on the grid of the page, which is also that of the core: whole coordinates from 0 to 65535.

use incircle_geometry::Point;

use crate::border::points;

/// The point at a place on the grid.
pub fn grid_point([x, y]: [f64; 2]) -> Result<Point, String> {
    let whole = |value: f64| (value.fract() == 0.0 && (0.0..65_536.0).contains(&value)).then_some(value as u32);
    match (whole(x), whole(y)) {
        (Some(x), Some(y)) => Ok(Point::new(x, y)),
        _ => Err(format!("the grid has whole coordinates from 0 to 65535, but a point is ({x}, {y})")),
    }
}

/// The points in the buffer, which must lie on the grid.
pub fn grid_points() -> Result<Vec<Point>, String> {
    points().into_iter().map(grid_point).collect()
}
