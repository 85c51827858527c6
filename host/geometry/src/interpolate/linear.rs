//! The values of linear functions on an edge and on a triangle.

use super::large::mean_of_large;
use crate::lattice::scaled;

/// The value on the line between two places with values, at a place between them. A [`Surface`](super::Surface) gives
/// the end of the lower index first. If coordinates are below 1e75, the value between finite values is finite.
///
/// ```
/// use incircle_geometry::interpolate::edge_value;
/// assert_eq!(edge_value([([0.0, 0.0], 1.0), ([4.0, 2.0], 9.0)], [1.0, 0.5]), 3.0);
/// ```
#[inline]
pub fn edge_value(ends: [([f64; 2], f64); 2], q: [f64; 2]) -> f64 {
    let value = on_line(ends, q);
    if value.is_finite() {
        return value;
    }
    let smaller = |shift: i32| ends.map(|(place, value)| (place, scaled(value, -shift)));
    mean_of_large(value, ends.into_iter().map(|(_, value)| value), |shift| on_line(smaller(shift), q))
}

#[inline]
fn on_line([(a, from), (b, to)]: [([f64; 2], f64); 2], q: [f64; 2]) -> f64 {
    let axis = usize::from((b[1] - a[1]).abs() > (b[0] - a[0]).abs());
    let share = (q[axis] - a[axis]) / (b[axis] - a[axis]);
    from + share * (to - from)
}

/// The value of the plane through the corners of a triangle, counter-clockwise, at a place that it contains. A
/// [`Surface`](super::Surface) begins with the corner that the triangle of the mesh has first. If coordinates are below
/// 1e75, the value between finite values is finite.
///
/// ```
/// use incircle_geometry::interpolate::plane_value;
/// assert_eq!(plane_value([([0.0, 0.0], 1.0), ([4.0, 0.0], 9.0), ([0.0, 4.0], 1.0)], [1.0, 2.0]), 3.0);
/// ```
#[inline(always)]
pub fn plane_value(corners: [([f64; 2], f64); 3], q: [f64; 2]) -> f64 {
    let value = on_plane(corners, q);
    if value.is_finite() {
        return value;
    }
    let smaller = |shift: i32| corners.map(|(place, value)| (place, scaled(value, -shift)));
    mean_of_large(value, corners.into_iter().map(|(_, value)| value), |shift| on_plane(smaller(shift), q))
}

#[inline(always)]
fn on_plane(corners: [([f64; 2], f64); 3], q: [f64; 2]) -> f64 {
    let [a, b, c] = corners.map(|(corner, _)| [corner[0] - q[0], corner[1] - q[1]]);
    let cross = |one: [f64; 2], other: [f64; 2]| one[0] * other[1] - one[1] * other[0];
    let (from_a, from_b, from_c) = (cross(b, c), cross(c, a), cross(a, b));
    let [za, zb, zc] = corners.map(|(_, value)| value);
    za + (from_b * (zb - za) + from_c * (zc - za)) / (from_a + from_b + from_c)
}
