//! The CPU triangulator gives the model's meshes on any number of threads, for shapes that strain divide and conquer.

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::time::Duration;

use crate::common::{by, by_model, Random};
use incircle::{Device, Error, ErrorKind, Mesh, Options, Point, Solution, Stage, Triangulator, TriangulatorError};

/// Largest coordinate.
const MAX: u32 = (1 << 31) - 1;

fn same(one: &Solution, other: &Solution) {
    assert!(one.mesh == other.mesh, "the meshes differ");
}

#[test]
fn small_sets_of_every_shape_are_the_models() {
    let mut random = Random(21);
    for round in 0..6000 {
        let count = random.below(24) as usize;
        let (wide, high) = (1 + random.below(9), 1 + random.below(9));
        // The places lie apart by a power of two, or by the largest step that fits.
        let step = [1, 1 << 14, 1 << 20, MAX / 9][round % 4];
        let points: Vec<Point> =
            (0..count).map(|_| Point::new(random.below(wide) * step, random.below(high) * step)).collect();
        same(&by("cpu", &points), &by_model(&points));
    }
}

#[test]
fn a_triangulator_that_is_used_again_makes_the_models_meshes() -> Result<(), TriangulatorError> {
    let mut random = Random(26);
    let (mut triangulator, mut mesh) = (Triangulator::new(), Mesh::default());
    for count in [0, 200, 3, 40, 1, 90] {
        let points: Vec<Point> = (0..count).map(|_| Point::new(random.below(30), random.below(MAX))).collect();
        triangulator.triangulate_into(&points, &mut mesh)?;
        assert!(mesh == by_model(&points).mesh, "the meshes of {count} points differ");
    }
    Ok(())
}

#[test]
fn extremes_of_coordinates_are_exact() {
    let mut random = Random(22);
    for bits in [15, 16, 17, 24, 31] {
        let last = ((1u64 << bits) - 1) as u32;
        for _ in 0..400 {
            // Corners, middles of sides, and their neighbours: determinants are largest and ties are many.
            let mut value = || {
                let near = [0, last / 2, last][random.below(3) as usize];
                (near + random.below(3)).saturating_sub(1).min(last)
            };
            let points: Vec<Point> = (0..12).map(|_| Point::new(value(), value())).collect();
            same(&by("cpu", &points), &by_model(&points));
        }
    }
}

/// Sets of `n` points that are hard in some way, by name.
fn shapes(n: u32) -> Vec<(&'static str, Vec<Point>)> {
    let mut random = Random(23);
    let side = (f64::from(n)).sqrt() as u32;
    let all = |make: &mut dyn FnMut(u32) -> (u32, u32)| (0..n).map(|k| Point::from(make(k))).collect::<Vec<_>>();
    vec![
        ("even", all(&mut |_| (random.below(1 << 16), random.below(1 << 16)))),
        ("wide", all(&mut |_| (random.below(MAX), random.below(MAX)))),
        ("few places", all(&mut |_| (random.below(99), random.below(99)))),
        ("lattice", all(&mut |k| (k / side * 7, k % side * 7))),
        ("upright", all(&mut |k| (k % 2, k))),
        ("lying", all(&mut |k| (k, k % 2))),
        ("slanting", all(&mut |k| (k, 2 * k + u32::from(k == n / 2)))),
        ("parabola", all(&mut |k| (k, k.min(46_340) * k.min(46_340)))),
        ("two chains", all(&mut |k| (k / 2 * 3, if k % 2 == 0 { k } else { MAX - k }))),
        ("one far away", all(&mut |k| if k == 0 { (MAX, MAX) } else { (random.below(300), random.below(300)) })),
        ("clusters", all(&mut |k| ((k % 7) << 28 | random.below(500), (k % 5) << 28 | random.below(500)))),
    ]
}

#[test]
fn threads_do_not_change_the_mesh() {
    // These sets are large enough to give work to four threads.
    for (name, points) in shapes(50_000) {
        println!("{name}");
        let expected = by_model(&points);
        for threads in [1, 2, 4] {
            let mesh = by(&format!("cpu?threads={threads}"), &points);
            assert_eq!(mesh.report.contexts, threads);
            same(&mesh, &expected);
        }
    }
}

#[test]
fn collinear_and_tiny_sets_are_answers() {
    let lines = [(0, 1), (1, 0), (1, 1), (3, 7)];
    for (x, y) in lines {
        for count in 0..40 {
            let points: Vec<Point> = (0..count).map(|k| k * 17 % 41).map(|k| Point::new(k * x, 300 - k * y)).collect();
            let solution = by("cpu", &points);
            assert!(solution.mesh.is_collinear());
            same(&solution, &by_model(&points));
        }
    }
    let equal = by("cpu", &[Point::new(MAX, MAX); 50_000]);
    assert_eq!((equal.mesh.hull.as_slice(), equal.mesh.duplicates.len()), ([0].as_slice(), 49_999));
}

#[test]
fn progress_covers_the_stages_and_cancels_anywhere() {
    let points = Random(24).points(150_000, 1 << 20);
    for threads in [1, 2] {
        let mut device = Device::open(&format!("cpu?threads={threads}")).expect("the CPU triangulator");
        let mut session = device.session().expect("a session");
        let calls = RefCell::new(Vec::new());
        let listen = |progress| {
            calls.borrow_mut().push(progress);
            ControlFlow::Continue(())
        };
        let options = Options::default().progress(&listen);
        let expected = session.triangulate_with(&points, &options).expect("a mesh");
        let calls = calls.into_inner();
        for stage in [Stage::Order, Stage::Insert, Stage::Assemble] {
            assert!(calls.iter().any(|call| call.stage == stage), "{stage:?}");
            assert!(expected.report.stage(stage).is_some(), "{stage:?}");
        }
        // The number of looks that a thread takes depends on the others, so the last stop is far before the end.
        for stop in 0..4u32 {
            let left = RefCell::new(stop);
            let listen = |_| match left.replace_with(|left| left.saturating_sub(1)) {
                0 => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            };
            let options = Options::default().progress(&listen);
            let error = session.triangulate_with(&points, &options).expect_err("cancelled");
            assert_eq!(error.kind(), ErrorKind::Cancelled);
        }
        same(&session.triangulate(&points).expect("the session is still good"), &expected);
    }
}

#[test]
fn a_passed_deadline_is_a_timeout_and_no_more() {
    let points = Random(25).points(5000, 1 << 16);
    let mut device = Device::cpu(None);
    let mut session = device.session().expect("a session");
    let options = Options::default().timeout(Duration::from_nanos(1));
    let error = session.triangulate_with(&points, &options).expect_err("too late");
    assert_eq!(error.kind(), ErrorKind::Timeout);
    assert!(session.triangulate(&points).is_ok());
}

#[test]
fn wrong_choices_are_named() {
    let mut device = Device::open("cpu?threads=2").expect("the CPU triangulator");
    let mut session = device.session().expect("a session");
    assert_eq!((session.identity().contexts, session.identity().coord_bits), (2, 32));
    for asked in [0, 3] {
        let options = Options::default().contexts(asked);
        let error = session.triangulate_with(&[Point::new(1, 1)], &options).expect_err("no such thread");
        assert!(matches!(error, Error::Contexts { contexts: 2, .. }), "{error}");
    }
    let error = session.triangulate(&[[0.0, 0.0], [f64::INFINITY, 0.0]]).expect_err("too wide");
    assert!(matches!(error, Error::NotFinite { index: 1, axis: 'x', .. }), "{error}");
}
