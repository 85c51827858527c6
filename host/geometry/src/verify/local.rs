//! The tests of the validator one by one, for programs that hold only a part of a mesh at a time.
//!
//! [`verify`](fn@crate::verify) needs all points and triangles in one memory. A program for larger meshes brings the
//! points of each triangle and the sides of each edge together in its own way, for instance by sorting files, and calls
//! these tests. `verify` calls the same ones, so both name the same defect. The points are those of a grid.
//!
//! A list of triangles is the canonical mesh of the points if
//! - [`Placed::check`] holds for each triangle, all of whose corners exist and are the lowest index of their place;
//! - [`check_count`] holds, and each distinct point is a corner of some triangle;
//! - [`check_sides`] holds for each edge, and each edge of the hull has a triangle;
//! - [`check_inner_edge`] holds for each edge of two triangles.
//!
//! ```
//! use incircle_geometry::verify::local::{check_inner_edge, check_sides, Placed, Side};
//! use incircle_geometry::{Point, VerifyError};
//!
//! let square = [(0, 0), (2, 0), (2, 2), (0, 2)].map(Point::from);
//! let placed = |triangle: usize, corners: [u32; 3]| {
//!     Placed { triangle, corners, points: corners.map(|corner| square[corner as usize]) }
//! };
//! let (one, other) = (placed(0, [0, 1, 2]), placed(1, [0, 2, 3]));
//! // Twice the area of each.
//! assert_eq!([one.check(None)?, other.check(Some(one.corners))?], [4, 4]);
//! let sides = [Side { of: one, corner: 2 }, Side { of: other, corner: 0 }];
//! assert_eq!(sides.map(|side| side.ends()), [[2, 0], [0, 2]]);
//! check_sides(&sides, None)?;
//! assert!(check_inner_edge(&sides[0], &sides[1])?, "all four points are on one circle");
//! # Ok::<(), VerifyError>(())
//! ```

use core::cmp::Ordering;

use super::error::VerifyError;
use super::exact::ExactPoint;
use crate::point::Point;

/// A triangle of a list, with the places of its corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placed {
    /// Number of the triangle in the list, from 0 on. Errors name it.
    pub triangle: usize,
    /// The corners, as indices of points.
    pub corners: [u32; 3],
    /// The points at these indices.
    pub points: [Point; 3],
}

impl Placed {
    /// Checks that the triangle turns counter-clockwise, starts with its smallest index, and sorts behind `before`, the
    /// triangle that stands before it in the list. Returns twice its area.
    ///
    /// # Errors
    /// The first of these that does not hold, in this order.
    pub fn check(&self, before: Option<[u32; 3]>) -> Result<i128, VerifyError> {
        let area = check_shape(self.triangle, self.corners, self.points, before)?;
        Ok(area.unwrap_or_default())
    }
}

/// One side of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// The triangle on this side.
    pub of: Placed,
    /// The corner at which the side begins: 0, 1 or 2. It runs to the next corner.
    pub corner: usize,
}

impl Side {
    /// The two points of the side, as indices: its origin, then its end.
    pub fn ends(&self) -> [u32; 2] {
        [self.turned(0), self.turned(1)]
    }

    fn turned(&self, step: usize) -> u32 {
        self.of.corners[(self.corner + step) % 3]
    }

    fn point(&self, step: usize) -> Point {
        self.of.points[(self.corner + step) % 3]
    }
}

/// Checks that the sides of one edge fit. `sides` has at least the first three, in the order of their triangles in the
/// list; further ones change nothing. `hull` has the ends of the edge in the direction of the hull, counter-clockwise,
/// if the edge is on the hull.
///
/// # Errors
/// The only side is not on the hull, or two sides run the same way.
pub fn check_sides(sides: &[Side], hull: Option<[u32; 2]>) -> Result<(), VerifyError> {
    if let [only] = sides {
        return check_only_side(only.of.triangle, only.ends(), hull);
    }
    check_directions(sides.len(), |place| (sides[place].of.triangle, sides[place].ends()))
}

