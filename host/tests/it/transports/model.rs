//! The software model through the library, with the CPU triangulator beside it: hard inputs,
//! orders, chunks, sizes and progress.

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::time::Duration;

use crate::common::{assert_right, by_cpu, by_model, Random};
use incircle::{triangulate, Device, Error, ErrorKind, Options, Order, Point, Solution, Stage};

/// The solution by the model, after a check that the CPU triangulator agrees.
fn solved(points: &[Point]) -> Solution {
    let solution = by_model(points);
    let other = by_cpu(points);
    assert_eq!(solution.mesh, other.mesh);
    solution
}

#[test]
fn random_points_at_every_width() {
    let mut random = Random(3);
    for bits in [1, 2, 4, 8, 12, 16, 17, 24, 31] {
        for count in [1, 3, 10, 300, 3000] {
            solved(&random.points(count, 1 << bits));
        }
    }
}

#[test]
fn lattices_and_boxes_with_duplicates() {
    let lattice: Vec<Point> = (0..2500).map(|k| Point::new(k / 50 * 3, k % 50 * 3)).collect();
    assert_eq!(solved(&lattice).mesh.triangles.len(), 2 * 49 * 49);
    let rotated: Vec<Point> =
        (0..2500).map(|k| (k / 50, k % 50)).map(|(i, j)| Point::new(200 + 3 * i - 2 * j, 2 * i + 3 * j)).collect();
    assert_eq!(solved(&rotated).mesh.triangles.len(), 2 * 49 * 49);
    let mut random = Random(4);
    let heavy = solved(&random.points(5000, 32));
    assert!(heavy.report.duplicates > 3900);
}

#[test]
fn circles_parabolas_and_chains() {
    // All grid points on the circle x² + y² = 5² · 13² · 17² around a centre, which are many exactly cocircular points.
    let radius = 5 * 13 * 17i64;
    let circle: Vec<Point> = (-radius..=radius)
        .flat_map(|x| {
            let y = ((radius * radius - x * x) as f64).sqrt().round() as i64;
            let on = x * x + y * y == radius * radius;
            [(x, y), (x, -y)].into_iter().filter(move |_| on)
        })
        .map(|(x, y)| Point::new((x + radius) as u32, (y + radius) as u32))
        .collect();
    let solution = solved(&circle);
    assert_eq!(solution.mesh.hull.len(), solution.report.distinct);
    assert!(solution.report.distinct >= 100);
    let parabola: Vec<Point> = (0..250).map(|k| Point::new(k, k * k)).collect();
    assert_eq!(solved(&parabola).mesh.triangles.len(), 248);
    let chains: Vec<Point> = (0..400).map(|k| Point::new(k / 2 * 3, if k % 2 == 0 { 0 } else { 60_000 })).collect();
    assert_eq!(solved(&chains).mesh.triangles.len(), 398);
}

#[test]
fn degenerate_inputs_are_answers() {
    assert_eq!(solved(&[]).mesh.hull, []);
    assert_eq!(solved(&[(7, 7).into()]).mesh.hull, [0]);
    assert_eq!(solved(&[(7, 7).into(), (7, 7).into(), (1, 1).into()]).mesh.hull, [2, 0]);
    let line: Vec<Point> = (0..100).map(|k| Point::new(k * 37 % 100 * 2, k * 37 % 100)).collect();
    let solution = solved(&line);
    assert!(solution.mesh.is_collinear() && solution.report.counters.is_none());
    assert_eq!(solution.mesh.hull.len(), 100);
}

#[test]
fn orders_chunks_and_input_order_do_not_change_the_mesh() {
    let points = Random(5).points(700, 300);
    let expected = solved(&points);
    let mut device = Device::open("model").expect("the model");
    let mut session = device.session().expect("a session");
    for order in Order::ALL {
        for insert_chunk in [0, 3, 64, 100_000] {
            let options = Options::default().order(order).insert_chunk(insert_chunk);
            let solution = session.triangulate_with(&points, &options).expect("a mesh");
            assert_eq!(solution.mesh.triangles, expected.mesh.triangles);
            assert_eq!(solution.mesh.hull, expected.mesh.hull);
            assert_eq!(solution.report.order, order.name());
        }
    }
}

#[test]
fn half_edges_and_neighbours_agree() {
    let solution = solved(&Random(6).points(500, 1 << 16));
    let halfedges = solution.mesh.halfedges();
    let neighbors = solution.mesh.neighbors();
    let mut open = 0;
    for (halfedge, &twin) in halfedges.iter().enumerate() {
        let opposite = neighbors[halfedge / 3][(halfedge % 3 + 2) % 3];
        if twin == incircle::EMPTY {
            assert_eq!(opposite, None);
            open += 1;
        } else {
            assert_eq!(halfedges[twin as usize], halfedge as u32);
            assert_eq!(opposite, Some(twin / 3));
        }
    }
    assert_eq!(open, solution.mesh.hull.len());
}

