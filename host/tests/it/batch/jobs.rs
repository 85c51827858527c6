//! Batches: every job gets the mesh that it gets alone, on every device, whatever the other jobs are.

use crate::common::batches::{alone, bare, batch, check_cancelled};
use crate::common::mock::Mock;
use crate::common::Random;
use incircle::{Config, Device, DeviceFault, Error, ErrorKind, Options, Order, Point};
use incircle_protocol::{FULL, SMALL};
use proptest::prelude::*;

/// Sets of every kind: no points, one, two, collinear ones, duplicates, lattices, and larger sets.
fn mixed(random: &mut Random, count: usize, most: u32) -> Vec<Vec<Point>> {
    let mut jobs = Vec::new();
    for job in 0..count {
        let points = random.below(most) as usize;
        let side = [2, 5, 9, 300, 1 << 16][random.below(5) as usize];
        jobs.push(match job % 7 {
            0 => random.points(job % 5, side),
            1 => (0..points as u32).map(|k| Point::new(3 * k, 2 * k)).collect(),
            _ => random.points(points, side),
        });
    }
    jobs
}

#[test]
fn every_device_gives_every_job_its_mesh() {
    let mut random = Random(61);
    let small_ring = Config { ring: 6, contexts: 3, ..SMALL };
    for contexts in [None, Some(1), Some(2)] {
        let jobs = mixed(&mut random, 60, 120);
        let right = alone(&jobs);
        for order in [Order::BrioHilbert, Order::Hilbert, Order::Input] {
            let options = Options::default().contexts(contexts).order(order);
            let is_quick = order == Order::BrioHilbert;
            let devices = [
                Some(Device::model(16, 4096).expect("possible")).filter(|_| contexts != Some(2)),
                Some(Device::cpu(std::num::NonZeroU32::new(3))).filter(|_| contexts != Some(2)),
                Some(Device::clock_model(SMALL).expect("possible")),
                Some(Device::clock_model(small_ring).expect("possible")).filter(|_| is_quick),
                Some(Device::clock_model(FULL).expect("possible")).filter(|_| is_quick),
            ];
            for mut device in devices.into_iter().flatten() {
                let meshes = batch(&mut device, &jobs, &options).expect("meshes");
                assert!(meshes == right, "{contexts:?}, {order:?}");
                // A second batch shows that the session is in step.
                let again = batch(&mut device, &jobs[..20], &options).expect("meshes");
                assert!(again == right[..20], "{contexts:?}, {order:?}");
            }
        }
    }
}

#[test]
fn jobs_too_large_for_a_share_go_one_by_one() {
    let mut random = Random(62);
    let mut jobs = mixed(&mut random, 12, 200);
    jobs.insert(3, random.points(900, 1 << 16));
    jobs.push(random.points(257, 1 << 16));
    let mut device = Device::clock_model(SMALL).expect("possible");
    assert!(batch(&mut device, &jobs, &Options::default()).expect("meshes") == alone(&jobs));
    jobs.push(random.points(1100, 1 << 16));
    // This job does not fit the device at all, so it is done in parts.
    assert!(batch(&mut device, &jobs, &Options::default()).expect("meshes") == alone(&jobs));
}

#[test]
fn nothing_is_a_batch() {
    for mut device in
        [Device::cpu(None), Device::model(16, 64).expect("possible"), Device::clock_model(SMALL).expect("possible")]
    {
        assert!(batch(&mut device, &[], &Options::default()).expect("nothing").is_empty());
        let meshes = batch(&mut device, &[vec![], vec![Point::new(1, 2)]], &Options::default()).expect("two");
        assert_eq!((meshes[0].hull.len(), meshes[1].hull.len()), (0, 1));
    }
}

#[test]
fn errors_name_the_job() {
    let mut random = Random(63);
    let mut jobs = mixed(&mut random, 9, 40);
    jobs[7].push(Point::new(5, 1 << 16));
    let mut device = Device::model(16, 64).expect("possible");
    let error = batch(&mut device, &jobs, &Options::default()).expect_err("outside the grid");
    assert_eq!(error.kind(), ErrorKind::BadInput);
    assert!(error.to_string().starts_with("job 7 of the batch, counted from 0: point "), "{error}");
    let options = Options::default().contexts(5);
    let error = batch(&mut device, &jobs, &options).expect_err("one context");
    assert_eq!(error.kind(), ErrorKind::BadChoice);
}

