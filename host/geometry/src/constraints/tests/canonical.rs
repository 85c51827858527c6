//! Constrained meshes of small graphs full of ties beside those by their definition.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use incircle_testkit::SplitMix64;

use super::brute::Graph;
use crate::constraints::constrain::in_numbers;
use crate::constraints::{self, constrain, Constrained, Error, Place, Plan, TriangulateError};
use crate::cpu::{connect_fixed, triangulate, Asked};
use crate::mesh::Mesh;
use crate::plane_point::PlanePoint;
use crate::point::Point;

pub fn mesh_of<P: PlanePoint>(points: &[P]) -> Mesh<P> {
    triangulate(points.to_vec(), NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("finite points")
}

/// The answer for points and constraints, which is the same for a mesh that is there already and for the points alone.
pub fn in_both_ways<P: PlanePoint>(points: &[P], plan: &Plan<'_, P>) -> Result<Constrained, Error> {
    let mesh = mesh_of(points);
    let made = constrain(&mesh, plan);
    match constraints::triangulate(points, plan, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())) {
        Ok(again) => {
            assert_eq!(made.as_ref(), Ok(&again.made));
            // Places at vertices are left to the slow way, and so are points on one line.
            let is_fast = in_numbers(points, plan, |numbers, plan| -> Result<bool, Error> {
                let asked = Asked { plan, most: usize::MAX, threads: NonZeroUsize::MIN };
                let forced = connect_fixed(numbers, points.len(), asked, &mut |_| ControlFlow::Continue(()));
                Ok(forced.expect("finite points").is_some())
            });
            let has_marks = !plan.holes.is_empty() || !plan.regions.is_empty();
            assert!(is_fast == Ok(true) || has_marks || mesh.triangles.is_empty());
            assert_eq!((again.hull, again.duplicates), (mesh.hull, mesh.duplicates));
        }
        Err(TriangulateError::Plan(error)) => assert_eq!(made.as_ref(), Err(&error)),
        Err(TriangulateError::Points(error)) => panic!("{error}"),
    }
    made
}

/// The constrained mesh of the points of a graph, brought into other numbers.
fn constrained<P: PlanePoint>(graph: &Graph, point: impl Fn([u32; 2]) -> P) -> Result<Constrained, Error> {
    let points: Vec<P> = graph.points.iter().map(|&at| point(at)).collect();
    in_both_ways(&points, &Plan::new(&graph.constraints))
}

/// In numbers of all kinds, stretched so that ties stay ties.
fn in_all_numbers(graph: &Graph) -> [Result<Constrained, Error>; 5] {
    [
        constrained(graph, |[x, y]| Point::new(x, y)),
        constrained(graph, |[x, y]| Point::new(x * (u32::MAX / 4), y * (u32::MAX / 4))),
        constrained(graph, |[x, y]| [i64::from(x) << 50, i64::from(y) << 50]),
        constrained(graph, |[x, y]| [f64::from(x) * 2f64.powi(900), f64::from(y) * 2f64.powi(900)]),
        constrained(graph, |[x, y]| [f64::from_bits(x.into()), f64::from_bits(y.into())]),
    ]
}

/// Checks that the crossing lies on both constraints, between the ends of each.
fn check_crossing(graph: &Graph, error: Error) {
    let Error::Crossing { constraints, ends, place: Place::Exact(place) } = error else { panic!("{error}") };
    assert!(constraints[0] < constraints[1]);
    assert_eq!(ends, constraints.map(|constraint| graph.constraints[constraint as usize]));
    assert!(graph.cross(ends[0], ends[1]));
    for [a, b] in ends.map(|pair| pair.map(|end| graph.at(end).map(i128::from))) {
        // The place times both denominators, so that all numbers are whole.
        let scale = place[0].denominator * place[1].denominator;
        let at = [0, 1].map(|axis| place[axis].numerator * place[1 - axis].denominator);
        let (u, v) = ([0, 1].map(|axis| b[axis] - a[axis]), [0, 1].map(|axis| at[axis] - scale * a[axis]));
        assert_eq!(u[0] * v[1], u[1] * v[0]);
        assert!((0..2).all(|axis| (scale * a[axis].min(b[axis])..=scale * a[axis].max(b[axis])).contains(&at[axis])));
    }
}

/// Checks that the place of a crossing is finite, also where its numbers are near the limits of doubles.
fn check_crossing_in_doubles(error: Error) {
    let Error::Crossing { place, .. } = error else { panic!("{error}") };
    if let Place::About(place) = place {
        assert!(place.iter().all(|value| value.is_finite()), "{place:?}");
    }
}

/// Checks random graphs. Returns how many have a mesh, and how many crossings.
fn check(seed: u64, rounds: usize) -> [usize; 2] {
    let mut random = SplitMix64::new(seed);
    let mut counts = [0; 2];
    for _ in 0..rounds {
        let graph = Graph::random(&mut random, 9);
        let all = in_all_numbers(&graph);
        let pieces = graph.pieces();
        if graph.crosses() {
            let [first, others @ ..] = all;
            check_crossing(&graph, first.expect_err("a crossing"));
            for error in others {
                check_crossing_in_doubles(error.expect_err("a crossing"));
            }
            counts[1] += 1;
            continue;
        }
        let fixed = pieces.keys().copied().collect();
        let expected = graph.flipped(&fixed, &mut random);
        for _ in 1..4 {
            assert_eq!(graph.flipped(&fixed, &mut random), expected, "{:?} {:?}", graph.points, graph.constraints);
        }
        for made in all {
            let made = made.expect("no crossing");
            assert_eq!(made.triangles, expected, "{:?} {:?}", graph.points, graph.constraints);
            assert!(made.pieces.iter().eq(pieces.iter().map(|(&edge, list)| (edge, &list[..]))), "{:?}", graph.points);
        }
        counts[0] += 1;
    }
    counts
}

#[test]
fn every_start_and_every_order_of_flips_ends_at_the_mesh() {
    let [meshes, crossings] = check(1, 4000);
    assert!(meshes >= 2000 && crossings >= 800, "{meshes} {crossings}");
}

/// The same for more than 100,000 graphs: `cargo test -p incircle-geometry --lib every_start -- --ignored`.
#[test]
#[ignore = "takes minutes"]
fn every_start_and_every_order_of_flips_ends_at_the_mesh_of_many_graphs() {
    let [meshes, crossings] = check(2, 250_000);
    println!("{meshes} graphs have one mesh, {crossings} have crossings");
    assert!(meshes >= 100_000, "{meshes}");
}
