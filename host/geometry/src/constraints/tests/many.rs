//! Sets that once took minutes or gigabytes: equal and overlapping constraints, crossings, and plans without an answer.

use core::num::NonZeroUsize;
use core::ops::ControlFlow;

use incircle_testkit::SplitMix64;

use super::brute::Graph;
use super::canonical::in_both_ways;
use crate::constraints::pixels::Segment;
use crate::constraints::sweep::each_crossing;
use crate::constraints::{triangulate, Error, Plan, TriangulateError, Triangulated};
use crate::cpu;
use crate::point::Point;

/// Triangulates until the watch has heard `most` times, and counts how often it heard.
fn heard(points: &[Point], constraints: &[[u32; 2]], most: usize) -> (usize, Result<Triangulated, TriangulateError>) {
    let mut heard = 0;
    let made = triangulate(points, &Plan::new(constraints), NonZeroUsize::MIN, &mut |_| {
        heard += 1;
        if heard <= most {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    });
    (heard, made)
}

#[test]
fn equal_constraints_are_counted_before_their_pieces_are_listed() {
    let count = 20_000;
    let mut points: Vec<Point> = (0..count).map(|k| Point::new(k, 7)).collect();
    let constraints: Vec<[u32; 2]> =
        (0..count).map(|k| if k % 2 == 0 { [0, count - 1] } else { [count - 1, 0] }).collect();
    let too_many = Err(TriangulateError::Plan(Error::TooManyPieces { max: 1 << 28 }));
    assert_eq!(heard(&points, &constraints, usize::MAX).1, too_many);
    points.push(Point::new(9, 9));
    // One look at 64 pieces, and the pieces of 20,000 constraints would be more than 2^28.
    let (looks, made) = heard(&points, &constraints, usize::MAX);
    assert_eq!(made, too_many);
    assert!(looks < 3 * count as usize / 64, "{looks}");
    let some = &constraints[..9000];
    let (_, made) = heard(&points, some, usize::MAX);
    let pieces = made.expect("fewer than 2^28 pieces").made.pieces;
    assert_eq!(pieces.len(), count as usize - 1);
    assert!(pieces.iter().all(|(_, own)| own.iter().copied().eq(0..9000)));
}

#[test]
fn the_search_for_the_reason_of_a_wrong_plan_can_be_ended() {
    let count = 10_000;
    let mut points: Vec<Point> = (0..count).map(|k| Point::new(k, 7)).collect();
    points.extend([Point::new(5, 4), Point::new(6, 11)]);
    let constraints = [[0, count - 1], [count, count + 1]];
    let (looks, made) = heard(&points, &constraints, usize::MAX);
    assert!(matches!(made, Err(TriangulateError::Plan(Error::Crossing { constraints: [0, 1], .. }))), "{made:?}");
    // The constraints are forced, taken out again, and forced once more until the reason is found.
    assert!(looks > 2 * count as usize / 64, "{looks}");
    for most in (0..looks).step_by(17).chain([looks - 2, looks - 1]) {
        let (_, made) = heard(&points, &constraints, most);
        assert!(matches!(made, Err(TriangulateError::Points(cpu::Error::Cancelled(_)))), "{most} of {looks}: {made:?}");
    }
}

/// All pairs that cross, by looking at each.
fn pairs_of(segments: &[Segment]) -> Vec<[u32; 2]> {
    let count = segments.len() as u32;
    let all = (0..count).flat_map(|one| (one + 1..count).map(move |other| [one, other]));
    all.filter(|pair| segments[pair[0] as usize].crosses(&segments[pair[1] as usize])).collect()
}

/// All pairs that cross, by the sweep.
fn swept(segments: &[Segment]) -> Vec<[u32; 2]> {
    let mut pairs = Vec::new();
    let all: Result<(), ()> = each_crossing(segments, |one, other| {
        pairs.push([one.min(other), one.max(other)]);
        Ok(())
    });
    assert_eq!(all, Ok(()));
    pairs.sort_unstable();
    pairs
}

#[test]
fn the_sweep_finds_each_crossing_once() {
    let mut random = SplitMix64::new(91);
    let mut found = 0;
    for round in 0..4000u32 {
        // From grids on which everything meets everything to those with coordinates of all bits.
        let side = [3, 4, 6, 12, 100, 1 << 20, u32::MAX][round as usize % 7];
        let place = |random: &mut SplitMix64| Point::new(random.below_u32(side), random.below_u32(side));
        let count = 1 + random.below(if round % 50 == 0 { 700 } else { 30 });
        let segments: Vec<Segment> = (0..count).map(|_| Segment([place(&mut random), place(&mut random)])).collect();
        let expected = pairs_of(&segments);
        assert_eq!(swept(&segments), expected, "{segments:?}");
        found += expected.len();
    }
    assert!(found > 100_000, "{found}");
}

#[test]
fn long_parallel_constraints_are_swept_in_no_time() {
    // Each overlaps all others in x and in y. Looking at every pair would take hours.
    let count = 300_000;
    let line = |k| Segment([Point::new(k, 0), Point::new(k + (1 << 30), 1 << 30)]);
    let mut segments: Vec<Segment> = (0..count).map(line).collect();
    assert_eq!(swept(&segments), [] as [[u32; 2]; 0]);
    segments.push(Segment([Point::new(1, 1 << 29), Point::new(u32::MAX, (1 << 29) + 1)]));
    assert_eq!(swept(&segments).len(), count as usize);
}

#[test]
fn overlapping_constraints_of_many_points_are_those_of_the_definition() {
    let mut random = SplitMix64::new(92);
    for _ in 0..300 {
        let count = 4 + random.below_u32(12);
        let mut points: Vec<[u32; 2]> = (0..count).map(|k| [2 * k, k]).collect();
        if random.once_in(2) {
            points.extend([[1, 30], [9, 0]]);
        }
        let constraints = (0..random.below(60)).map(|_| [random.below_u32(count), random.below_u32(count)]).collect();
        let graph = Graph { points, constraints };
        let points: Vec<Point> = graph.points.iter().map(|&[x, y]| Point::new(x, y)).collect();
        let made = in_both_ways(&points, &Plan::new(&graph.constraints)).expect("no crossing");
        assert!(made.pieces.iter().eq(graph.pieces().iter().map(|(&edge, own)| (edge, &own[..]))));
    }
}
