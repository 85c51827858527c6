//! Snapped sets have no crossing, do not depend on any order, and stay near what they were made of.

use std::collections::BTreeSet;

use incircle_testkit::SplitMix64;

use super::brute::Graph;
use super::canonical::mesh_of;
use crate::constraints::pixels::Segment;
use crate::constraints::snap::crossing_pairs;
use crate::constraints::{constrain, snap, Pieces, Plan, SnapError, Snapped, SNAP_BITS};
use crate::point::Point;

fn points_of(graph: &Graph) -> Vec<Point> {
    graph.points.iter().map(|&[x, y]| Point::new(x, y)).collect()
}

/// The pieces of a snapped set by the places of their ends, with the ends of their constraints in the input.
fn pieces(graph: &Graph, snapped: &Snapped) -> BTreeSet<([Point; 2], Vec<[Point; 2]>)> {
    let made: Pieces =
        constrain(&mesh_of(&snapped.points), &Plan::new(&snapped.constraints)).expect("no crossing").pieces;
    let at = |index: u32| snapped.points[index as usize];
    let place = |ends: [u32; 2]| {
        let [a, b] = ends.map(at);
        [a.min(b), a.max(b)]
    };
    let of = |own: &u32| place(graph.constraints[*own as usize]);
    let all = made.renamed(&snapped.of);
    let sorted = |own: &[u32]| {
        let mut own: Vec<[Point; 2]> = own.iter().map(of).collect();
        own.sort_unstable();
        own
    };
    all.iter().map(|(edge, own)| (place(edge), sorted(own))).collect()
}

/// The distance of a point from a segment in steps of the grid.
fn distance(point: Point, [a, b]: [Point; 2]) -> f64 {
    let [p, a, b] = [point, a, b].map(|point| [f64::from(point.x), f64::from(point.y)]);
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = u[0] * u[0] + u[1] * u[1];
    let share = if square == 0.0 { 0.0 } else { ((u[0] * v[0] + u[1] * v[1]) / square).clamp(0.0, 1.0) };
    (v[0] - share * u[0]).hypot(v[1] - share * u[1])
}

/// Checks a set, and that any other order of its constraints gives the same. Returns whether constraints cross.
fn check(graph: &mut Graph, random: &mut SplitMix64) -> bool {
    let points = points_of(graph);
    let snapped = snap(&points, &graph.constraints).expect("few bits");
    assert_eq!(snapped.finer_bits, if graph.crosses() { SNAP_BITS } else { 0 });
    let finer = |point: &Point| Point::new(point.x << snapped.finer_bits, point.y << snapped.finer_bits);
    assert!(snapped.points[..points.len()].iter().copied().eq(points.iter().map(finer)));
    let new = &snapped.points[points.len()..];
    assert_eq!(new.len(), snapped.new_points);
    assert!(new.is_sorted_by(|one, other| one < other));
    assert!(snapped.largest_displacement < 0.708, "{}", snapped.largest_displacement);
    for (constraint, &of) in snapped.constraints.iter().zip(&snapped.of) {
        let whole = graph.constraints[of as usize].map(|end| snapped.points[end as usize]);
        for end in constraint.map(|end| snapped.points[end as usize]) {
            let moved = distance(end, whole);
            assert!(moved <= snapped.largest_displacement + 1e-6, "{:?} {:?}", graph.points, graph.constraints);
        }
    }
    // Each constraint is a chain from its first end to its last.
    for (number, &[from, to]) in (0u32..).zip(&graph.constraints) {
        let own = snapped.constraints.iter().zip(&snapped.of).filter(|(_, &of)| of == number).map(|(ends, _)| *ends);
        let own: Vec<[u32; 2]> = own.collect();
        assert_eq!((own[0][0], own[own.len() - 1][1]), (from, to));
        assert!(own.windows(2).all(|two| two[0][1] == two[1][0]));
    }
    let found = pieces(graph, &snapped);
    let again = snap(&snapped.points, &snapped.constraints).expect("no crossing");
    assert_eq!((&again.points, &again.constraints, again.new_points), (&snapped.points, &snapped.constraints, 0));
    for place in (1..graph.constraints.len()).rev() {
        graph.constraints.swap(place, random.below(place as u64 + 1) as usize);
    }
    graph.constraints.iter_mut().filter(|_| random.once_in(2)).for_each(|ends| ends.swap(0, 1));
    let other = snap(&points, &graph.constraints).expect("few bits");
    assert_eq!((&other.points, pieces(graph, &other)), (&snapped.points, found));
    snapped.finer_bits > 0
}

