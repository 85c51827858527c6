//! The order of insertion, in a buffer of indices: along the Hilbert curve, without duplicates, a triangle first, and a
//! run of the curve for each context of the core.
//!
//! Each function works in place. The position along the curve is computed bit by bit, without the table of
//! `incircle-geometry`, which would take 2 kB of flash.

use core::cmp::Ordering;

use incircle_protocol::FIRST_ROUND;

use crate::sort::sort_by;
use crate::Point;

/// The place in an order from which points belong to all contexts in turn.
const FIRST: usize = FIRST_ROUND as usize;

/// The position of a point along the Hilbert curve of order 16. Source: Hilbert, *Über die stetige Abbildung einer
/// Linie auf ein Flächenstück*, 1891.
pub(crate) fn hilbert([x, y]: Point) -> u32 {
    let (mut x, mut y) = (x, y);
    let mut position = 0;
    for bit in (0..u16::BITS).rev() {
        let (right, up) = (x >> bit & 1, y >> bit & 1);
        position = position << 2 | u32::from((3 * right) ^ up);
        if up == 0 {
            // The copy of the curve in this quadrant has its axes swapped, and runs backwards on the right.
            if right == 1 {
                (x, y) = (!x, !y);
            }
            (x, y) = (y, x);
        }
    }
    position
}

/// Twice the signed area of a triangle: positive if it turns left.
pub(crate) fn orient2d(a: Point, b: Point, c: Point) -> i64 {
    let difference = |p: Point, axis: usize| i64::from(p[axis]) - i64::from(a[axis]);
    difference(b, 0) * difference(c, 1) - difference(b, 1) * difference(c, 0)
}

/// The point with this index. Every index of an order is one of a point.
pub(crate) fn at(points: &[Point], index: u16) -> Point {
    points.get(usize::from(index)).copied().unwrap_or_default()
}

/// The order of the distinct points.
pub(crate) struct Order {
    /// Number of distinct points. The indices of the others stand behind them, sorted.
    pub distinct: usize,
    /// Whether all points lie on one line. Then the order is lexicographic.
    pub is_collinear: bool,
}

/// Fills `order` with the indices of the points, and puts them in order. Both have the same length, at most 65,536.
/// O(n log n).
pub(crate) fn prepare(points: &[Point], order: &mut [u16]) -> Order {
    for (place, index) in order.iter_mut().zip(0..=u16::MAX) {
        *place = index;
    }
    sort_by(order, |a, b| (hilbert(at(points, a)), a) < (hilbert(at(points, b)), b));
    let distinct = take_out_duplicates(points, order);
    let (kept, duplicates) = order.split_at_mut(distinct);
    sort_by(duplicates, |a, b| a < b);
    let is_collinear = !start_with_a_triangle(points, kept);
    if is_collinear {
        sort_by(kept, |a, b| at(points, a) < at(points, b));
    }
    Order { distinct, is_collinear }
}

/// Moves the indices of duplicates behind the others, and returns the number of the others. Equal points stand together
/// in `order`, the lowest index first.
fn take_out_duplicates(points: &[Point], order: &mut [u16]) -> usize {
    let mut kept = 0;
    let mut last = None;
    for place in 0..order.len() {
        let point = order.get(place).map(|&index| at(points, index));
        if point != last {
            order.swap(kept, place);
            kept += 1;
            last = point;
        }
    }
    kept
}

/// Moves the first point off the line of the first two to the third place. Returns false if there is none.
fn start_with_a_triangle(points: &[Point], order: &mut [u16]) -> bool {
    let &mut [first, second, ..] = order else { return false };
    let (a, b) = (at(points, first), at(points, second));
    match order.iter().position(|&index| orient2d(a, b, at(points, index)) != 0) {
        // Points between move up by one place, so that they stay along the curve.
        Some(third) => {
            (3..=third).rev().for_each(|place| order.swap(place, place - 1));
            true
        }
        None => false,
    }
}

