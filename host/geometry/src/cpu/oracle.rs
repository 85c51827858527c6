//! Tests of the whole CPU triangulator against the definition of the mesh, and of the progress that a watch hears.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use incircle_testkit::{delaunay, delaunay_of_doubles, hull_of_doubles, SplitMix64};

use super::triangulator::{connect, threads_for, triangulate, Connectivity};
use super::triangulator::{Error, Progress, Stage};
use crate::mesh::Mesh;
use crate::plane_point::PlanePoint;
use crate::point::Point;

fn threads(count: usize) -> NonZeroUsize {
    NonZeroUsize::new(count).expect("at least one")
}

fn mesh_of(points: &[Point], count: usize) -> Mesh {
    triangulate(points.to_vec(), threads(count), &mut |_| ControlFlow::Continue(())).expect("nothing ends the work")
}

#[test]
fn small_sets_have_the_triangles_of_the_definition() {
    let mut random = SplitMix64::new(71);
    for round in 0..600 {
        let count = random.below(15) as usize;
        let points: Vec<Point> = random.points(count, 2 + round % 9);
        let mesh = mesh_of(&points, 1);
        assert_eq!(mesh.triangles, delaunay(&points), "{points:?}");
        mesh.verify().unwrap_or_else(|error| panic!("{error}: {points:?}"));
        assert_eq!(mesh.points, points);
    }
}

#[test]
fn threads_change_nothing() {
    let points: Vec<Point> = SplitMix64::new(72).points(100_000, 1 << 20);
    let one = mesh_of(&points, 1);
    one.verify().expect("the canonical mesh");
    for count in [2, 3, 7] {
        assert!(mesh_of(&points, count) == one, "{count} threads");
    }
}

#[test]
fn a_thread_has_16384_points_at_least() {
    let used = |points: usize, allowed: usize| threads_for(points, threads(allowed)).get();
    assert_eq!([used(0, 8), used(16_383, 8), used(16_384, 8), used(1 << 20, 8)], [1, 1, 2, 8]);
    assert_eq!(used(1 << 20, 1), 1);
}

#[test]
fn a_watch_hears_all_stages_in_order_and_can_end_each() {
    let points: Vec<Point> = SplitMix64::new(73).points(80_000, 1 << 16);
    let mut heard: Vec<Progress> = Vec::new();
    let mesh = triangulate(points.clone(), threads(1), &mut |progress| {
        heard.push(progress);
        ControlFlow::Continue(())
    });
    let distinct = 80_000 - mesh.expect("nothing ends the work").duplicates.len();
    let stages: Vec<Stage> = heard.chunk_by(|one, other| one.stage == other.stage).map(|own| own[0].stage).collect();
    assert_eq!(stages, [Stage::Order, Stage::Insert, Stage::Assemble]);
    let inserted: Vec<usize> = heard.iter().filter(|p| p.stage == Stage::Insert).map(|p| p.done).collect();
    assert!(inserted.len() > 3 && inserted.is_sorted(), "{inserted:?}");
    assert_eq!((inserted.first(), inserted.last()), (Some(&0), Some(&distinct)));
    for (place, &last) in heard.iter().enumerate() {
        let mut left = place;
        let found = triangulate(points.clone(), threads(2), &mut |_| match left.checked_sub(1) {
            Some(fewer) => {
                left = fewer;
                ControlFlow::Continue(())
            }
            None => ControlFlow::Break(()),
        });
        // Two threads report other numbers between the stages, and perhaps less often.
        match found {
            Err(Error::Cancelled(at)) => assert!(at.total == last.total || at.stage != last.stage, "{at:?}, {last:?}"),
            other => assert!(other.is_ok() && place > 3, "{place}: {other:?}"),
        }
    }
}

#[test]
fn the_widest_coordinates_are_exact() {
    const LAST: u32 = u32::MAX;
    let corners = [(0, 0), (LAST, 0), (LAST, LAST), (0, LAST)].map(|(x, y)| Point::new(x, y));
    assert_eq!(mesh_of(&corners, 1).triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh_of(&corners[2..3], 1).hull, [0]);
    let mut random = SplitMix64::new(74);
    for _ in 0..400 {
        // Points near the corners and the middle of the widest square, where determinants are largest.
        let near = |random: &mut SplitMix64| [0, LAST / 2, LAST - 3][random.below(3) as usize] + random.below(4) as u32;
        let points: Vec<Point> = (0..9).map(|_| Point::new(near(&mut random), near(&mut random))).collect();
        let doubles: Vec<[f64; 2]> = points.iter().map(|p| [f64::from(p.x), f64::from(p.y)]).collect();
        assert_eq!(mesh_of(&points, 1).triangles, delaunay_of_doubles(&doubles), "{points:?}");
    }
}

/// Coordinates of one kind: small and large, near one another, with few bits and with all, denormals and the widest.
fn double(random: &mut SplitMix64, kind: u64) -> f64 {
    let small = random.below(5) as f64;
    let unit = random.below(1 << 53) as f64 / (1u64 << 53) as f64;
    let ulps = |value: f64, count: u64| (0..count).fold(value, |value, _| value.next_up());
    match kind {
        0 => small - 2.0,
        1 => ulps(0.1 * small, random.below(3)),
        2 => unit,
        3 => small * 5e-324,
        4 => (small - 2.0) * 8e307,
        5 => (unit - 0.5) * 2f64.powi(random.below(2000) as i32 - 1000),
        6 => 1e15 + small / 8.0,
        7 => -ulps(small, random.below(2)),
        8 => [0.0, -0.0, 1.0, 5e-324, 1e308][random.below(5) as usize],
        _ => ulps(1.0, random.below(4)),
    }
}

