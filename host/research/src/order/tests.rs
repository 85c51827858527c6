//! Tests of what all orders promise.

use std::collections::HashSet;

use incircle_geometry::order::random;
use incircle_geometry::Point;
use proptest::prelude::*;

use super::{brio, brio_dc, Alpha, BrioDc, Curve};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn every_order_is_a_permutation_and_keeps_equal_points_together(
        raw in prop::collection::vec((any::<u32>(), any::<u32>()), 0..300),
        (wide, high) in (0u32..32, 0u32..32),
    ) {
        let cut = |value: u32, bits: u32| if bits == 0 { 0 } else { value >> (32 - bits) };
        let points: Vec<Point> = raw.iter().map(|&(x, y)| Point::new(cut(x, wide), cut(y, high))).collect();
        let along = Curve::ALL.map(|curve| curve.order(&points));
        let rounds = Curve::ALL.into_iter().flat_map(|c| Alpha::ALL.map(|alpha| brio(&points, c, alpha)));
        let guided = BrioDc::ALL.map(|by| brio_dc(&points, by).order);
        for order in along.into_iter().chain(rounds).chain(guided).chain([random(&points)]) {
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

proptest! {
    #[test]
    fn dealt_orders_with_guides_are_permutations(
        raw in prop::collection::vec((0u32..1 << 16, 0u32..1 << 16), 0..1500),
        contexts in 1u32..25,
    ) {
        let points: Vec<Point> = raw.into_iter().map(Point::from).collect();
        let (rounds, _) = brio_dc(&points, BrioDc::Linear).into_rounds();
        let mut dealt = incircle::order::deal(rounds, contexts);
        dealt.sort_unstable();
        prop_assert!(dealt.iter().copied().eq(0..points.len() as u32));
    }
}
