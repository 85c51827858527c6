//! Points along the Z-curve, equal ones together: sorted by radix, or by comparison.

use super::quadtree::level;
use super::BrioDc;
use crate::order::morton::position;
use crate::point::Point;
use crate::sort::{sort_by_key, Entry, Narrow, Wide};

/// Indices of the points along the curve; of equal points, in input order. By radix O(n), by comparison O(n log n).
pub(super) fn along_z(points: &[Point], by: BrioDc) -> Vec<u32> {
    let all = points.iter().fold(0, |all, point| all | point.x | point.y);
    let indices = 0..=u32::MAX;
    match by {
        BrioDc::LogU => {
            let mut order: Vec<u32> = indices.take(points.len()).collect();
            order.sort_by(|&one, &other| compare(points[one as usize], points[other as usize]));
            order
        }
        // Positions of points of 16 bits have 32.
        BrioDc::Linear if all < 1 << 16 => {
            sorted(points.iter().zip(indices).map(|(p, index)| Narrow::new(position(p.x, p.y) as u32, index)).collect())
        }
        BrioDc::Linear => {
            sorted(points.iter().zip(indices).map(|(p, index)| Wide::new(position(p.x, p.y), index)).collect())
        }
    }
}

fn sorted<E: Entry>(mut entries: Vec<E>) -> Vec<u32> {
    sort_by_key(&mut entries);
    entries.iter().map(Entry::value).collect()
}

/// Which of two points comes first, decided by the axis in which they differ at the higher bit. Chan, *A minimalist's implementation of
/// an approximate nearest neighbor algorithm in fixed dimensions*, 2006.
fn compare(one: Point, other: Point) -> std::cmp::Ordering {
    let differs_in_x = level(one, other) % 2 == 0;
    if differs_in_x {
        one.x.cmp(&other.x)
    } else {
        one.y.cmp(&other.y)
    }
}

/// The distinct ones of some points, in Z-order.
#[cfg(test)]
pub(super) fn distinct_in_z_order(points: &[Point]) -> Vec<Point> {
    let mut along: Vec<Point> = along_z(points, BrioDc::Linear).iter().map(|&index| points[index as usize]).collect();
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
            prop_assert_eq!(&order, &along_z(&points, BrioDc::LogU));
            let key = |index: &u32| (position(points[*index as usize].x, points[*index as usize].y), *index);
            prop_assert!(order.is_sorted_by_key(key));
            prop_assert_eq!(order.len(), points.len());
        }
    }
}
