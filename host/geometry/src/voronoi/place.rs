//! Places of a clipped cell, kept as the lines that meet there, and the exact questions about them.
//!
//! All questions are asked by a point `p` that sees the plane from its own place. The border between the cells of `p`
//! and `q` is the line `2 v · x = v · v` with `v = q - p`. It is followed in the direction `v` turned by a quarter to
//! the left, so that `p` is on its left, and a position on it is a multiple of that vector from the middle between `p`
//! and `q`. With coordinates below 2^31, all numerators and denominators below are less than 2^66, and two products of
//! two of them are compared.

use core::cmp::Ordering;

use super::corner::{center_seen, cross, dot, vector, Corner};
use super::wide::{compare_fractions, compare_products};
use crate::point::Point;
use crate::predicate::incircle;

/// A place, by the lines that meet there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// A corner of the clip.
    Corner(Point),
    /// The place where the edge of the clip from the first to the second point meets the border with the third.
    Crossing([Point; 3]),
    /// The place where the borders with two points meet: the centre of their circle with `p`.
    Center([Point; 2]),
}

/// The sum of two numbers that together may have 65 bits.
fn sum(one: i64, other: i64) -> i128 {
    i128::from(one) + i128::from(other)
}

/// The position of the crossing with the border between `p` and `q` along the edge from `a` to `b`: a fraction of the
/// edge. The denominator is zero if edge and border are parallel.
fn along(p: Point, [a, b, q]: [Point; 3]) -> [i128; 2] {
    let v = vector(p, q);
    let numerator = i128::from(dot(v, v)) - 2 * i128::from(dot(v, vector(p, a)));
    [numerator, 2 * i128::from(dot(v, vector(a, b)))]
}

impl Place {
    /// The place where the borders of `p` with two points meet.
    pub(super) fn center(p: Point, [one, other]: [Point; 2]) -> Self {
        // The centre of a circle does not depend on the order, but predicates want triangles counter-clockwise.
        if cross(vector(p, one), vector(p, other)) > 0 {
            Self::Center([one, other])
        } else {
            Self::Center([other, one])
        }
    }

    /// Whether the place is nearer to `p` than to `q` (`Greater`), as near (`Equal`) or farther (`Less`).
    pub(super) fn side(self, p: Point, q: Point) -> Ordering {
        match self {
            Self::Corner(corner) => {
                let (v, to) = (vector(p, q), vector(p, corner));
                i128::from(dot(v, v)).cmp(&(2 * i128::from(dot(v, to))))
            }
            // The circle around the place through `p` has `q` outside.
            Self::Center([one, other]) => 0.cmp(&incircle(p, one, other, q)),
            Self::Crossing([a, b, other]) => {
                let ([n, d], [m, e]) = (along(p, [a, b, other]), along(p, [a, b, q]));
                // Along the edge the border with `q` is `m - s e`, which is positive near `p`, and here `s` is `n / d`.
                let order = compare_products([m, d], [n, e]);
                if d < 0 {
                    order.reverse()
                } else {
                    order
                }
            }
        }
    }

    /// The position of the place on the border between `p` and `q`, on which it lies, as a fraction.
    pub(super) fn position(self, p: Point, q: Point) -> [i128; 2] {
        let v = vector(p, q);
        let turned = [-v[1], v[0]];
        match self {
            Self::Corner(corner) => [dot(turned, vector(p, corner)).into(), dot(v, v).into()],
            Self::Crossing([a, b, _]) => {
                let edge = vector(a, b);
                let twice = [0, 1].map(|axis| vector(p, a)[axis] + vector(q, a)[axis]);
                // Components of `twice` have 33 bits, so the two products are added in 128 bits.
                let numerator = i128::from(twice[0] * edge[1]) - i128::from(twice[1] * edge[0]);
                [numerator, 2 * i128::from(cross(turned, edge))]
            }
            Self::Center([one, other]) => {
                // At least one of the two does not lie in the direction of `q`.
                let across = |point: Point| dot(vector(p, point), turned);
                let chosen = if across(one) != 0 { one } else { other };
                let w = vector(p, chosen);
                [sum(dot(w, w), -dot(w, v)), 2 * i128::from(dot(w, turned))]
            }
        }
    }

    /// Compares the positions of two places on the border between `p` and `q`.
    pub(super) fn compare_positions(self, other: Self, p: Point, q: Point) -> Ordering {
        compare_fractions(self.position(p, q), other.position(p, q))
    }

    /// The exact coordinates.
    pub(super) fn corner(self, p: Point) -> Corner {
        match self {
            Self::Corner(corner) => Corner::of_point(corner),
            Self::Center([one, other]) => Corner::of_center([p, one, other]),
            Self::Crossing(lines @ [a, ..]) => {
                let (from_a, d) = Self::from_corner(p, lines);
                let at = |origin: u32, seen: i128| i128::from(origin) * i128::from(d) + seen;
                Corner { x: at(a.x, from_a[0]), y: at(a.y, from_a[1]), d }
            }
        }
    }

    /// A crossing as seen from the corner of the clip at which the edge begins: numerators, then the denominator.
    fn from_corner(p: Point, lines: [Point; 3]) -> ([i128; 2], u64) {
        let [n, d] = along(p, lines);
        let n = if d < 0 { -n } else { n };
        let edge = vector(lines[0], lines[1]);
        // Twice a dot product of vectors between grid points is below 2^64.
        (edge.map(|length| n * i128::from(length)), (d.unsigned_abs() as u64).max(1))
    }

    /// The place as seen from `p`, in doubles: each coordinate is off by at most three roundings of itself.
    pub(super) fn seen(self, p: Point) -> [f64; 2] {
        match self {
            Self::Corner(corner) => vector(p, corner).map(|length| length as f64),
            Self::Center([one, other]) => {
                let (seen, d) = center_seen([p, one, other]);
                seen.map(|length| length as f64 / d as f64)
            }
            Self::Crossing(lines @ [a, ..]) => {
                let (from_a, d) = Self::from_corner(p, lines);
                let to_a = vector(p, a);
                [0, 1].map(|axis| (from_a[axis] + i128::from(to_a[axis]) * i128::from(d)) as f64 / d as f64)
            }
        }
    }
}
