//! Tests of the whole CPU triangulator against the definition of the mesh, and of the progress that a watch hears.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use incircle_testkit::{delaunay, SplitMix64};

use super::triangulator::{threads_for, triangulate, Error, Progress, Stage};
use crate::mesh::Mesh;
use crate::point::{Point, MAX_COORD_BITS};

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
fn wide_coordinates_are_refused_with_their_place() {
    let wide = Point::new(3, 1 << MAX_COORD_BITS);
    let points = vec![Point::new(1, 1), wide, wide];
    let found = triangulate(points, threads(1), &mut |_| ControlFlow::Continue(()));
    assert_eq!(found, Err(Error::CoordinateOutOfRange { index: 1, point: wide }));
    assert_eq!(mesh_of(&[Point::new((1 << 31) - 1, (1 << 31) - 1)], 1).hull, [0]);
}