#[test]
fn snapped_graphs_have_no_crossing_and_one_form() {
    let mut random = SplitMix64::new(71);
    let mut crossing = 0;
    for _ in 0..3000 {
        crossing += usize::from(check(&mut Graph::random(&mut random, 12), &mut random));
    }
    assert!(crossing > 600, "{crossing}");
}

#[test]
fn crowded_and_wide_sets_are_snapped() {
    let mut random = SplitMix64::new(72);
    for side in [5, 40, 3000, (1 << 24) - 1] {
        for _ in 0..12 {
            let points: Vec<[u32; 2]> =
                (0..60).map(|_| [random.below_u32(side + 1), random.below_u32(side + 1)]).collect();
            let any = |random: &mut SplitMix64| random.below_u32(60);
            let constraints = (0..80).map(|_| [any(&mut random), any(&mut random)]).collect();
            let mut graph = Graph { points, constraints };
            assert!(check(&mut graph, &mut random));
        }
    }
}

#[test]
fn nearly_parallel_lines_of_one_corner_are_snapped() {
    // A fan of long lines: their crossings with others lie in one another's pixels.
    let mut points = vec![[0, 0]];
    points.extend((0..200).flat_map(|k| [[1 << 20, k], [k, 1 << 20], [(1 << 20) - k, (1 << 20) - 3 * k]]));
    let mut constraints: Vec<[u32; 2]> = (1..=600).map(|end| [0, end]).collect();
    constraints.extend((0..40).map(|k| [1 + 3 * k, 2 + 3 * (k * k % 200)]));
    let mut graph = Graph { points, constraints };
    let points = points_of(&graph);
    let snapped = snap(&points, &graph.constraints).expect("21 bits");
    assert!(snapped.new_points > 1000, "{}", snapped.new_points);
    let made = constrain(&mesh_of(&snapped.points), &Plan::new(&snapped.constraints)).expect("no crossing");
    assert!(made.pieces.len() > 2000);
    graph.constraints.reverse();
    assert_eq!(snap(&points, &graph.constraints).expect("21 bits").points, snapped.points);
}

#[test]
fn sets_without_room_are_refused_only_if_constraints_cross() {
    let points = [(0, 0), (3, 3), (0, 2), (1 << 24, 0), (1, 1)].map(|(x, y)| Point::new(x, y));
    assert_eq!(snap(&points, &[[0, 1], [2, 3]]), Err(SnapError::NoRoom { bits: 25 }));
    assert_eq!(
        SnapError::NoRoom { bits: 25 }.to_string(),
        "constraints cross, and the points need 25 of 32 bits, which leaves 7 spare where snapping needs 8: round \
         the points to at most 24 bits first (--quantize)"
    );
    let kept = snap(&points, &[[0, 1], [2, 0]]).expect("no crossing");
    assert_eq!((kept.finer_bits, &kept.points[..], kept.of), (0, &points[..], vec![0, 1]));
    let missing = SnapError::OutOfRange { constraint: 1, index: 5, points: 5 };
    assert_eq!(snap(&points, &[[0, 1], [2, 5]]), Err(missing));
}

#[test]
fn constraints_through_one_point_do_not_count_as_crossings() {
    let (count, middle) = (300, 1 << 20);
    let mut points = vec![Point::new(middle, middle)];
    for k in 0..count {
        points.extend([Point::new(k, 0), Point::new(2 * middle - k, 2 * middle)]);
    }
    let constraints: Vec<[u32; 2]> = (0..count).map(|k| [2 * k + 1, 2 * k + 2]).collect();
    let kept = snap(&points, &constraints).expect("no crossing but at a point");
    assert_eq!((kept.finer_bits, kept.constraints.len()), (0, constraints.len()));
    // Their list is limited, so none of the many pairs stands in it.
    let segments: Vec<Segment> = constraints.iter().map(|pair| Segment(pair.map(|end| points[end as usize]))).collect();
    assert_eq!(crossing_pairs(&segments, &points[..1]), Ok(vec![]));
    assert_eq!(crossing_pairs(&segments, &[]).map(|pairs| pairs.len()), Ok(300 * 299 / 2));
}
