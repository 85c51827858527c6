//! Several devices that share the work on one set: the same mesh, whoever dies.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::panic::AssertUnwindSafe;
use std::time::{Duration, Instant};

use crate::common::card::{card, Mischief};
use crate::common::liar::Liar;
use crate::common::mock::Mock;
use crate::common::{assert_right, by_cpu, Random};
use incircle::{Device, Error, ErrorKind, Fleet, Options, Point, Report, Stage};
use incircle_protocol::Opcode;

fn points() -> Vec<Point> {
    let mut points = Random(41).points(20_000, 1 << 16);
    points.extend_from_within(..500);
    points
}

/// Adds up the shares, which must cover the whole set.
fn check_shares(report: &Report) {
    assert_eq!(report.shares.iter().map(|share| share.parts).sum::<usize>(), report.parts);
    assert_eq!(report.shares.iter().map(|share| share.points).sum::<usize>(), report.distinct);
}

#[test]
fn devices_of_all_kinds_share_a_set() {
    let points = points();
    let right = by_cpu(&points).mesh;
    for addresses in [
        &["cpu?threads=1"][..],
        &["clock?config=small"],
        &["cpu?threads=1", "model", "clock?config=quad"],
        &["model?capacity=100", "model?capacity=3000", "model?coord-bits=20"],
    ] {
        let fleet = Fleet::open(addresses).expect("addresses");
        let solution = fleet.triangulate(&points, &Options::default()).expect("a mesh");
        assert!(solution.mesh == right, "{addresses:?}");
        assert_right(&solution);
        check_shares(&solution.report);
        assert_eq!(solution.report.shares.len(), addresses.len());
        assert!(solution.report.shares.iter().all(|share| share.left_out.is_none()));
        assert!(solution.report.stage(Stage::Insert).is_some());
    }
}

#[test]
fn small_sets_and_lines_are_right() {
    let fleet = Fleet::open(&["model?capacity=50", "cpu?threads=1"]).expect("addresses");
    let mut random = Random(5);
    for count in [0, 1, 2, 3, 50, 1024, 1025, 3000] {
        for side in [1, 7, 1 << 16] {
            let points = random.points(count, side);
            let solution = fleet.triangulate(&points, &Options::default()).expect("a mesh");
            assert_eq!(solution.mesh, by_cpu(&points).mesh, "{count} {side}");
            if solution.report.parts > 0 {
                check_shares(&solution.report);
            } else {
                assert!(solution.report.collinear && solution.report.shares.iter().all(|share| share.points == 0));
            }
        }
    }
    let line: Vec<Point> = (0..5000).map(|k| Point::new(k * 7, k * 3)).collect();
    assert_eq!(fleet.triangulate(&line, &Options::default()).expect("a line").mesh, by_cpu(&line).mesh);
}

/// Devices that die: before the first word, in the middle, and by lies of all kinds.
#[test]
fn devices_that_die_are_left_out() {
    let points = points();
    let right = by_cpu(&points).mesh;
    let gone = |number| move || Ok(card(64, Mischief { gone: Some(number), ..Mischief::default() }));
    let liar = || {
        let lie = |opcode: Opcode, answer: &mut Vec<u32>| {
            if opcode == Opcode::Triangles && answer.len() > 40 {
                answer[20] ^= 5;
            }
        };
        Ok(Device::from_transport(Box::new(Liar::new(16, lie))))
    };
    let fleet = Fleet::default()
        .with("absent".to_owned(), || Device::open("serial:/dev/absent"))
        .with("gone".to_owned(), gone(0))
        .with("late".to_owned(), gone(40))
        .with("liar".to_owned(), liar)
        .with("mock".to_owned(), || Ok(Mock::device(true, true, (5000, 1))))
        .with("cpu".to_owned(), || Ok(Device::cpu(None)));
    let solution = fleet.triangulate(&points, &Options::default()).expect("one device is enough");
    assert!(solution.mesh == right);
    check_shares(&solution.report);
    let left_out: Vec<bool> = solution.report.shares.iter().map(|share| share.left_out.is_some()).collect();
    assert!(left_out[0] && left_out[1] && !left_out[5], "{:?}", solution.report.shares);
    assert!(solution.report.shares[5].parts > 0);
}

