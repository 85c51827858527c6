//! Preparing a job for the device: the host removes duplicates, puts the points in order, and moves three points that
//! are not collinear to the front.

use super::deal::deal_rounds;
use incircle_geometry::order::{distinct, random, rounds, Order, Rounds};
use incircle_geometry::Duplicate;
use incircle_geometry::Point;

/// A job that is ready for the device.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Prepared {
    /// Input index of each vertex, in the order of insertion: one index, the lowest, per distinct point.
    pub(crate) order: Vec<u32>,
    /// Points that fell onto an earlier one, sorted by index.
    pub(crate) duplicates: Vec<Duplicate>,
    /// Whether there are fewer than three distinct points, or all lie on one line. Then `order` is lexicographic.
    pub(crate) collinear: bool,
    /// Places at which the rounds of `order` begin; none if the order is not to be dealt.
    pub(crate) starts: Vec<usize>,
}

impl Prepared {
    /// Deals an order for one context to this many.
    pub(crate) fn dealt(mut self, contexts: u32) -> Self {
        deal_rounds(&mut self.order, &self.starts, contexts);
        self
    }
}

/// Removes duplicates, puts the points in order, and deals them to this many contexts, except in the order of the
/// input, which is not dealt. The input must have fewer than 2^32 points. O(n); takes 16 bytes per point while it runs,
/// or 32 where a coordinate has more than 16 bits.
pub(crate) fn prepare(points: &[Point], order: Order, contexts: u32) -> Prepared {
    let (curve, duplicates) = distinct(points);
    let mut rounds = match order {
        Order::Random => Rounds::single(at_random(points, curve.into_indices())),
        Order::Hilbert => Rounds::single(curve.into_indices()),
        Order::Input => {
            let mut indices = curve.into_indices();
            indices.sort_unstable();
            Rounds::single(indices)
        }
        // `Order` is non-exhaustive: an order that this crate does not know yet is treated as the default.
        _ => rounds(&curve),
    };
    let collinear = rounds.start_with_a_triangle(points).is_none();
    if order == Order::Input || collinear {
        rounds.starts.clear();
    }
    if collinear {
        rounds.order.sort_unstable_by_key(|&index| points[index as usize]);
    }
    let Rounds { order, starts } = rounds;
    Prepared { order, duplicates, collinear, starts }.dealt(contexts)
}

/// The points with these indices in random order, as indices.
fn at_random(points: &[Point], indices: Vec<u32>) -> Vec<u32> {
    let distinct: Vec<Point> = indices.iter().map(|&index| points[index as usize]).collect();
    random(&distinct).into_iter().map(|place| indices[place as usize]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_geometry::orient2d;
    use proptest::prelude::*;

    fn points(raw: &[(u32, u32)]) -> Vec<Point> {
        raw.iter().map(|&pair| pair.into()).collect()
    }

    #[test]
    fn tiny_sets_are_collinear() {
        for raw in [&[][..], &[(5, 5)], &[(5, 5), (5, 5)], &[(9, 1), (2, 3)]] {
            let prepared = prepare(&points(raw), Order::default(), 4);
            assert!(prepared.collinear);
        }
    }

    #[test]
    fn collinear_points_come_in_lexicographic_order() {
        let prepared = prepare(&points(&[(6, 3), (2, 1), (4, 2), (2, 1), (0, 0)]), Order::Input, 4);
        assert!(prepared.collinear);
        assert_eq!(prepared.order, [4, 1, 2, 0]);
        assert_eq!(prepared.duplicates, [Duplicate { index: 3, of: 1 }]);
    }

    #[test]
    fn the_first_point_off_the_line_becomes_the_third() {
        let prepared = prepare(&points(&[(0, 0), (1, 1), (2, 2), (3, 3), (3, 0), (9, 1)]), Order::Input, 4);
        assert!(!prepared.collinear);
        assert_eq!(prepared.order, [0, 1, 4, 2, 3, 5]);
    }

    #[test]
    fn points_are_dealt_but_not_in_the_order_of_the_input() {
        // The points begin with a line, so that the third vertex comes from far behind.
        let mut raw: Vec<(u32, u32)> = (0..100).map(|k| (k, k)).collect();
        raw.extend((0..900).map(|k| (k * 7919 % 10_007, k * 104_729 % 9973)));
        let points = points(&raw);
        for order in Order::ALL {
            let one = prepare(&points, order, 1);
            for contexts in 2..=24 {
                let many = prepare(&points, order, contexts);
                assert_eq!(many.order[..16], one.order[..16]);
                assert_eq!(many.order == one.order, order == Order::Input, "{order:?}, {contexts}");
                let mut sorted = [one.order.clone(), many.order];
                sorted.iter_mut().for_each(|order| order.sort_unstable());
                assert_eq!(sorted[0], sorted[1]);
            }
        }
    }

    proptest! {
        #[test]
        fn every_distinct_point_is_there_once_under_its_lowest_index(
            raw in prop::collection::vec((0u32..6, 0u32..6), 0..60),
            which in 0usize..Order::ALL.len(),
            contexts in prop_oneof![Just(1u32), 1u32..25],
            shift in prop::sample::select(vec![0u32, 20]),
        ) {
            let points: Vec<Point> = raw.iter().map(|&(x, y)| Point::new(x << shift, y << shift)).collect();
            let prepared = prepare(&points, Order::ALL[which], contexts);
            let lowest = |index: u32| points.iter().position(|p| *p == points[index as usize]);
            for &index in &prepared.order {
                prop_assert_eq!(lowest(index), Some(index as usize));
            }
            for pair in prepared.duplicates.windows(2) {
                prop_assert!(pair[0].index < pair[1].index);
            }
            for duplicate in &prepared.duplicates {
                prop_assert!(duplicate.of < duplicate.index);
                prop_assert_eq!(lowest(duplicate.index), Some(duplicate.of as usize));
            }
            let mut all: Vec<u32> = prepared.order.clone();
            all.extend(prepared.duplicates.iter().map(|d| d.index));
            all.sort_unstable();
            prop_assert!(all.iter().copied().eq(0..points.len() as u32));
            if let ([a, b, c, ..], false) = (&prepared.order[..], prepared.collinear) {
                let at = |index: u32| points[index as usize];
                prop_assert!(orient2d(at(*a), at(*b), at(*c)) != 0);
            }
        }
    }
}