/// Checks that the edge between two triangles is locally Delaunay, ties by the tie rule. `one` is the side whose triangle
/// comes first in the list. Returns true for a tie.
///
/// # Errors
/// A point lies inside the circle of the other triangle, or the tie rule asks for the other diagonal.
pub fn check_inner_edge(one: &Side, other: &Side) -> Result<bool, VerifyError> {
    let corners = [one.turned(0), one.turned(1), one.turned(2), other.turned(2)];
    check_circle(one.of.triangle, corners, [one.point(0), one.point(1), one.point(2), other.point(2)])
}

/// Checks Euler's formula: a triangulation of n distinct points with h of them on the hull has 2n - 2 - h triangles. The
/// points must not lie on one line.
///
/// # Errors
/// There are more or fewer triangles.
pub fn check_count(triangles: usize, distinct: usize, hull: usize) -> Result<(), VerifyError> {
    let expected = (2 * distinct).saturating_sub(2 + hull);
    if triangles == expected {
        return Ok(());
    }
    Err(VerifyError::TriangleCount { found: triangles, expected, distinct, hull })
}

/// Checks that the areas of all triangles sum to that of the hull. Both are twice the area; that of the hull is the sum
/// of [`sector`] over its edges.
///
/// # Errors
/// The sums differ.
pub fn check_area(triangles: i128, hull: i128) -> Result<(), VerifyError> {
    if triangles == hull {
        return Ok(());
    }
    Err(VerifyError::Area { triangles, hull })
}

/// The turn from `a` over `b` to `c`: `Greater` if the three turn left, `Equal` on one line.
pub fn turn(a: Point, b: Point, c: Point) -> Ordering {
    Point::orient2d(a, b, c)
}

/// Twice the signed area of the triangle of the origin and two points.
pub fn sector(from: Point, to: Point) -> i128 {
    Point::orient2d_value(None, from, to).unwrap_or_default()
}

/// Checks a triangle by itself and its place behind another one; returns twice its area, if the numbers allow it.
pub(super) fn check_shape<P: ExactPoint>(
    triangle: usize,
    corners: [u32; 3],
    [a, b, c]: [P; 3],
    before: Option<[u32; 3]>,
) -> Result<Option<i128>, VerifyError> {
    if P::orient2d(a, b, c).is_le() {
        return Err(VerifyError::NotCounterClockwise { triangle, corners });
    }
    if corners[0] > corners[1] || corners[0] > corners[2] {
        return Err(VerifyError::NotRotated { triangle, corners });
    }
    match before.map(|before| before.cmp(&corners)) {
        Some(Ordering::Equal) => Err(VerifyError::DoubledTriangle { triangle, corners }),
        Some(Ordering::Greater) => Err(VerifyError::NotSorted { triangle, corners }),
        _ => Ok(P::orient2d_value(Some(a), b, c)),
    }
}

/// Checks that an edge with one triangle runs along the hull.
pub(super) fn check_only_side(triangle: usize, edge: [u32; 2], hull: Option<[u32; 2]>) -> Result<(), VerifyError> {
    if hull == Some(edge) {
        return Ok(());
    }
    Err(VerifyError::OpenEdge { triangle, edge })
}

/// Refuses two sides of one edge that run the same way. Among three or more sides there are always two such. `side` gives
/// the triangle and the ends of the side at a place.
pub(super) fn check_directions(count: usize, side: impl Fn(usize) -> (usize, [u32; 2])) -> Result<(), VerifyError> {
    for later in 0..count {
        let (other, edge) = side(later);
        if let Some((one, _)) = (0..later).map(&side).find(|(_, twin)| *twin == edge) {
            return Err(VerifyError::SameSide { one, other, edge });
        }
    }
    Ok(())
}

