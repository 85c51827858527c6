//! Drawings of curves for tests: the number of each lattice point along the curve, row by row from the top.

use super::Curve;
use incircle_geometry::Point;

/// The points of a lattice, in the order of the curve.
fn walk(curve: Curve, width: u32, height: u32) -> Vec<Point> {
    let points: Vec<Point> = (0..width * height).map(|k| Point::new(k % width, k / width)).collect();
    curve.order(&points).into_iter().map(|index| points[index as usize]).collect()
}

/// Draws the curve through a square lattice.
pub(super) fn draw(curve: Curve, side: u32) -> Vec<String> {
    draw_box(curve, side, side)
}

/// Draws the curve through a rectangular lattice.
pub(super) fn draw_box(curve: Curve, width: u32, height: u32) -> Vec<String> {
    let walk = walk(curve, width, height);
    let number = |x: u32, y: u32| walk.iter().position(|&p| p == Point::new(x, y)).unwrap_or(usize::MAX);
    (0..height).rev().map(|y| (0..width).map(|x| format!("{:3}", number(x, y))).collect()).collect()
}

/// The longest step, counted along the axes, through a square lattice.
pub(super) fn longest_step(curve: Curve, side: u32) -> u32 {
    longest_step_in_box(curve, side, side)
}

/// The longest step, counted along the axes, through a rectangular lattice.
pub(super) fn longest_step_in_box(curve: Curve, width: u32, height: u32) -> u32 {
    let walk = walk(curve, width, height);
    walk.windows(2).map(|pair| pair[0].x.abs_diff(pair[1].x) + pair[0].y.abs_diff(pair[1].y)).max().unwrap_or(0)
}
