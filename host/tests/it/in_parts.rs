//! Sets that are larger than the device, which are done in parts: the same mesh, with the same care for progress, time
//! and faults.

use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use crate::common::card::{card, Mischief};
use crate::common::liar::Liar;
use crate::common::mock::Mock;
use crate::common::{assert_right, by_cpu, Random};
use incircle::{Config, Device, DeviceFault, Error, ErrorKind, Options, Point, Progress, Stage};
use incircle_protocol::Opcode;
use incircle_testkit::{generate, Distribution};

/// Two engines of 64 points each.
const TWO: Config = Config { name: "two", points: 64, ring: 6, contexts: 3, engines: 2 };

/// Devices that hold from 8 points on, by every kind of transport in this process.
fn devices() -> Vec<Device> {
    let open = |address: &str| Device::open(address).expect("a device in this process");
    vec![
        open("model?capacity=8"),
        open("model?capacity=100"),
        open("clock?config=tiny"),
        Device::clock_model(TWO).expect("a possible core"),
        Mock::device(true, true, (0, 0)),
        Mock::device(false, false, (0, 0)),
        card(64, Mischief::default()),
    ]
}

/// Points of a kind, of which a third are there twice.
fn points_of(kind: Distribution, count: usize, bits: u32) -> Vec<Point> {
    // Some kinds have no room in a small grid.
    let made = generate(kind, count, bits, 7).or_else(|_| generate(Distribution::Uniform, count, bits, 7));
    let mut points: Vec<Point> = made.expect("a uniform set").into_iter().map(Point::from).collect();
    points.extend_from_within(..points.len() / 3);
    points
}

#[test]
fn every_device_gives_every_set_its_mesh() {
    for kind in Distribution::ALL {
        for bits in [8, 16] {
            let points = points_of(kind, 900, bits);
            let right = by_cpu(&points).mesh;
            for mut device in devices() {
                let mut session = device.session().expect("a session");
                let capacity = session.identity().capacity as usize;
                let solution = session.triangulate(&points).unwrap_or_else(|error| panic!("{}: {error}", kind.name()));
                assert!(solution.mesh == right, "{} at {bits} bits on {}", kind.name(), solution.report.backend);
                assert_right(&solution);
                let is_cut = solution.report.distinct > capacity && !solution.report.collinear;
                assert_eq!(solution.report.parts > 1, is_cut, "{}", kind.name());
            }
        }
    }
}

#[test]
fn sizes_around_the_capacity_are_right() {
    let mut random = Random(31);
    let mut device = Device::open("model?capacity=16").expect("the model");
    let mut session = device.session().expect("a session");
    for count in (0..70).chain([1000]) {
        for side in [4, 9, 1 << 16] {
            let points = random.points(count, side);
            let solution = session.triangulate(&points).expect("a mesh");
            assert_eq!(solution.mesh, by_cpu(&points).mesh);
            assert_eq!(solution.report.parts > 1, solution.report.distinct > 16 && !solution.report.collinear);
        }
    }
}

#[test]
fn doubles_on_a_lattice_go_in_parts_too() {
    let points: Vec<[f64; 2]> =
        Random(3).points(500, 1000).iter().map(|p| [f64::from(p.x) * 0.25 - 7.0, f64::from(p.y) * 0.25]).collect();
    let mut device = Device::open("model?capacity=60").expect("the model");
    let solution = device.session().expect("a session").triangulate(&points).expect("a mesh");
    solution.mesh.verify().expect("a right mesh");
    assert!(solution.report.parts > 1 && solution.report.lattice.is_some());
}

#[test]
fn the_report_tells_parts_stages_and_clocks() {
    let points = Random(5).points(1000, 1 << 16);
    let mut device = Device::clock_model(TWO).expect("a possible core");
    let mut session = device.session().expect("a session");
    let before = session.clocks().expect("a core has clocks");
    let report = session.triangulate(&points).expect("a mesh").report;
    let after = session.clocks().expect("a core has clocks");
    assert!(report.parts >= 16, "{}", report.parts);
    assert_eq!(report.clocks, Some(after - before));
    assert_eq!((report.engines, report.capacity, report.points), (2, 64, 1000));
    for stage in [Stage::Order, Stage::Insert, Stage::Assemble] {
        assert!(report.stage(stage).is_some(), "{stage:?}");
    }
    assert!(report.counters.is_none() && report.stage(Stage::Read).is_none());
}

