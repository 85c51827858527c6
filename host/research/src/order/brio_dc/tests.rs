//! Tests of the graph against brute force, and of the promises of the order.

use super::distance::{span, Distance};
use super::neighbors::Search;
use super::z_order::distinct_in_z_order;
use super::*;
use proptest::prelude::*;

/// The nearest neighbour of each point, found by a look at all others.
fn by_brute_force(points: &[Point]) -> Vec<u32> {
    let others = |own: u32| (0..points.len() as u32).filter(move |&other| other != own);
    let key = |own: u32, other: u32| (span(points[own as usize], points[other as usize]), other);
    (0..points.len() as u32).filter_map(|own| others(own).min_by_key(|&other| key(own, other))).collect()
}

/// The nearest neighbour of each point, found by the code of the order.
fn nearest_neighbors(points: &[Point], by: BrioDc) -> Vec<u32> {
    Search::with_room(points.len(), by).run(points).to_vec()
}

/// Sets on which a search for neighbours can go wrong: even ones, in a box, long and thin, on a lattice, in clusters,
/// and on a line.
fn sets() -> impl Strategy<Value = Vec<Point>> {
    let raw = prop::collection::vec((any::<u32>(), any::<u32>()), 0..160);
    (raw, 0u32..32, 0u32..32, 0u32..5).prop_map(|(raw, wide, high, shape)| {
        let cut = |value: u32, bits: u32| value & ((1u64 << bits) - 1) as u32;
        let point = |&(x, y): &(u32, u32)| match shape {
            0 => Point::new(cut(x, wide), cut(y, high)),
            1 => Point::new(x % 12 * 7, y % 12 * 7),
            2 => Point::new((1 << (x % 31)) | (x >> 28), (1 << (y % 31)) | (y >> 28)),
            3 => Point::new(cut(x, wide.min(30)), 2 * cut(x, wide.min(30))),
            _ => Point::new(((x % 3) << 24) | (y % 9), ((x / 3 % 3) << 24) | (y / 9 % 9)),
        };
        raw.iter().map(point).collect()
    })
}

/// Checks everything that an order promises.
fn check(points: &[Point], guided: &Guided) {
    let mut sorted = guided.order.clone();
    sorted.sort_unstable();
    assert!(sorted.iter().copied().eq(0..points.len() as u32));
    let mut is_in = vec![false; points.len()];
    for (place, (&point, &guide)) in guided.order.iter().zip(&guided.guides).enumerate() {
        assert!(is_in[guide as usize] || (place == 0 && guide == point), "place {place}");
        is_in[point as usize] = true;
    }
    assert_eq!(guided.guides.len(), points.len());
    assert!(guided.starts.is_sorted() && guided.starts.first().is_none_or(|&start| start == 0));
}

/// Checks that in each round every guide is a nearest vertex.
fn check_nearest(points: &[Point], guided: &Guided) {
    let at = |&index: &u32| points[index as usize];
    for (place, (point, guide)) in guided.order.iter().zip(&guided.guides).enumerate().skip(1) {
        let distance = |other: &u32| -> Distance { span(at(point), at(other)) };
        let nearest = guided.order[..place].iter().map(distance).min();
        assert_eq!(nearest, Some(distance(guide)), "place {place}");
    }
}

proptest! {
    #[test]
    fn the_graph_is_that_of_brute_force(points in sets()) {
        let points = distinct_in_z_order(&points);
        if points.len() > 1 {
            let expected = by_brute_force(&points);
            for by in BrioDc::ALL {
                prop_assert_eq!(&nearest_neighbors(&points, by), &expected, "{:?}", by);
            }
        }
    }

    #[test]
    fn each_component_has_one_pair(points in sets()) {
        let points = distinct_in_z_order(&points);
        if points.len() > 1 {
            let nearest = nearest_neighbors(&points, BrioDc::Linear);
            for first in 0..points.len() {
                let chain = std::iter::successors(Some(first), |&place| Some(nearest[place] as usize));
                let end = chain.take(points.len()).last().expect("a chain has no end");
                prop_assert_eq!(nearest[nearest[end] as usize] as usize, end);
            }
        }
    }

    #[test]
    fn guides_come_first_and_are_nearest(points in sets()) {
        let guided = brio_dc(&points, BrioDc::Linear);
        check(&points, &guided);
        check_nearest(&points, &guided);
        prop_assert_eq!(guided, brio_dc(&points, BrioDc::LogU));
    }

    #[test]
    fn the_order_follows_from_the_set_alone(points in sets()) {
        let reversed: Vec<Point> = points.iter().rev().copied().collect();
        let in_order = |points: &[Point]| -> Vec<Point> {
            brio_dc(points, BrioDc::Linear).order.iter().map(|&index| points[index as usize]).collect()
        };
        prop_assert_eq!(in_order(&points), in_order(&reversed));
    }

    #[test]
    fn coordinates_beyond_all_devices_are_ordered_too(
        raw in prop::collection::vec((any::<u32>(), any::<u32>()), 0..60),
    ) {
        let points: Vec<Point> = raw.into_iter().map(Point::from).collect();
        for by in BrioDc::ALL {
            check(&points, &brio_dc(&points, by));
        }
    }
}

#[test]
fn the_smallest_sets_have_orders() {
    let at = Point::new;
    let one = brio_dc(&[at(3, 4)], BrioDc::Linear);
    assert_eq!((one.order, one.guides), (vec![0], vec![0]));
    assert_eq!(brio_dc(&[], BrioDc::LogU), Guided::default());
    let most = u32::MAX;
    for points in
        [vec![at(9, 9), at(0, 0)], vec![at(5, 5); 4], vec![at(0, most), at(most, 0), at(0, 0), at(most, most)]]
    {
        for by in BrioDc::ALL {
            let guided = brio_dc(&points, by);
            check(&points, &guided);
        }
    }
}

#[test]
fn a_round_takes_about_half_of_what_is_left() {
    let points: Vec<Point> = (0..4096u64).map(mix).map(|h| Point::new(h as u32 >> 8, (h >> 40) as u32)).collect();
    let guided = brio_dc(&points, BrioDc::Linear);
    let sizes: Vec<usize> = guided.starts.iter().copied().skip(1).chain([points.len()]).collect();
    assert!((9..18).contains(&sizes.len()), "{sizes:?}");
    let last = sizes.windows(2).last().expect("rounds");
    assert!((1900..2200).contains(&last[0]), "{sizes:?}");
}
