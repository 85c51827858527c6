//! The polygon to which cells are clipped.

use alloc::vec::Vec;
use core::cmp::Ordering;
use core::ops::Range;

use super::border::{Bisector, Border};
use super::corner::{cross, dot, vector};
use super::error::Error;
use super::rings::Rings;
use crate::point::{Point, MAX_COORD_BITS};
use crate::predicate::orient2d;

/// A simple polygon to which cells are clipped: an outer ring of any shape, perhaps with holes.
#[derive(Clone, Debug)]
pub struct Clip {
    pub(super) rings: Rings,
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
    /// corners may repeat the one before. O(m log m) for `m` corners, and more the more the boxes around edges and
    /// around consecutive edges overlap: O(m²) at worst, as for a comb of long slanted teeth.
    ///
    /// # Errors
    /// The ring has no area, edges that are not consecutive have a common place, or a coordinate has more than 31 bits.
    pub fn polygon(corners: &[Point]) -> Result<Self, Error> {
        Self::with_holes(corners, &[])
    }

    /// A polygon with holes: rings as for [`polygon`](Self::polygon), which have no common place.
    ///
    /// ```
    /// use incircle_geometry::voronoi::Clip;
    /// use incircle_geometry::Point;
    ///
    /// let square = |a: u32, b: u32| [(a, a), (b, a), (b, b), (a, b)].map(Point::from).to_vec();
    /// let clip = Clip::with_holes(&square(0, 9), &[square(1, 3), square(5, 8)])?;
    /// assert_eq!(clip.twice_area(), 2 * (81 - 4 - 9));
    /// # Ok::<(), incircle_geometry::voronoi::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`polygon`](Self::polygon), for any of the rings; a hole outside the outer ring, or inside another hole.
    pub fn with_holes(outer: &[Point], holes: &[Vec<Point>]) -> Result<Self, Error> {
        let mut clip = Self { rings: Rings::default(), border: Border::default() };
        for ring in core::iter::once(outer).chain(holes.iter().map(Vec::as_slice)) {
            clip.add_ring(ring)?;
        }
        clip.border = Border::of(&clip.rings);
        clip.refuse_crossings()?;
        clip.turn_rings()?;
        clip.border = Border::of(&clip.rings);
        clip.refuse_misplaced_holes()?;
        Ok(clip)
    }

    /// The polygon whose corners stand one ring behind the other: the outer one, then the holes. `counts` says how many
    /// corners each ring has.
    ///
    /// ```
    /// use incircle_geometry::voronoi::Clip;
    /// use incircle_geometry::Point;
    ///
    /// let corners = [(0, 0), (9, 0), (9, 9), (0, 9), (1, 1), (3, 1), (1, 3)].map(Point::from);
    /// assert_eq!(Clip::of_rings(&corners, &[4, 3])?.twice_area(), 2 * 81 - 4);
    /// # Ok::<(), incircle_geometry::voronoi::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`with_holes`](Self::with_holes); there is no count, or they do not add up to the number of corners.
    pub fn of_rings(corners: &[Point], counts: &[usize]) -> Result<Self, Error> {
        let have = counts.iter().fold(0, |sum: usize, &count| sum.saturating_add(count));
        let mut rest = corners;
        let mut rings = counts.iter().filter_map(|&count| rest.split_off(..count));
        match rings.next() {
            Some(outer) if have == corners.len() => {
                Self::with_holes(outer, &rings.map(<[_]>::to_vec).collect::<Vec<_>>())
            }
            _ => Err(Error::RingCounts { have, corners: corners.len() }),
        }
    }

    fn add_ring(&mut self, ring: &[Point]) -> Result<(), Error> {
        let is_wide = |point: &Point| (point.x | point.y) >> MAX_COORD_BITS != 0;
        if let Some(index) = ring.iter().position(is_wide) {
            return Err(Error::CoordinateOutOfRange { index, point: ring[index] });
        }
        let mut ring = ring.to_vec();
        ring.dedup();
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        if ring.len() < 3 {
            return Err(Error::EmptyClip);
        }
        let begin = self.rings.corners.len();
        self.rings.next.extend((1..ring.len()).map(|k| (begin + k) as u32).chain([begin as u32]));
        self.rings.corners.extend(ring);
        self.rings.ends.push(self.rings.corners.len());
        Ok(())
    }

    /// Turns the outer ring counter-clockwise and the holes clockwise.
    fn turn_rings(&mut self) -> Result<(), Error> {
        let mut begin = 0;
        for (number, &end) in self.rings.ends.iter().enumerate() {
            let ring = &mut self.rings.corners[begin..end];
            match twice_area(ring) {
                0 => return Err(Error::EmptyClip),
                area if (area > 0) != (number == 0) => ring.reverse(),
                _ => {}
            }
            begin = end;
        }
        Ok(())
    }

