//! Dealing points to the contexts of a device.

use incircle_protocol::FIRST_ROUND;

use incircle_geometry::order::{along_curve, rounds, Rounds};
use incircle_geometry::Point;

/// The place in an order from which points belong to all contexts in turn; see [`FIRST_ROUND`].
const FIRST: usize = FIRST_ROUND as usize;

/// The default order of insertion for a device with this many contexts.
///
/// The order is [`brio_hilbert`](incircle_geometry::order::brio_hilbert) with each round cut into runs of points, one
/// for each context, as [`deal`] does it. The result has the index of every point once.
pub fn brio_hilbert_dealt(points: &[Point], contexts: u32) -> Vec<u32> {
    deal(rounds(&along_curve(points)), contexts)
}

/// Deals each round to the contexts of a device: a run of consecutive points to each.
///
/// Consecutive points of a curve are close together, so contexts that each follow a run of their own work far apart and
/// seldom meet. Context 0 takes the points before [`FIRST_ROUND`], and place `j` from there on belongs to context `(j -
/// FIRST_ROUND) mod contexts`. The places of a round that belong to context `c` get the `c`-th run of the round. O(n).
///
/// The same holds for a job of a batch and the contexts of its team.
pub fn deal(rounds: Rounds, contexts: u32) -> Vec<u32> {
    let Rounds { mut order, starts, .. } = rounds;
    deal_rounds(&mut order, &starts, contexts);
    order
}

/// Deals the rounds of an order that begin at these places.
pub(crate) fn deal_rounds(order: &mut [u32], starts: &[usize], contexts: u32) {
    let ends = starts.iter().skip(1).copied().chain([order.len()]);
    for (start, end) in starts.iter().copied().zip(ends) {
        let alone = FIRST.clamp(start, end);
        deal_round(&mut order[alone..end], alone, contexts as usize);
    }
}

/// The place whose point a job repeats at `place`, once its `vertices` points are over: the last one of the same
/// context of its team. That context inserts its points one after another, so the point is in the mesh by then, and is
/// found where the context was last. A context without points repeats the first point of the job.
pub(crate) fn repeated_place(place: usize, vertices: usize, contexts: u32) -> usize {
    let contexts = contexts as usize;
    let member = place.saturating_sub(FIRST) % contexts;
    match vertices.checked_sub(FIRST + member + 1) {
        Some(beyond) => vertices - 1 - beyond % contexts,
        None if member == 0 => vertices.saturating_sub(1),
        None => 0,
    }
}

/// Deals an order to contexts from its beginning: place `j` belongs to context `j mod contexts`, and the places of
/// context `c` get the `c`-th run of the order. With no contexts, as with one, the order stays.
pub(crate) fn deal_from_start(order: &mut [u32], contexts: usize) {
    deal_round(order, FIRST, contexts);
}

/// Deals a round that begins at place `first` of the order.
fn deal_round(round: &mut [u32], first: usize, contexts: usize) {
    if contexts < 2 || round.is_empty() {
        return;
    }
    let along_curve = round.to_vec();
    let mut next = 0;
    for context in 0..contexts {
        let place = (first - FIRST) % contexts;
        let offset = (context + contexts - place) % contexts;
        for slot in round.iter_mut().skip(offset).step_by(contexts) {
            *slot = along_curve[next];
            next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_geometry::order::{brio_hilbert, hilbert};
    use proptest::prelude::*;

    fn lattice(side: u32, step: u32) -> Vec<Point> {
        (0..side * side).map(|k| Point::new(k / side * step, k % side * step)).collect()
    }

    #[test]
    fn a_context_gets_a_run_of_each_round() {
        let points = lattice(40, 7);
        for contexts in 1..=incircle_protocol::MAX_CONTEXTS {
            for single in [false, true] {
                let undealt = || match single {
                    true => Rounds::single(hilbert(&points)),
                    false => rounds(&along_curve(&points)),
                };
                let Rounds { order, starts, .. } = undealt();
                let dealt = deal(undealt(), contexts);
                assert_eq!(dealt[..FIRST], order[..FIRST]);
                assert_eq!(starts.len(), if single { 1 } else { 4 });
                for (round, &start) in starts.iter().enumerate() {
                    let end = starts.get(round + 1).copied().unwrap_or(order.len());
                    let places = || start.max(FIRST)..end;
                    let belongs = |place: usize| (place - FIRST) as u32 % contexts;
                    let runs = (0..contexts).flat_map(|context| places().filter(move |&j| belongs(j) == context));
                    let along: Vec<u32> = runs.map(|place| dealt[place]).collect();
                    assert_eq!(along, order[places()], "{contexts} contexts, round {round}");
                }
            }
        }
    }

    #[test]
    fn short_sets_and_one_context_are_not_dealt() {
        let points = lattice(4, 9);
        assert_eq!(brio_hilbert_dealt(&points, 24), brio_hilbert(&points));
        let points = lattice(30, 9);
        assert_eq!(brio_hilbert_dealt(&points, 1), brio_hilbert(&points));
        assert_ne!(brio_hilbert_dealt(&points, 2), brio_hilbert(&points));
    }

    #[test]
    fn a_context_repeats_the_last_of_its_own_points() {
        for contexts in 1..=incircle_protocol::MAX_CONTEXTS {
            let member = |place: usize| if place < FIRST { 0 } else { (place - FIRST) as u32 % contexts };
            for vertices in 3..80 {
                for place in vertices..vertices + 60 {
                    let own = (0..vertices).rev().find(|&other| member(other) == member(place));
                    assert_eq!(repeated_place(place, vertices, contexts), own.unwrap_or(0), "{place} of {vertices}");
                }
            }
        }
        assert_eq!(repeated_place(99, 50, 1), 49);
    }

    proptest! {
        #[test]
        fn dealt_orders_are_permutations(
            raw in prop::collection::vec((0u32..1 << 16, 0u32..1 << 16), 0..1500),
            contexts in 1u32..25,
        ) {
            let points: Vec<Point> = raw.into_iter().map(Point::from).collect();
            for mut dealt in [brio_hilbert_dealt(&points, contexts), deal(Rounds::single(hilbert(&points)), contexts)] {
                dealt.sort_unstable();
                prop_assert!(dealt.iter().copied().eq(0..points.len() as u32));
            }
        }
    }
}
