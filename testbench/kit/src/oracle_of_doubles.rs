//! The canonical Delaunay triangulation of points of doubles by its definition, in integers of any size: for small
//! sets, and for nothing but comparison.

use std::cmp::Ordering;

use num_bigint::BigInt;

/// A point in multiples of the smallest double, 2^-1074: every double is one. The order is lexicographic.
type Exact = [BigInt; 2];

fn exact(point: [f64; 2]) -> Exact {
    point.map(|value| {
        assert!(value.is_finite(), "{value} is no finite coordinate");
        let (bits, biased) = (value.to_bits(), (value.to_bits() >> 52 & 0x7ff) as u32);
        let fraction = bits & ((1 << 52) - 1);
        let magnitude = match biased {
            0 => BigInt::from(fraction),
            _ => BigInt::from(fraction | 1 << 52) << (biased - 1),
        };
        if value < 0.0 {
            -magnitude
        } else {
            magnitude
        }
    })
}

fn zero() -> BigInt {
    BigInt::ZERO
}

fn cross(from: &Exact, one: &Exact, other: &Exact) -> BigInt {
    (&one[0] - &from[0]) * (&other[1] - &from[1]) - (&one[1] - &from[1]) * (&other[0] - &from[0])
}

/// The determinant whose sign says whether `d` lies inside the circle of the counter-clockwise `a`, `b`, `c`.
fn lifted(a: &Exact, b: &Exact, c: &Exact, d: &Exact) -> BigInt {
    let lift = |point: &Exact| {
        let [x, y] = [0, 1].map(|axis| &point[axis] - &d[axis]);
        &x * &x + &y * &y
    };
    lift(a) * cross(d, b, c) + lift(b) * cross(d, c, a) + lift(c) * cross(d, a, b)
}