#[test]
fn without_any_device_the_last_error_stands() {
    let points = points();
    let error = Fleet::default().triangulate(&points, &Options::default()).expect_err("nobody is there");
    assert_eq!(error.kind(), ErrorKind::DeviceNotFound);
    let fleet = Fleet::default()
        .with("absent".to_owned(), || Device::open("serial:/dev/absent"))
        .with("gone".to_owned(), || Ok(card(64, Mischief { gone: Some(30), ..Mischief::default() })));
    let error = fleet.triangulate(&points, &Options::default()).expect_err("both fail");
    assert!(matches!(error.kind(), ErrorKind::Link | ErrorKind::Device | ErrorKind::Timeout), "{error}");
    assert!(matches!(Fleet::open(&["cpu", "nonsense"]), Err(Error::Address { .. })));
}

#[test]
fn bad_points_are_refused_before_the_work() {
    let fleet = Fleet::open(&["model?coord-bits=8", "cpu"]).expect("addresses");
    let error = fleet.triangulate(&[(0, 0), (255, 255), (3, 256)], &Options::default()).expect_err("9 bits");
    assert!(matches!(error, Error::CoordinateOutOfRange { index: 2, coord_bits: 8, .. }), "{error}");
    let error = fleet.triangulate(&[[0.1, f64::NAN]], &Options::default()).expect_err("not a number");
    assert_eq!(error.kind(), ErrorKind::BadInput);
    let doubles = [[0.1, 0.2], [0.3, 1e-300], [1e300, 5.0]];
    let error = fleet.triangulate(&doubles, &Options::default()).expect_err("no lattice");
    assert!(matches!(error, Error::NoLattice { .. }), "{error}");
}

#[test]
fn a_fleet_can_be_cancelled_and_runs_out_of_time() {
    let points = points();
    let fleet = Fleet::open(&["clock?config=tiny", "model?capacity=200"]).expect("addresses");
    for stop in 0..4usize {
        let left: Cell<usize> = Cell::new(stop);
        let listen = |_| match left.replace(left.get().wrapping_sub(1)) {
            0 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        };
        let error = fleet.triangulate(&points, &Options::default().progress(&listen)).expect_err("cancelled");
        assert_eq!(error.kind(), ErrorKind::Cancelled, "{error}");
    }
    let slow = Fleet::open(&["clock?config=tiny"]).expect("an address");
    let error =
        slow.triangulate(&points, &Options::default().timeout(Duration::from_millis(30))).expect_err("too late");
    assert_eq!(error.kind(), ErrorKind::Timeout, "{error}");
}

/// A device whose answers stop does not keep the others waiting for ever, and neither does code that panics.
#[test]
fn silence_and_panics_end() {
    let points = points();
    let silent = || Ok(card(64, Mischief { silent: Some(3), ..Mischief::default() }));
    let fleet = Fleet::default().with("silent".to_owned(), silent).with("cpu".to_owned(), || Ok(Device::cpu(None)));
    let since = Instant::now();
    // If the silent device has taken parts, the time is over before they are done. If `cpu` was quicker, all is done.
    match fleet.triangulate(&points, &Options::default().timeout(Duration::from_millis(500))) {
        Ok(solution) => assert!(solution.mesh == by_cpu(&points).mesh),
        Err(error) => assert_eq!(error.kind(), ErrorKind::Timeout, "{error}"),
    }
    assert!(since.elapsed() < Duration::from_secs(10), "{:?}", since.elapsed());
    let fleet = Fleet::default()
        .with("broken".to_owned(), || panic!("the caller's code panics"))
        .with("cpu".to_owned(), || Ok(Device::cpu(None)));
    let caught = std::panic::catch_unwind(AssertUnwindSafe(|| fleet.triangulate(&points, &Options::default()).is_ok()));
    assert!(caught.is_err(), "the panic reaches the caller");
}