    /// Refuses a hole outside the outer ring or inside another hole. Rings have no common place, so any corner tells.
    fn refuse_misplaced_holes(&self) -> Result<(), Error> {
        // If each hole lies in an odd number of other rings, each lies in the outer one alone: in a chain of nested
        // rings every second one, beginning with the outermost, lies in an even number, and no hole does.
        let is_misplaced = |ring: &usize| {
            let Range { start, end } = self.rings.ends[ring - 1]..self.rings.ends[*ring];
            !self.border.is_inside(&self.rings, self.rings.corners[start], start as u32..end as u32)
        };
        match (1..self.rings.ends.len()).find(is_misplaced) {
            Some(ring) => Err(Error::MisplacedHole { hole: ring - 1 }),
            None => Ok(()),
        }
    }

    /// The corners of all rings: those of the outer ring, counter-clockwise, then those of each hole, clockwise. Edge
    /// `k` leads from corner `k` to the next one of its ring.
    pub fn corners(&self) -> &[Point] {
        &self.rings.corners
    }

    /// The rings, in the order of their [`corners`](Self::corners): the outer one, then the holes.
    pub fn rings(&self) -> impl Iterator<Item = &[Point]> {
        let mut begin = 0;
        self.rings.ends.iter().map(move |&end| &self.rings.corners[core::mem::replace(&mut begin, end)..end])
    }

    /// Twice the area, exactly, in squares of the grid.
    pub fn twice_area(&self) -> i128 {
        self.rings().map(twice_area).sum()
    }

    /// The lower left and the upper right corner of the smallest rectangle around the polygon.
    pub fn bounds(&self) -> [Point; 2] {
        let (xs, ys) =
            (self.rings.corners.iter().map(|corner| corner.x), self.rings.corners.iter().map(|corner| corner.y));
        let low = Point::new(xs.clone().min().unwrap_or(0), ys.clone().min().unwrap_or(0));
        [low, Point::new(xs.max().unwrap_or(0), ys.max().unwrap_or(0))]
    }

    /// Whether the border may have a place in a box of doubles, which may be infinite.
    pub(crate) fn may_touch(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        self.border.may_touch(&self.rings, low, high)
    }

    /// Whether the polygon contains a point that is not on its border.
    pub(crate) fn contains(&self, point: Point) -> bool {
        self.border.is_inside(&self.rings, point, 0..0)
    }

    /// The corners in runs on one side of a line; see [`Border::sides`].
    pub(super) fn sides(&self, corners: [u32; 2], line: Bisector, add: impl FnMut([u32; 2], Ordering)) {
        self.border.sides(&self.rings, corners, line, add);
    }

    /// Refuses rings in which edges that are not consecutive meet, or consecutive ones overlap.
    fn refuse_crossings(&self) -> Result<(), Error> {
        for one in 0..self.rings.corners.len() {
            let meets = |other: u32| self.meet(one, other as usize);
            if let Some(other) = self.border.first_met(&self.rings, one as u32, meets) {
                return Err(Error::CrossedClip { one, other: other as usize });
            }
        }
        Ok(())
    }

    /// Whether two edges have a place in common that they should not have.
    fn meet(&self, one: usize, other: usize) -> bool {
        let ([a, b], [c, d]) = (self.rings.edge(one), self.rings.edge(other));
        if b == c || a == d {
            // Consecutive edges: they share more than the corner if they point back.
            let (from, middle, to) = if b == c { (a, b, d) } else { (c, a, b) };
            let (back, on) = (vector(middle, from), vector(middle, to));
            let is_consecutive = self.rings.next[one] as usize == other || self.rings.next[other] as usize == one;
            return !is_consecutive || (cross(back, on) == 0 && dot(back, on) > 0);
        }
        let apart = |[a, b]: [Point; 2], [c, d]: [Point; 2]| a.x.max(b.x) < c.x.min(d.x) || a.y.max(b.y) < c.y.min(d.y);
        if apart([a, b], [c, d]) || apart([c, d], [a, b]) {
            return false;
        }
        let sides = |a, b, c, d| orient2d(a, b, c).signum() * orient2d(a, b, d).signum() <= 0;
        sides(a, b, c, d) && sides(c, d, a, b)
    }
}

/// Twice the area of a ring, negative if it is clockwise.
fn twice_area(ring: &[Point]) -> i128 {
    ring.windows(2).map(|pair| i128::from(orient2d(ring[0], pair[0], pair[1]))).sum()
}