#[test]
fn progress_never_goes_back_and_cancels_anywhere() {
    let points = Random(6).points(1500, 1 << 16);
    let right = by_cpu(&points).mesh;
    for mut device in devices() {
        let mut session = device.session().expect("a session");
        let heard: RefCell<Vec<Progress>> = RefCell::default();
        let listen = |progress| {
            heard.borrow_mut().push(progress);
            ControlFlow::Continue(())
        };
        session.triangulate_with(&points, &Options::default().progress(&listen)).expect("a mesh");
        let heard = heard.into_inner();
        let place = |progress: &Progress| match progress.stage {
            Stage::Order => (0, progress.done),
            Stage::Insert => (1, progress.done),
            stage => (2 + usize::from(stage != Stage::Assemble), progress.done),
        };
        assert!(heard.is_sorted_by_key(place), "{heard:?}");
        assert!(heard.iter().all(|progress| progress.done <= progress.total));
        assert_eq!(heard.last().map(|last| last.stage), Some(Stage::Assemble));
        let step = heard.len().div_ceil(12);
        for stop in (0..heard.len()).step_by(step) {
            let left = Cell::new(stop);
            let listen = |_| match left.replace(left.get().wrapping_sub(1)) {
                0 => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            };
            let options = Options::default().progress(&listen);
            let error = session.triangulate_with(&points, &options).expect_err("cancelled");
            assert_eq!(error.kind(), ErrorKind::Cancelled, "{error}");
        }
        assert!(session.triangulate(&points).expect("in step").mesh == right);
    }
}

#[test]
fn a_passed_deadline_is_a_timeout() {
    let points = Random(9).points(20_000, 1 << 16);
    for (address, timeout) in [
        ("model?capacity=100", Duration::from_nanos(1)),
        ("clock?config=tiny", Duration::from_nanos(1)),
        // The model by clock takes some seconds for this set.
        ("clock?config=tiny", Duration::from_millis(20)),
    ] {
        let mut device = Device::open(address).expect("a device");
        let mut session = device.session().expect("a session");
        let result = session.triangulate_with(&points, &Options::default().timeout(timeout));
        assert_eq!(result.map(|_| ()).expect_err("too late").kind(), ErrorKind::Timeout);
    }
}

/// A card that falls silent in the middle of a set is found out at the end of the set's time, not of each part's.
#[test]
fn silence_ends_with_the_time_of_the_set() {
    let points = Random(10).points(20_000, 1 << 16);
    for silent in [2, 9, 30] {
        let mut device = card(64, Mischief { silent: Some(silent), ..Mischief::default() });
        let mut session = device.session().expect("a session");
        let since = Instant::now();
        let options = Options::default().timeout(Duration::from_secs(1));
        let error = session.triangulate_with(&points, &options).map(|_| ()).expect_err("silence");
        assert!(matches!(error.kind(), ErrorKind::Timeout | ErrorKind::Link), "{error}");
        assert!(since.elapsed() < Duration::from_secs(4), "{:?}", since.elapsed());
    }
}

#[test]
fn options_that_no_device_takes_are_refused() {
    let mut device = Device::open("model?capacity=20&coord-bits=8").expect("the model");
    let mut session = device.session().expect("a session");
    let mut points = Random(4).points(100, 256);
    let error = session.triangulate_with(&points, &Options::default().contexts(99)).expect_err("too many contexts");
    assert_eq!(error.kind(), ErrorKind::BadChoice);
    points.push(Point::new(256, 0));
    let error = session.triangulate(&points).expect_err("9 bits");
    assert!(matches!(error, Error::CoordinateOutOfRange { index: 100, x: 256, .. }), "{error}");
}

/// A lie in one of many answers ends in an error or a mesh, never in a panic or an endless loop. Answers of a liar for
/// 64 points are changed in one word.
#[test]
fn lies_about_parts_end_in_errors() {
    let points = Random(12).points(300, 1 << 8);
    let (mut refused, mut right) = (0, 0);
    for lie in 0..400u32 {
        let number = Cell::new(0);
        let liar = Liar::new(16, move |opcode, answer| {
            let own = number.replace(number.get() + 1);
            let place = lie.wrapping_mul(2_654_435_761) as usize % answer.len();
            if own == 4 + lie % 24 && opcode != Opcode::Hello && place > 1 {
                answer[place] ^= 1 << (lie % 7);
            }
        });
        let mut device = Device::from_transport(Box::new(liar));
        match device.session().and_then(|mut session| session.triangulate(&points)) {
            Ok(solution) => right += usize::from(solution.mesh.verify().is_ok()),
            Err(Error::InJob { .. }) => panic!("the caller knows of no jobs"),
            Err(_) => refused += 1,
        }
    }
    assert!(refused > 100 && right > 0, "{refused} refused, {right} right");
}

/// A device that gives sound triangulations of all parts, most of which are not those of Delaunay.
#[test]
fn parts_that_do_not_fit_together_end_in_an_error_or_a_wrong_mesh() {
    let (mut refused, mut wrong) = (0, 0);
    for seed in 0..100 {
        let points = Random(seed).points(300, 1 << 8);
        let mut device = Device::from_transport(Box::new(Liar::new(16, |_, _| {}).stretching()));
        match device.session().and_then(|mut session| session.triangulate(&points)) {
            Ok(solution) => wrong += usize::from(solution.mesh.verify().is_err()),
            Err(error) => {
                assert!(matches!(error, Error::Device { fault: DeviceFault::Unsound, .. }), "{error}");
                refused += 1;
            }
        }
    }
    assert!(refused > 0 && refused + wrong == 100, "{refused} refused, {wrong} wrong");
}
