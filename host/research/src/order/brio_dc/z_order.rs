//! Points along the Z-curve, with equal ones together, sorted by radix or by comparison.

use super::kind::BrioDc;
use super::quadtree::level;
use incircle_geometry::order::z_curve::{point_at, position};
use incircle_geometry::pages::with_room;
use incircle_geometry::sort::{sort_by_key, Entry, Narrow, Wide};
use incircle_geometry::Point;

/// Points in the order of the Z-curve.
pub(super) struct Along {
    /// The indices of the points; those of equal points in input order.
    pub(super) indices: Vec<u32>,
    /// The points themselves, in the same order.
    pub(super) points: Vec<Point>,
}

/// Sorts points along the curve: by radix in O(n), by comparison in O(n log n).
pub(super) fn along_z(points: &[Point], by: BrioDc) -> Along {
    let all = points.iter().fold(0, |all, point| all | point.x | point.y);
    let indices = 0..=u32::MAX;
    match by {
        BrioDc::LogU => {
            let mut indices: Vec<u32> = indices.take(points.len()).collect();
            indices.sort_by(|&one, &other| compare(points[one as usize], points[other as usize]));
            let points = indices.iter().map(|&index| points[index as usize]).collect();
            Along { indices, points }
        }
        // Positions have 32 bits if coordinates have 16.
        BrioDc::Linear if all < 1 << 16 => {
            sorted(points.iter().zip(indices).map(|(p, index)| Narrow::new(position(p.x, p.y) as u32, index)))
        }
        BrioDc::Linear => sorted(points.iter().zip(indices).map(|(p, index)| Wide::new(position(p.x, p.y), index))),
    }
}

/// Sorts by position, and computes the points from their positions, which is faster than scattered reads of the input.
fn sorted<E: Entry>(entries: impl Iterator<Item = E>) -> Along {
    let mut along = with_room(entries.size_hint().0);
    along.extend(entries);
    sort_by_key(&mut along);
    let mut points = with_room(along.len());
    points.extend(along.iter().map(|entry| point_at(entry.key())));
    Along { indices: along.iter().map(Entry::value).collect(), points }
}

/// Compares two points along the curve by the axis in which they differ at the higher bit. Source: Chan, *A
/// minimalist's implementation of an approximate nearest neighbor algorithm in fixed dimensions*, 2006.
fn compare(one: Point, other: Point) -> std::cmp::Ordering {
    let differs_in_x = level(one, other).is_multiple_of(2);
    if differs_in_x {
        one.x.cmp(&other.x)
    } else {
        one.y.cmp(&other.y)
    }
}

/// The distinct points of a list, in Z-order.
#[cfg(test)]
pub(super) fn distinct_in_z_order(points: &[Point]) -> Vec<Point> {
    let mut along = along_z(points, BrioDc::Linear).points;
    along.dedup();
    along
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn both_sorts_agree(
            raw in prop::collection::vec((any::<u32>(), any::<u32>()), 0..200),
            (wide, high) in (0u32..32, 0u32..32),
        ) {
            let points: Vec<Point> = raw.iter().map(|&(x, y)| Point::new(x >> wide, y >> high)).collect();
            let order = along_z(&points, BrioDc::Linear);
            let other = along_z(&points, BrioDc::LogU);
            prop_assert_eq!((&order.indices, &order.points), (&other.indices, &other.points));
            let mut pairs = order.indices.iter().zip(&order.points);
            prop_assert!(pairs.all(|(&index, &point)| points[index as usize] == point));
            let key = |index: &u32| (position(points[*index as usize].x, points[*index as usize].y), *index);
            prop_assert!(order.indices.iter().is_sorted_by_key(key));
            prop_assert_eq!(order.indices.len(), points.len());
        }
    }
}