/// Twice the signed area of `a`, `b`, `c`, compared with zero: `Greater` if the three turn counter-clockwise.
pub fn orient2d_of_doubles(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Ordering {
    cross(&exact(a), &exact(b), &exact(c)).cmp(&zero())
}

/// `Greater` if `d` lies inside the circle of the counter-clockwise triangle `a`, `b`, `c`, `Equal` if on the circle.
pub fn incircle_of_doubles(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> Ordering {
    lifted(&exact(a), &exact(b), &exact(c), &exact(d)).cmp(&zero())
}

/// Whether the closed circumscribed disc of a triangle touches none of four lines and lies between them all: `x =
/// west`, `x = east`, `y = south`, `y = north`, in this order. A line that is `None` is infinitely far away. Three
/// points on a line have no disc, so the answer is no.
pub fn disc_is_between([a, b, c]: [[f64; 2]; 3], lines: [Option<f64>; 4]) -> bool {
    let [a, b, c] = [a, b, c].map(exact);
    let (b, c) = if cross(&a, &b, &c) < zero() { (c, b) } else { (b, c) };
    // Centre and radius, in fractions with this denominator.
    let denominator: BigInt = cross(&a, &b, &c) * 2;
    if denominator == zero() {
        return false;
    }
    let norm = |point: &Exact| &point[0] * &point[0] + &point[1] * &point[1];
    let center_of = |axis: usize| {
        let gap = |one: &Exact, other: &Exact| match axis {
            0 => &one[1] - &other[1],
            _ => &other[0] - &one[0],
        };
        norm(&a) * gap(&b, &c) + norm(&b) * gap(&c, &a) + norm(&c) * gap(&a, &b)
    };
    let center = [center_of(0), center_of(1)];
    let radius: Exact = [0, 1].map(|axis| &center[axis] - &a[axis] * &denominator);
    let is_clear = |(place, line): (usize, &Option<f64>)| {
        let Some(line) = *line else { return true };
        let [line, _] = exact([line, 0.0]);
        let beyond = line * &denominator - &center[place / 2];
        let room = if place % 2 == 0 { -beyond } else { beyond };
        room > zero() && &room * &room > norm(&radius)
    };
    lines.iter().enumerate().all(is_clear)
}

/// Whether `d` conflicts with the counter-clockwise triangle, ties decided by lowering the smallest of the four.
fn conflicts(a: &Exact, b: &Exact, c: &Exact, d: &Exact) -> bool {
    match lifted(a, b, c, d).cmp(&zero()) {
        Ordering::Greater => return true,
        Ordering::Less => return false,
        Ordering::Equal => {}
    }
    let smallest = [a, b, c, d].into_iter().min().expect("four points");
    let is_negative = |value: BigInt| value < zero();
    // Lowering a corner changes the determinant by minus the factor of the corner's lift. Lowering
    // `d` moves `d` inside.
    if smallest == a {
        is_negative(cross(d, b, c))
    } else if smallest == b {
        is_negative(cross(d, c, a))
    } else if smallest == c {
        is_negative(cross(d, a, b))
    } else {
        true
    }
}

/// The places of the first point of each place in the plane, and all points as integers.
fn distinct(points: &[[f64; 2]]) -> (Vec<usize>, Vec<Exact>) {
    let exact: Vec<Exact> = points.iter().map(|&point| exact(point)).collect();
    let is_first = |place: &usize| exact.iter().position(|point| *point == exact[*place]) == Some(*place);
    ((0..points.len()).filter(is_first).collect(), exact)
}

/// The canonical triangles of points with finite coordinates: all counter-clockwise triples that no
/// point conflicts with. O(n^4).
///
/// Corners are places in `points`, the smallest first, and the list is sorted. Of equal points the first
/// counts; -0 equals 0.
///
/// # Panics
/// If a coordinate is infinite or not a number.
pub fn delaunay_of_doubles(points: &[[f64; 2]]) -> Vec<[u32; 3]> {
    let (distinct, exact) = distinct(points);
    let mut triangles = Vec::new();
    for (done, &i) in distinct.iter().enumerate() {
        for &j in &distinct[done + 1..] {
            for &k in &distinct[done + 1..] {
                if j == k || cross(&exact[i], &exact[j], &exact[k]) <= zero() {
                    continue;
                }
                let is_harmless =
                    |&m: &usize| [i, j, k].contains(&m) || !conflicts(&exact[i], &exact[j], &exact[k], &exact[m]);
                if distinct.iter().all(is_harmless) {
                    triangles.push([i as u32, j as u32, k as u32]);
                }
            }
        }
    }
    triangles.sort_unstable();
    triangles
}

/// The canonical hull of points that do not all lie on one line: every point on the boundary of the convex hull,
/// counter-clockwise from the lowest place in `points` on. For points on one line the points
/// in lexicographic order. O(n³).
pub fn hull_of_doubles(points: &[[f64; 2]]) -> Vec<u32> {
    let (mut distinct, exact) = distinct(points);
    let turn = |a: usize, b: usize, c: usize| cross(&exact[a], &exact[b], &exact[c]).cmp(&zero());
    let is_line = distinct.len() < 3 || distinct.iter().all(|&c| turn(distinct[0], distinct[1], c).is_eq());
    if is_line {
        distinct.sort_by(|&one, &other| exact[one].cmp(&exact[other]));
        return distinct.into_iter().map(|place| place as u32).collect();
    }
    let lies_between = |a: usize, b: usize, c: usize| {
        let (low, high) = if exact[a] < exact[b] { (a, b) } else { (b, a) };
        exact[low] < exact[c] && exact[c] < exact[high]
    };
    // An edge of the hull has no point to its right, and no other point on it.
    let is_edge = |a: usize, b: usize| {
        a != b
            && distinct.iter().all(|&c| match turn(a, b, c) {
                Ordering::Less => false,
                Ordering::Equal => !lies_between(a, b, c),
                Ordering::Greater => true,
            })
    };
    let next = |a: usize| distinct.iter().copied().find(|&b| is_edge(a, b));
    let first = distinct.iter().copied().find(|&a| next(a).is_some()).expect("a hull");
    let mut hull = vec![first as u32];
    let mut at = next(first).expect("an edge");
    while at != first {
        hull.push(at as u32);
        at = next(at).expect("an edge");
    }
    hull
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{delaunay, SplitMix64};

    #[test]
    fn whole_numbers_have_the_triangles_of_the_oracle_of_integers() {
        let mut random = SplitMix64::new(9);
        for round in 0..60 {
            let points: Vec<[u32; 2]> = random.points(8, 2 + round % 5);
            let doubles: Vec<[f64; 2]> =
                points.iter().map(|point| point.map(|value| f64::from(value) * 0.125 - 0.25)).collect();
            assert_eq!(delaunay_of_doubles(&doubles), delaunay(&points), "{points:?}");
        }
    }

    #[test]
    fn the_hull_has_all_points_on_its_edges() {
        let square = [[0.5, 0.0], [1.0, 1.0], [0.0, 0.0], [1.0, 0.0], [0.4, 0.5], [0.0, 1.0], [0.5, -0.0]];
        assert_eq!(hull_of_doubles(&square), [0, 3, 1, 5, 2]);
        assert_eq!(hull_of_doubles(&[[0.3, 0.3], [-0.1, -0.1], [0.2, 0.2]]), [1, 2, 0]);
    }

    #[test]
    fn signs_see_the_last_bit() {
        let third = [0.1, 0.1f64.next_up()];
        assert_eq!(orient2d_of_doubles([0.0, 0.0], [0.3, 0.3], third), Ordering::Greater);
        assert_eq!(incircle_of_doubles([0.0, 0.0], [1e300, 0.0], [1e300, 1e300], [0.0, 1e300]), Ordering::Equal);
    }

    #[test]
    fn a_disc_must_not_touch_a_line() {
        // The circle has the centre (1, 1) and the radius 1.
        let corners = [[0.0, 1.0], [1.0, 0.0], [1.6, 1.8]];
        let disc_ends = |corners, line: usize, at: f64| {
            let mut lines = [None; 4];
            lines[line] = Some(at);
            disc_is_between(corners, lines)
        };
        let exact = [[0.0, 1.0], [1.0, 0.0], [1.0, 2.0]];
        for turned in [exact, [exact[0], exact[2], exact[1]]] {
            for (line, touched, clear) in
                [(0, 0.0, -5e-324), (1, 2.0, 2f64.next_up()), (2, 0.0, -5e-324), (3, 2.0, 2f64.next_up())]
            {
                assert!(!disc_ends(turned, line, touched) && disc_ends(turned, line, clear), "{line}");
            }
            assert!(!disc_ends(turned, 1, -9.0) && !disc_ends(turned, 0, 9.0));
        }
        // 1.6 and 1.8 are rounded, and the third corner with them.
        assert!(disc_ends(corners, 1, 2.0 + 1e-12) && !disc_ends(corners, 1, 2.0 - 1e-12));
        assert!(!disc_is_between([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], [None; 4]));
    }
}