/// The place in the order of the point that the device gets as number `arrival` of `count`, with this many contexts.
///
/// Context 0 takes the first 16 points, and number `j` from there on belongs to context `(j - 16) mod contexts`. The
/// points of context `c` are the `c`-th run of the order, so that contexts work far apart and seldom meet.
pub(crate) const fn place_of(arrival: usize, count: usize, contexts: usize) -> usize {
    if arrival < FIRST || contexts < 2 || count <= FIRST {
        return arrival;
    }
    let (turn, context) = ((arrival - FIRST) / contexts, (arrival - FIRST) % contexts);
    let (length, longer) = ((count - FIRST) / contexts, (count - FIRST) % contexts);
    let runs_before = context * length + if context < longer { context } else { longer };
    FIRST + runs_before + turn
}

/// Turns a triangle to begin with its smallest index.
pub(crate) fn smallest_first([a, b, c]: [u16; 3]) -> [u16; 3] {
    match (a.cmp(&b), b.cmp(&c), c.cmp(&a)) {
        (Ordering::Less, _, Ordering::Greater) => [a, b, c],
        (Ordering::Greater, Ordering::Less, _) => [b, c, a],
        _ => [c, a, b],
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use incircle::order;
    use incircle_testkit::SplitMix64;
    use std::vec;
    use std::vec::Vec;

    fn random(count: usize, side: u32) -> Vec<Point> {
        let mut random = SplitMix64::new(count as u64);
        (0..count).map(|_| [random.below_u32(side) as u16, random.below_u32(side) as u16]).collect()
    }

    #[test]
    fn the_curve_is_that_of_the_library() {
        let points = random(3000, 1 << 16);
        let wide: Vec<incircle::Point> =
            points.iter().map(|&[x, y]| incircle::Point::new(x.into(), y.into())).collect();
        let mut ours: Vec<u32> = (0..3000).collect();
        ours.sort_by_key(|&index| hilbert(points[index as usize]));
        assert_eq!(ours, order::hilbert(&wide));
    }

    #[test]
    fn every_distinct_point_is_there_once_under_its_lowest_index() {
        for count in 0..200 {
            let points = random(count, 12);
            let mut order = vec![0; count];
            let Order { distinct, is_collinear } = prepare(&points, &mut order);
            let lowest = |index: u16| points.iter().position(|p| *p == points[usize::from(index)]);
            for (place, &index) in order.iter().enumerate() {
                assert_eq!(lowest(index) == Some(index.into()), place < distinct);
            }
            assert!(order[distinct..].is_sorted());
            if !is_collinear {
                let [a, b, c] = [0, 1, 2].map(|place| points[usize::from(order[place])]);
                assert_ne!(orient2d(a, b, c), 0);
            }
            order.sort_unstable();
            assert!(order.iter().copied().eq(0..count as u16));
        }
    }

    #[test]
    fn lines_are_found_and_sorted() {
        let points = [[6, 3], [2, 1], [4, 2], [2, 1], [0, 0]];
        let mut order = [0; 5];
        let found = prepare(&points, &mut order);
        assert!(found.is_collinear);
        assert_eq!((found.distinct, order), (4, [4, 1, 2, 0, 3]));
    }

    #[test]
    fn points_are_dealt_as_the_library_deals_a_single_round() {
        for contexts in 1..=25u32 {
            for count in [3, 16, 17, 40, 41, 1000] {
                let indices: Vec<u32> = (0..count).collect();
                let (count, contexts_here) = (count as usize, contexts as usize);
                let dealt = order::deal(order::Rounds::single(indices), contexts);
                let ours = (0..count).map(|arrival| place_of(arrival, count, contexts_here) as u32);
                assert!(ours.eq(dealt), "{contexts} {count}");
            }
        }
    }

    #[test]
    fn every_turn_of_a_triangle_is_the_same() {
        for turn in [[1, 5, 3], [5, 3, 1], [3, 1, 5]] {
            assert_eq!(smallest_first(turn), [1, 5, 3]);
        }
        for turn in [[1, 3, 5], [3, 5, 1], [5, 1, 3]] {
            assert_eq!(smallest_first(turn), [1, 3, 5]);
        }
    }
}
