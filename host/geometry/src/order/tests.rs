//! Tests of what all orders promise.

use std::collections::HashSet;

use proptest::prelude::*;

use super::Order;
use crate::point::Point;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn every_order_is_a_permutation_and_keeps_equal_points_together(
        raw in prop::collection::vec((any::<u32>(), any::<u32>()), 0..300),
        (wide, high) in (0u32..32, 0u32..32),
    ) {
        let cut = |value: u32, bits: u32| if bits == 0 { 0 } else { value >> (32 - bits) };
        let points: Vec<Point> = raw.iter().map(|&(x, y)| Point::new(cut(x, wide), cut(y, high))).collect();
        let orders = Order::ALL.into_iter().filter(|&order| order != Order::Input);
        for order in orders.map(|order| order.order(&points)) {
            let mut seen = HashSet::new();
            for pair in order.chunk_by(|&one, &other| points[one as usize] == points[other as usize]) {
                prop_assert!(seen.insert(points[pair[0] as usize]), "{} comes twice", points[pair[0] as usize]);
            }
            let mut sorted = order;
            sorted.sort_unstable();
            prop_assert!(sorted.iter().copied().eq(0..points.len() as u32));
        }
    }
}
