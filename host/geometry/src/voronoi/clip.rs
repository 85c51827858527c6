//! The polygon to which cells are clipped.

use alloc::vec::Vec;

use super::border::{edge_of, Border};
use super::corner::{cross, dot, vector};
use super::error::Error;
use crate::point::{Point, MAX_COORD_BITS};
use crate::predicate::orient2d;

/// A simple polygon to which cells are clipped: one ring without holes, of any shape.
#[derive(Clone, Debug)]
pub struct Clip {
    /// Counter-clockwise.
    ring: Vec<Point>,
    border: Border,
}

impl Clip {
    /// The rectangle between two opposite corners, edges included.
    ///
    /// # Errors
    /// The corners have the same x or the same y, or a coordinate has more than 31 bits.
    pub fn rectangle(one: Point, other: Point) -> Result<Self, Error> {
        let (low, high) = ([one.x.min(other.x), one.y.min(other.y)], [one.x.max(other.x), one.y.max(other.y)]);
        let corners = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]];
        Self::polygon(&corners.map(Point::from))
    }

    /// The polygon with these corners, clockwise or counter-clockwise. The first may be repeated at the end, and
    /// corners may repeat the one before. O(m log m) on most rings of `m` corners, and O(m²) at worst.
    ///
    /// # Errors
    /// The ring has no area, edges that are not consecutive have a common place, or a coordinate has more than 31 bits.
    pub fn polygon(corners: &[Point]) -> Result<Self, Error> {
        let is_wide = |point: &Point| (point.x | point.y) >> MAX_COORD_BITS != 0;
        if let Some(index) = corners.iter().position(is_wide) {
            return Err(Error::CoordinateOutOfRange { index, point: corners[index] });
        }
        let mut ring = corners.to_vec();
        ring.dedup();
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        let area: i128 = ring.windows(2).map(|pair| i128::from(orient2d(ring[0], pair[0], pair[1]))).sum();
        if ring.len() < 3 {
            return Err(Error::EmptyClip);
        }
        refuse_crossings(&ring)?;
        match area {
            0 => return Err(Error::EmptyClip),
            ..0 => ring.reverse(),
            _ => {}
        }
        let border = Border::of(&ring);
        Ok(Self { ring, border })
    }

    /// The corners, counter-clockwise. Edge `k` leads from corner `k` to the next one.
    pub fn corners(&self) -> &[Point] {
        &self.ring
    }

    /// Twice the area, exactly, in squares of the grid.
    pub fn twice_area(&self) -> i128 {
        self.ring.windows(2).map(|pair| i128::from(orient2d(self.ring[0], pair[0], pair[1]))).sum()
    }

    /// Whether the border may have a place in a box of doubles, which may be infinite.
    pub(crate) fn may_touch(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        self.border.may_touch(low, high)
    }

    /// The lower left and the upper right corner of the smallest rectangle around the polygon.
    pub fn bounds(&self) -> [Point; 2] {
        let (xs, ys) = (self.ring.iter().map(|corner| corner.x), self.ring.iter().map(|corner| corner.y));
        let low = Point::new(xs.clone().min().unwrap_or(0), ys.clone().min().unwrap_or(0));
        [low, Point::new(xs.max().unwrap_or(0), ys.max().unwrap_or(0))]
    }

    /// Whether the polygon contains a point that is not on its border.
    pub(crate) fn contains(&self, point: Point) -> bool {
        let mut is_inside = false;
        for edge in self.border.at_height(point.y) {
            let [a, b] = edge_of(&self.ring, edge as usize);
            // Half open, so that a corner on the ray counts once.
            if (a.y > point.y) != (b.y > point.y) {
                is_inside ^= (orient2d(a, b, point) > 0) == (b.y > a.y);
            }
        }
        is_inside
    }
}

/// Refuses a ring in which edges that are not consecutive meet, or consecutive ones overlap.
fn refuse_crossings(ring: &[Point]) -> Result<(), Error> {
    let low = |edge: usize| edge_of(ring, edge).map(|end| end.x).into_iter().min().unwrap_or(0);
    let mut order: Vec<usize> = (0..ring.len()).collect();
    order.sort_unstable_by_key(|&edge| low(edge));
    for (place, &one) in order.iter().enumerate() {
        let [a, b] = edge_of(ring, one);
        for &other in order[place + 1..].iter().take_while(|&&other| low(other) <= a.x.max(b.x)) {
            if meet(ring, one, other) {
                return Err(Error::CrossedClip { one: one.min(other), other: one.max(other) });
            }
        }
    }
    Ok(())
}

/// Whether two edges have a place in common that they should not have.
fn meet(ring: &[Point], one: usize, other: usize) -> bool {
    let ([a, b], [c, d]) = (edge_of(ring, one), edge_of(ring, other));
    if b == c || a == d {
        // Consecutive edges: they share more than the corner if they point back.
        let (from, middle, to) = if b == c { (a, b, d) } else { (c, a, b) };
        let (back, on) = (vector(middle, from), vector(middle, to));
        let is_consecutive = (one + 1) % ring.len() == other || (other + 1) % ring.len() == one;
        return !is_consecutive || (cross(back, on) == 0 && dot(back, on) > 0);
    }
    let apart = |[a, b]: [Point; 2], [c, d]: [Point; 2]| a.x.max(b.x) < c.x.min(d.x) || a.y.max(b.y) < c.y.min(d.y);
    if apart([a, b], [c, d]) || apart([c, d], [a, b]) {
        return false;
    }
    let sides = |a, b, c, d| orient2d(a, b, c).signum() * orient2d(a, b, d).signum() <= 0;
    sides(a, b, c, d) && sides(c, d, a, b)
}
