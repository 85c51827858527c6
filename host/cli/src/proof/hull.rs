//! The hull of the points of a proof: its edges, each in the strip where its triangle is checked.

use std::path::Path;

use incircle::verify::local::sector;
use incircle::Point;

use super::sorter::{Sorted, Sorter};
use super::stack::Stack;
use crate::failure::Failure;

/// The hull of a set.
pub struct Hull {
    /// The number of points on it.
    pub count: u64,
    /// Twice its area.
    pub area: i128,
    /// The place of the lowest index.
    pub start: u32,
    /// Rows of a strip, the two points of an edge in rising order, whether the edge runs the other way, and its place
    /// on the hull. The strip is the one of the first point.
    pub edges: Sorted<5>,
}

impl Hull {
    /// The hull with these sides, which begin at one point and end at another one. The points on its edges belong to
    /// it.
    ///
    /// # Errors
    /// A file cannot be read or written.
    pub fn of(sides: [Stack; 2], strips: &[Point], folder: &Path, memory: u64) -> Result<Self, Failure> {
        let [mut lower, mut upper] = sides;
        let count = (lower.len() + upper.len()).saturating_sub(2);
        let mut hull = Self { count, area: 0, start: 0, edges: Sorter::new(folder, 0).finish()? };
        let (mut edges, mut lowest) = (Sorter::new(folder, memory), u32::MAX);
        let mut add = |hull: &mut Self, place: u64, [from, to]: [[u32; 3]; 2]| {
            let place = (place % count.max(1)) as u32;
            hull.area += sector(point_of(from), point_of(to));
            if from[2] < lowest {
                (lowest, hull.start) = (from[2], place);
            }
            let (least, most) = if from[2] < to[2] { (from, to) } else { (to, from) };
            let strip = strip_of(strips, point_of(least)) as u32;
            edges.push([strip, least[2], most[2], u32::from(from[2] > to[2]), place])
        };
        // The lower side runs counter-clockwise, and comes from its end here; the upper one the other way round.
        let mut after = lower.pop()?;
        while let (Some(to), Some(from)) = (after, lower.pop()?) {
            add(&mut hull, lower.len(), [from, to])?;
            after = Some(from);
        }
        let (mut from, mut place) = (upper.pop()?, count.saturating_sub(upper.len()));
        while let (Some(begin), Some(to)) = (from, upper.pop()?) {
            add(&mut hull, place, [begin, to])?;
            (from, place) = (Some(to), place + 1);
        }
        hull.edges = edges.finish()?;
        Ok(hull)
    }

    /// The place of an edge when counting begins at the lowest index.
    pub fn rank(&self, place: u32) -> u64 {
        (u64::from(place) + self.count - u64::from(self.start)) % self.count.max(1)
    }
}

/// The point of a row: x, y and index.
pub fn point_of([x, y, _]: [u32; 3]) -> Point {
    Point::new(x, y)
}

/// The strip of a point, given the first point of each strip.
pub fn strip_of(strips: &[Point], point: Point) -> usize {
    strips.partition_point(|first| *first <= point).saturating_sub(1)
}
