//! The centre of mass of a cell over an image.
//!
//! **How.** With the mass `L` left of a place in its row, per height, the mass of a polygon is the integral of `L dy`
//! along its border, counter-clockwise (Green's theorem), and its moment in y that of `y L dy`. With the mass `B` below
//! a place in its column, the moment in x is the integral of `-x B dx`. Inside a pixel `L`, `B`, x and y are linear
//! along an edge, so twice the first integral and six times the others are sums of products of integers.
//!
//! **Where edges are cut.** An edge is cut wherever it crosses a border of pixels, and the cut is rounded down to 2^-4 of
//! a step. Rounding keeps cuts in their order along the edge and each piece in its pixel, because the borders are
//! integers. A cut depends on the line alone, not on its direction.

use super::centroid::BITS;
use super::density::{Density, PLACE_BITS};
use super::quotient::floor_quotient;
use crate::point::Point;

/// Twice the mass and six times the moments of polygons, seen from the lower left corner of the image, in 2^-4 of a
/// step. A side has up to 35 bits and a weight 16, so the sums have at most 88 and 125 with their signs.
pub(super) struct Masses<'a> {
    density: &'a Density,
    point: Point,
    mass: i128,
    moments: [i128; 2],
    low: [i64; 2],
    high: [i64; 2],
}

impl<'a> Masses<'a> {
    pub(super) fn new(density: &'a Density, point: Point) -> Self {
        Self { density, point, mass: 0, moments: [0; 2], low: [i64::MAX; 2], high: [i64::MIN; 2] }
    }

    /// Adds a polygon, counter-clockwise, with corners as seen from the point, in 2^-8 of a step.
    pub(super) fn add(&mut self, ring: &[[i64; 2]]) {
        let Some(&last) = ring.last() else { return };
        let mut from = self.place(last);
        for &corner in ring {
            let to = self.place(corner);
            self.low = core::array::from_fn(|axis| self.low[axis].min(to[axis]));
            self.high = core::array::from_fn(|axis| self.high[axis].max(to[axis]));
            self.add_edge(from, to);
            from = to;
        }
    }

    /// A corner as a place of the image.
    fn place(&self, corner: [i64; 2]) -> [i64; 2] {
        let [low, _] = self.density.bounds();
        let origin = [i64::from(self.point.x) - i64::from(low.x), i64::from(self.point.y) - i64::from(low.y)];
        [0, 1].map(|axis| {
            let place = (corner[axis] + (origin[axis] << BITS)) >> (BITS - PLACE_BITS);
            place.clamp(0, self.density.borders[axis].last().copied().unwrap_or(0))
        })
    }

    /// Adds an edge, pixel by pixel.
    fn add_edge(&mut self, from: [i64; 2], to: [i64; 2]) {
        let way = [to[0] - from[0], to[1] - from[1]];
        let mut pixel = [0, 1].map(|axis| self.first_pixel(axis, from[axis], way[axis]));
        let mut at = from;
        loop {
            // The next border in each direction, if the edge goes beyond it.
            let ahead = [0, 1].map(|axis| {
                let border = self.density.borders[axis][pixel[axis] + usize::from(way[axis] > 0)];
                let is_beyond = if way[axis] > 0 { to[axis] > border } else { to[axis] < border };
                (way[axis] != 0 && is_beyond).then_some(border)
            });
            let Some(axis) = first(ahead, from, way) else { break };
            let border = ahead[axis].unwrap_or_default();
            let across = 1 - axis;
            // Of 35 bits each, so products have 71.
            let (rise, run) = (i128::from(way[across]) * i128::from(border - from[axis]), i128::from(way[axis]));
            let (rise, run) = if run < 0 { (-rise, -run) } else { (rise, run) };
            let mut cut = [border; 2];
            cut[across] = from[across] + floor_quotient(rise, run) as i64;
            self.add_piece(at, cut, pixel);
            at = cut;
            pixel[axis] = if way[axis] > 0 { pixel[axis] + 1 } else { pixel[axis] - 1 };
        }
        self.add_piece(at, to, pixel);
    }

    /// The pixel, along an axis, in which an edge that goes this way begins.
    fn first_pixel(&self, axis: usize, from: i64, way: i64) -> usize {
        let borders = &self.density.borders[axis];
        let behind = if way < 0 {
            borders.partition_point(|&border| border < from)
        } else {
            borders.partition_point(|&border| border <= from)
        };
        behind.saturating_sub(1).min(borders.len() - 2)
    }

    /// Adds a piece of an edge inside a pixel.
    fn add_piece(&mut self, from: [i64; 2], to: [i64; 2], pixel: [usize; 2]) {
        let [dx, dy] = [0, 1].map(|axis| i128::from(to[axis] - from[axis]));
        let [[x0, y0], [x1, y1]] = [from, to].map(|place| place.map(i128::from));
        if dy != 0 {
            let [l0, l1] = [from, to].map(|place| self.density.left_of(place[0], pixel));
            self.mass += dy * (l0 + l1);
            self.moments[1] = self.moments[1].wrapping_add(dy * (l0 * (2 * y0 + y1) + l1 * (y0 + 2 * y1)));
        }
        if dx != 0 {
            let [b0, b1] = [from, to].map(|place| self.density.below(place[1], pixel));
            self.moments[0] = self.moments[0].wrapping_sub(dx * (b0 * (2 * x0 + x1) + b1 * (x0 + 2 * x1)));
        }
    }

    /// The grid point nearest to the centre of mass, halves upwards; the point itself if there is no mass.
    pub(super) fn center(&self) -> Point {
        if self.mass <= 0 {
            return self.point;
        }
        // Three times twice the mass, in units of a grid step.
        let divisor = (3 * self.mass) << PLACE_BITS;
        let [low, _] = self.density.bounds();
        let round = |value: i64| (value + (1 << (PLACE_BITS - 1))) >> PLACE_BITS;
        let moved = |value: u32, axis: usize| {
            let offset = floor_quotient(2 * self.moments[axis] + divisor, 2 * divisor);
            // The rounded corners of a cell that is thinner than a share of a step can have a centre outside their box.
            let inside = offset.clamp(round(self.low[axis]).into(), round(self.high[axis]).into());
            (i128::from(value) + inside).clamp(0, (1 << 31) - 1) as u32
        };
        Point::new(moved(low.x, 0), moved(low.y, 1))
    }
}

/// The axis along which a border comes first on an edge; that of x if both come at one place.
fn first(ahead: [Option<i64>; 2], from: [i64; 2], way: [i64; 2]) -> Option<usize> {
    match ahead {
        [None, None] => None,
        [Some(_), None] => Some(0),
        [None, Some(_)] => Some(1),
        [Some(x), Some(y)] => {
            // Shares of the way, both positive: their numerators and denominators are made positive.
            let share =
                |axis: usize, border: i64| [border.abs_diff(from[axis]), way[axis].unsigned_abs()].map(u128::from);
            let ([n, d], [m, e]) = (share(0, x), share(1, y));
            Some(usize::from(n * e > m * d))
        }
    }
}