#[test]
fn a_cancelled_batch_leaves_the_session_in_step() {
    let mut random = Random(64);
    let jobs: Vec<Vec<Point>> = (0..30).map(|_| random.points(40, 1 << 16)).collect();
    let right = alone(&jobs);
    for mut device in [Device::cpu(None), Device::clock_model(SMALL).expect("possible")] {
        for patience in [0, 1, 200, 500] {
            check_cancelled(&mut device, &jobs, &right, patience);
        }
    }
}

#[test]
fn every_kind_of_link_carries_a_batch() {
    let jobs = mixed(&mut Random(66), 40, 90);
    let right = alone(&jobs);
    for (takes_ahead, packs_records) in [(true, true), (true, false), (false, true), (false, false)] {
        let mut device = Mock::device(takes_ahead, packs_records, (0, 0));
        assert!(batch(&mut device, &jobs, &Options::default()).expect("meshes") == right);
    }
}

#[test]
fn lies_end_in_typed_errors() {
    let mut random = Random(67);
    let jobs: Vec<Vec<Point>> = (0..7).map(|job| random.points(4 + 2 * job, 1 << 16)).collect();
    let right = alone(&jobs);
    let (mut kinds, mut mixes) = ([0; 3], 0);
    for packs_records in [true, false] {
        // Lies begin after the identity.
        for place in 9..420 {
            for bits in [1, 1 << 4, 1 << 16, 1 << 20, 1 << 31, 0xffff_ffff] {
                let mut device = Mock::device(true, packs_records, (place, bits));
                let mut session = device.session().expect("an honest greeting");
                match session.triangulate_batch(&jobs, &Options::default()) {
                    // This lie is after the last word, or in a neighbour's id, which is not used.
                    Ok(meshes) => {
                        assert!(meshes.into_iter().map(bare).eq(right.iter().cloned()), "{place}, {bits:x}");
                        kinds[0] += 1;
                    }
                    Err(Error::Device { fault, .. }) => {
                        mixes += usize::from(matches!(fault, DeviceFault::MixedJobs { .. }));
                        kinds[1] += 1;
                        let again = session.triangulate_batch(&jobs, &Options::default()).expect_err("out of step");
                        assert!(matches!(again, Error::OutOfStep { .. }), "{again}");
                    }
                    Err(error) => {
                        assert_eq!(error.kind(), ErrorKind::Link, "{error}");
                        kinds[2] += 1;
                    }
                }
            }
        }
    }
    assert!(kinds[0] > 100 && kinds[1] > 1000 && mixes > 100, "{kinds:?} {mixes}");
}

#[test]
fn clocks_are_counted_where_there_are_any() {
    let mut random = Random(65);
    let jobs: Vec<Vec<Point>> = (0..32).map(|_| random.points(200, 1 << 16)).collect();
    let mut device = Device::clock_model(FULL).expect("possible");
    let mut session = device.session().expect("a session");
    let before = session.clocks().expect("a clock");
    session.triangulate_batch(&jobs, &Options::default()).expect("meshes");
    let clocks = session.clocks().expect("a clock") - before;
    let cycles = clocks as f64 / 6400.0;
    println!("{cycles:.2} cycles a point");
    assert!(cycles < 25.0, "{cycles}");
    assert_eq!(Device::cpu(None).session().expect("a session").clocks(), None);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    #[test]
    fn any_sets_of_points(
        raw in prop::collection::vec(prop::collection::vec((0u32..9, 0u32..9), 0..25), 0..12),
        shift in prop::sample::select(vec![0u32, 12]),
    ) {
        let point = |(x, y): (u32, u32)| Point::new(x << shift, y << shift);
        let jobs: Vec<Vec<Point>> = raw.into_iter().map(|job| job.into_iter().map(point).collect()).collect();
        let right = alone(&jobs);
        for mut device in [Device::cpu(None), Device::clock_model(SMALL).expect("possible")] {
            prop_assert!(batch(&mut device, &jobs, &Options::default()).expect("meshes") == right);
        }
    }
}
