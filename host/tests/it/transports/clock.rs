//! The core's model, clock by clock, through the library: the mesh is the software model's, and the counters agree.

use std::time::Duration;

use crate::common::{assert_right, by_model, Random};
use incircle::{triangulate, Device, Error, ErrorKind, Options, Order, Point};
use incircle_protocol::{Config, FIRST_ROUND, LARGE, NAMED, SMALL};

fn with_contexts(contexts: u32) -> Options<'static> {
    Options::default().contexts(contexts)
}

#[test]
fn contexts_change_the_time_and_not_the_mesh() {
    let points = Random(21).points(600, 1 << 16);
    let expected = triangulate(&points).expect("a mesh");
    let mut device = Device::open("clock?config=large").expect("the clock model");
    let mut session = device.session().expect("a session");
    let mut cycles = Vec::new();
    for contexts in [1, 2, 4, 8] {
        let solution = session.triangulate_with(&points, &with_contexts(contexts)).expect("a mesh");
        assert_right(&solution);
        assert_eq!((&solution.mesh.triangles, &solution.mesh.hull), (&expected.triangles, &expected.hull));
        assert_eq!((solution.report.contexts, solution.report.backend.as_str()), (contexts, "clock:large"));
        cycles.push(solution.report.cycles_per_insertion().expect("there is a clock"));
    }
    assert!(cycles.windows(2).all(|pair| pair[1] < 0.85 * pair[0]), "{cycles:?}");
    let all = session.triangulate(&points).expect("a mesh");
    assert_eq!(all.report.contexts, LARGE.contexts);
    assert_eq!(all.mesh.triangles, expected.triangles);
}

#[test]
fn jobs_count_the_same_whenever_they_run() {
    let points = Random(22).points(300, 1 << 16);
    let mut device = Device::clock_model(SMALL).expect("the clock model");
    let mut session = device.session().expect("a session");
    let first = session.triangulate(&points).expect("a mesh").report;
    session.triangulate(&points[..100]).expect("a mesh");
    let again = session.triangulate(&points).expect("a mesh").report;
    assert_eq!((first.counters, first.latencies), (again.counters, again.latencies));
}

#[test]
fn counters_and_latencies_agree() {
    let points = Random(23).points(700, 1 << 16);
    let mut device = Device::clock_model(SMALL).expect("the clock model");
    let mut session = device.session().expect("a session");
    for contexts in 1..=SMALL.contexts {
        let report = session.triangulate_with(&points, &with_contexts(contexts)).expect("a mesh").report;
        let counters = report.counters.expect("the device was asked");
        assert_eq!(counters.insertions as usize, report.distinct);
        assert!(counters.wait_cycles < counters.insert_cycles);
        for cycles in [counters.issue_cycles, counters.write_cycles, counters.commit_cycles, counters.release_cycles] {
            assert!(cycles > 0 && u64::from(cycles) < counters.insert_cycles, "{counters:?}");
        }
        assert_eq!(counters.aborts > 0, contexts > 1, "{contexts}: {counters:?}");
        let latencies = report.latencies.expect("there is a clock");
        assert_eq!(latencies.insertions, u64::from(counters.insertions - 3 - counters.overflows));
        assert_eq!((latencies.min, latencies.max), (counters.latency_min, counters.latency_max));
        assert!(latencies.min <= latencies.median && latencies.median <= latencies.p99);
        assert!(latencies.p99 <= latencies.max && latencies.min > 30, "{latencies:?}");
    }
}

#[test]
fn the_software_model_has_no_latencies() {
    let points = Random(24).points(100, 1 << 16);
    let report = by_model(&points).report;
    assert_eq!((report.latencies, report.contexts), (None, 1));
}

#[test]
fn hard_sets_on_every_configuration() {
    let mut random = Random(25);
    for config in NAMED {
        let config = Config { points: config.points.min(1024), ..config };
        let mut device = Device::clock_model(config).expect("the clock model");
        let mut session = device.session().expect("a session");
        for side in [2, 3, 4, 6, 9, 40] {
            for order in Order::BASIC {
                let count = 1 + random.below(config.points.min(200)) as usize;
                let points = random.points(count, side);
                let solution = session.triangulate_with(&points, &Options::default().order(order)).expect("a mesh");
                assert_right(&solution);
                assert_eq!(solution.mesh.triangles, triangulate(&points).expect("a mesh").triangles);
            }
        }
    }
}

#[test]
fn contexts_that_are_not_there_are_refused_and_the_session_goes_on() {
    let points: Vec<Point> = Random(26).points(FIRST_ROUND as usize, 1 << 16);
    for (address, has) in [("clock?config=tiny", 2), ("clock?config=small", 16), ("model", 1)] {
        let mut device = Device::open(address).expect("it opens");
        let mut session = device.session().expect("a session");
        for asked in [0, has + 1, 255, 256, u32::MAX] {
            let error = session.triangulate_with(&points[..8], &with_contexts(asked)).expect_err("not there");
            assert_eq!(error.kind(), ErrorKind::BadChoice, "{error}");
            assert!(matches!(error, Error::Contexts { asked: a, contexts, .. } if a == asked && contexts == has));
            let choice = if has == 1 { "1,".to_owned() } else { format!("1 to {has},") };
            assert!(error.to_string().contains(&format!("{asked} contexts: choose {choice}")), "{error}");
        }
        assert_right(&session.triangulate_with(&points[..8], &with_contexts(has)).expect("a mesh"));
    }
}

#[test]
fn a_passed_deadline_is_a_timeout() {
    let points = Random(27).points(1000, 1 << 16);
    let mut device = Device::clock_model(SMALL).expect("the clock model");
    let mut session = device.session().expect("a session");
    let options = Options::default().timeout(Duration::from_millis(2));
    let error = session.triangulate_with(&points, &options).expect_err("too late");
    assert_eq!(error.kind(), ErrorKind::Timeout, "{error}");
}