#[test]
fn more_points_than_the_capacity_go_in_parts() {
    let points = Random(7).points(65, 1 << 16);
    let mut device = Device::open("model?capacity=64").expect("the model");
    let mut session = device.session().expect("a session");
    let fits = session.triangulate(&points[..64]).expect("as many as it holds");
    assert_eq!(fits.report.parts, 0);
    let solution = session.triangulate(&points).expect("one more than it holds");
    assert_right(&solution);
    assert!(solution.report.parts > 1);
    let mut doubled = points[..64].to_vec();
    doubled.extend(&points[..64]);
    let mesh = session.triangulate(&doubled).expect("duplicates take no room");
    assert_right(&mesh);
    assert_eq!(mesh.report.parts, 0);
}

#[test]
fn coordinates_beyond_the_device_are_named() {
    let mut device = Device::open("model?coord-bits=8").expect("the model");
    let mut session = device.session().expect("a session");
    let error = session.triangulate(&[(0, 0), (255, 255), (3, 256)]).expect_err("too wide");
    assert!(matches!(error, Error::CoordinateOutOfRange { index: 2, y: 256, coord_bits: 8, .. }));
    assert_eq!(error.kind(), ErrorKind::BadInput);
    let mut device = Device::open("model?coord-bits=31").expect("the model");
    let mut session = device.session().expect("a session");
    let wide = session.triangulate(&[(0, 0), (u32::MAX, 0), (0, 1)]).expect_err("beyond 31 bits");
    assert!(matches!(wide, Error::CoordinateOutOfRange { index: 1, coord_bits: 31, .. }));
}

#[test]
fn progress_covers_all_stages_and_cancels_anywhere() {
    let points = Random(8).points(2000, 1 << 16);
    let mut device = Device::open("model").expect("the model");
    let mut session = device.session().expect("a session");
    let calls = RefCell::new(Vec::new());
    let listen = |progress| {
        calls.borrow_mut().push(progress);
        ControlFlow::Continue(())
    };
    let options = Options::default().progress(&listen).insert_chunk(500);
    let expected = session.triangulate_with(&points, &options).expect("a mesh");
    let calls = calls.into_inner();
    for stage in [Stage::Order, Stage::Insert, Stage::Read, Stage::Assemble] {
        assert!(calls.iter().any(|call| call.stage == stage), "{stage:?}");
        assert!(expected.report.stage(stage).is_some(), "{stage:?}");
    }
    for stop in 0..calls.len() {
        let left = RefCell::new(stop);
        let listen = |_| match left.replace_with(|left| left.wrapping_sub(1)) {
            0 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        };
        let options = Options::default().progress(&listen).insert_chunk(500);
        let error = session.triangulate_with(&points, &options).expect_err("cancelled");
        assert_eq!(error.kind(), ErrorKind::Cancelled);
    }
    let again = session.triangulate(&points).expect("the session is still good");
    assert_eq!(again.mesh.triangles, expected.mesh.triangles);
}

#[test]
fn a_passed_deadline_is_a_timeout() {
    let points = Random(9).points(5000, 1 << 16);
    let mut device = Device::open("model").expect("the model");
    let mut session = device.session().expect("a session");
    let options = Options::default().timeout(Duration::from_nanos(1));
    let error = session.triangulate_with(&points, &options).expect_err("too late");
    assert_eq!(error.kind(), ErrorKind::Timeout);
    let error = session.triangulate(&points).expect_err("the link is out of step");
    assert!(matches!(error, Error::OutOfStep { .. }), "{error}");
}

#[test]
fn pairs_arrays_and_vectors_are_points() {
    let expected = solved(&[Point::new(0, 0), Point::new(9, 0), Point::new(0, 9)]).mesh.triangles;
    assert_eq!(expected, [[0, 1, 2]]);
    let pairs = [(0, 0), (9, 0), (0, 9)];
    let arrays = pairs.map(|(x, y)| [x, y]);
    let vectors = pairs.map(|(x, y)| glam::UVec2::new(x, y));
    assert_eq!(triangulate(&pairs).expect("pairs").triangles, expected);
    assert_eq!(triangulate(&arrays).expect("arrays").triangles, expected);
    let mut device = Device::open("model").expect("the model");
    let mut session = device.session().expect("a session");
    assert_eq!(session.triangulate(&vectors).expect("vectors").mesh.triangles, expected);
}

#[test]
fn counters_count_the_insertions() {
    let points = Random(10).points(1000, 1 << 16);
    let mesh = solved(&points);
    let counters = mesh.report.counters.expect("the device was asked");
    assert_eq!(counters.insertions as usize, mesh.report.distinct);
    assert_eq!((counters.duplicates, counters.refused), (0, 0));
    assert!(counters.walk_visits > 0 && counters.tests > 0);
}