/// Checks the edge from the first to the second of four points: the third makes a counter-clockwise triangle with both,
/// and the fourth lies beyond the edge. Returns true for a tie.
pub(super) fn check_circle<P: ExactPoint>(
    triangle: usize,
    [a, b, c, d]: [u32; 4],
    points: [P; 4],
) -> Result<bool, VerifyError> {
    let [at_a, at_b, at_c, at_d] = points;
    match P::incircle(at_a, at_b, at_c, at_d) {
        Ordering::Less => Ok(false),
        Ordering::Greater => Err(VerifyError::NotDelaunay { triangle, point: d, edge: [a, b] }),
        Ordering::Equal => {
            let corners = [(a, at_a), (d, at_d), (b, at_b), (c, at_c)];
            let smallest = corners.into_iter().min_by(|(_, one), (_, other)| one.compare(other));
            match smallest {
                Some((smallest, _)) if smallest != a && smallest != b => {
                    Err(VerifyError::WrongTie { corners: corners.map(|(index, _)| index), edge: [a, b], smallest })
                }
                _ => Ok(true),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [(u32, u32); 4] = [(0, 0), (4, 0), (4, 4), (0, 4)];

    fn placed(triangle: usize, corners: [u32; 3]) -> Placed {
        Placed { triangle, corners, points: corners.map(|corner| SQUARE[corner as usize].into()) }
    }

    #[test]
    fn a_triangle_is_checked_in_the_order_of_the_list() {
        assert_eq!(placed(3, [0, 1, 2]).check(Some([0, 1, 1])), Ok(16));
        let corners = [0, 2, 1];
        assert_eq!(placed(3, corners).check(None), Err(VerifyError::NotCounterClockwise { triangle: 3, corners }));
        let corners = [1, 2, 0];
        assert_eq!(placed(3, corners).check(None), Err(VerifyError::NotRotated { triangle: 3, corners }));
        let corners = [0, 1, 2];
        let doubled = placed(3, corners).check(Some(corners));
        assert_eq!(doubled, Err(VerifyError::DoubledTriangle { triangle: 3, corners }));
        let late = placed(3, corners).check(Some([0, 1, 3]));
        assert_eq!(late, Err(VerifyError::NotSorted { triangle: 3, corners }));
    }

    #[test]
    fn an_edge_has_two_sides_or_one_on_the_hull() {
        let (one, other) = (placed(0, [0, 1, 3]), placed(1, [1, 2, 3]));
        let inner = [Side { of: one, corner: 1 }, Side { of: other, corner: 2 }];
        assert_eq!(check_sides(&inner, None), Ok(()));
        let due = VerifyError::WrongTie { corners: [1, 2, 3, 0], edge: [1, 3], smallest: 0 };
        assert_eq!(check_inner_edge(&inner[0], &inner[1]), Err(due));
        let rim = [Side { of: one, corner: 0 }];
        assert_eq!(check_sides(&rim, Some([0, 1])), Ok(()));
        let open = VerifyError::OpenEdge { triangle: 0, edge: [0, 1] };
        assert_eq!(check_sides(&rim, None), Err(open.clone()));
        assert_eq!(check_sides(&rim, Some([1, 0])), Err(open));
        let same = VerifyError::SameSide { one: 0, other: 2, edge: [1, 3] };
        let third = Side { of: Placed { triangle: 2, ..one }, corner: 1 };
        assert_eq!(check_sides(&[inner[0], inner[1], third], None), Err(same));
    }

    #[test]
    fn sums_are_compared() {
        let points = SQUARE.map(Point::from);
        let hull: i128 = (0..4).map(|k| sector(points[k], points[(k + 1) % 4])).sum();
        assert_eq!((check_area(32, hull), check_count(2, 4, 4)), (Ok(()), Ok(())));
        assert!(check_area(31, hull).is_err() && check_count(3, 4, 4).is_err());
        assert_eq!(turn(points[0], points[1], points[2]), Ordering::Greater);
    }
}