/// The triangulation in the numbers themselves, whether they have a lattice or not.
fn connected<P: PlanePoint>(points: &[P], count: usize) -> Connectivity {
    connect(&P::numbers(points), threads(count), &mut |_| ControlFlow::Continue(())).expect("finite coordinates")
}

#[test]
fn small_sets_of_doubles_have_the_triangles_of_the_definition() {
    let mut random = SplitMix64::new(75);
    for round in 0..4000 {
        let count = random.below(11) as usize;
        let kind = |random: &mut SplitMix64| if round % 11 == 10 { random.below(10) } else { round % 11 };
        let points: Vec<[f64; 2]> = (0..count)
            .map(|_| {
                let kind = kind(&mut random);
                [double(&mut random, kind), double(&mut random, kind)]
            })
            .collect();
        let found = connected(&points, 1);
        let mesh = triangulate(points.clone(), threads(1), &mut |_| ControlFlow::Continue(())).expect("a mesh");
        assert!((&mesh.triangles, &mesh.hull) == (&found.triangles, &found.hull), "{points:?}");
        mesh.verify().unwrap_or_else(|error| panic!("{error}: {points:?}"));
        assert_eq!(found.triangles, delaunay_of_doubles(&points), "{points:?}");
        assert_eq!(found.hull, hull_of_doubles(&points), "{points:?}");
        for (index, point) in points.iter().enumerate() {
            let first = points.iter().position(|other| other == point).expect("itself");
            let listed = found.duplicates.iter().find(|duplicate| duplicate.index as usize == index);
            assert_eq!(listed.map(|duplicate| duplicate.of as usize), (first < index).then_some(first), "{points:?}");
        }
    }
}

#[test]
fn whole_numbers_give_one_mesh_as_points_as_doubles_and_as_integers() {
    let mut random = SplitMix64::new(76);
    for (count, side) in [(2000, 40), (5000, 1 << 12), (60_000, 1 << 31), (30_000, 300)] {
        let points: Vec<Point> = random.points(count, side);
        let expected = mesh_of(&points, 1);
        // Powers of two and shifts by doubles with few bits change nothing.
        let doubles: Vec<[f64; 2]> = points
            .iter()
            .map(|p| [p.x, p.y].map(|value| f64::from(value) * 2f64.powi(-340) - 2f64.powi(-330)))
            .collect();
        let integers: Vec<[i64; 2]> =
            points.iter().map(|p| [p.x, p.y].map(|value| (i64::from(value) << 32) + i64::MIN)).collect();
        for count in [1, 3] {
            let found = connected(&doubles, count);
            assert!((&found.triangles, &found.hull) == (&expected.triangles, &expected.hull));
            assert_eq!(found.duplicates, expected.duplicates);
            let found = connected(&integers, count);
            assert!((&found.triangles, &found.hull) == (&expected.triangles, &expected.hull));
            assert_eq!(found.duplicates, expected.duplicates);
        }
    }
}

#[test]
fn a_crowd_beside_a_far_point_has_the_mesh_of_the_crowd() {
    // All but one point share a cell of the grid.
    let mut random = SplitMix64::new(77);
    let crowd: Vec<Point> = random.points(20_000, 1 << 14);
    let expected = mesh_of(&crowd, 1);
    let mut doubles: Vec<[f64; 2]> = crowd.iter().map(|p| [f64::from(p.x), f64::from(p.y)]).collect();
    doubles.push([1e200, 3e199]);
    for count in [1, 2] {
        let found = connected(&doubles, count);
        let far = doubles.len() as u32 - 1;
        let near: Vec<[u32; 3]> = found.triangles.iter().copied().filter(|t| !t.contains(&far)).collect();
        assert!(near == expected.triangles);
        assert_eq!(found.duplicates, expected.duplicates);
        let mesh = Mesh::new(doubles.clone(), found.triangles, found.hull, found.duplicates);
        mesh.verify().expect("the canonical mesh");
    }
}

/// A cut that leaves a vertex alone in its subtree, beside one that is large enough to be cut further.
#[test]
fn lonely_points_around_a_crowd_have_the_canonical_mesh() {
    const LAST: u32 = (1 << 31) - 1;
    let crowd: Vec<Point> = SplitMix64::new(78).points(23_000, 1 << 12);
    let corners = [(0, 0), (LAST, 0), (0, LAST), (LAST, LAST)].map(|(x, y)| Point::new(x, y));
    let middle = |point: &Point| Point::new(point.x + (1 << 29), point.y + (1 << 28));
    for lonely in 0..16 {
        let chosen = (0..4).filter(|corner| lonely >> corner & 1 == 1).map(|corner| corners[corner]);
        let points: Vec<Point> = crowd.iter().map(middle).chain(chosen).collect();
        let one = mesh_of(&points, 1);
        one.verify().unwrap_or_else(|error| panic!("{error}, with the corners {lonely:04b}"));
        assert!(mesh_of(&points, 2) == one, "with the corners {lonely:04b}");
        let doubles: Vec<[f64; 2]> = points.iter().map(|p| [f64::from(p.x), f64::from(p.y)]).collect();
        for count in [1, 2] {
            let found = connected(&doubles, count);
            assert!((&found.triangles, &found.hull) == (&one.triangles, &one.hull), "with the corners {lonely:04b}");
        }
    }
}

#[test]
fn coordinates_that_are_no_numbers_are_refused_with_their_place() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let points = [[0.0, 1.0], [2.0, value]];
        let found = triangulate(points.to_vec(), threads(1), &mut |_| ControlFlow::Continue(()));
        assert_eq!(found, Err(Error::NotFinite { index: 1 }));
    }
}
