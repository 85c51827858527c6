//! The hole that a deleted vertex leaves, and predicates that count how often they are asked.

use incircle_geometry::{incircle, orient2d, Point};

/// Three places in a ring, counter-clockwise, the smallest first.
pub(super) type Triangle = [usize; 3];

/// The number of tests.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Tests {
    pub(super) orient2d: u64,
    pub(super) incircle: u64,
}

/// The neighbours of a vertex inside the hull, counter-clockwise around the vertex, which is the hub.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    pub(super) hub: Point,
    pub(super) points: Vec<Point>,
    pub(super) tests: Tests,
}

impl Ring {
    pub(super) fn new(hub: Point, points: Vec<Point>) -> Self {
        Self { hub, points, tests: Tests::default() }
    }

    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether three places turn to the left.
    pub(super) fn turns_left(&mut self, [a, b, c]: Triangle) -> bool {
        self.tests.orient2d += 1;
        orient2d(self.points[a], self.points[b], self.points[c]) > 0
    }

    /// Whether the hub is to the left of the way from one place to another, or on its line.
    pub(super) fn has_hub_left(&mut self, a: usize, b: usize) -> bool {
        self.tests.orient2d += 1;
        orient2d(self.points[a], self.points[b], self.hub) >= 0
    }

    /// Whether a place is inside the circle of a triangle, with the tie rule: the lexicographically smallest of four
    /// points on a circle counts as inside that of the others. Ties take one more `orient2d`, which is not counted.
    pub(super) fn conflicts(&mut self, [a, b, c]: Triangle, d: usize) -> bool {
        self.tests.incircle += 1;
        let [a, b, c, d] = [a, b, c, d].map(|place| self.points[place]);
        let sign = incircle(a, b, c, d);
        if sign != 0 {
            return sign > 0;
        }
        let smallest = a.min(b).min(c).min(d);
        let beyond = |from, to| orient2d(from, to, d) < 0;
        smallest == d || smallest == a && beyond(b, c) || smallest == b && beyond(c, a) || smallest == c && beyond(a, b)
    }
}

/// The same triangle with its smallest place first.
pub(super) fn smallest_first(mut triangle: Triangle) -> Triangle {
    let smallest = (0..3).min_by_key(|&corner| triangle[corner]).unwrap_or(0);
    triangle.rotate_left(smallest);
    triangle
}
