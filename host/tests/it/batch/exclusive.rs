//! Exclusive jobs of a batch: each has the whole memory of the device, and is sent while the previous one is under way.

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::time::Duration;

use crate::common::batches::{alone, bare, batch, check_cancelled};
use crate::common::card::{card, watched_card, Mischief};
use crate::common::mock::Mock;
use crate::common::Random;
use incircle::{Device, Error, ErrorKind, Options, Order, Point, Progress, Stage};
use incircle_protocol::{Config, FULL, SMALL};

/// Jobs that are exclusive on a device for 512 points and 5 contexts, with small jobs, jobs on a
/// line and duplicates among them.
fn mixed(random: &mut Random, count: usize) -> Vec<Vec<Point>> {
    let job = |place: usize| {
        let points = 257 + random.below(250) as usize;
        match place % 6 {
            1 => random.points(place, 1 << 16),
            3 => (0..points as u32).map(|k| Point::new(2 * k, 5 * k)).collect(),
            4 => random.points(points, 9),
            _ => random.points(points, 1 << 16),
        }
    };
    (0..count).map(job).collect()
}

#[test]
fn exclusive_jobs_go_in_any_order() {
    let jobs = mixed(&mut Random(78), 12);
    let right = alone(&jobs);
    for order in [Order::Input, Order::Random, Order::Hilbert] {
        let (mut device, _) = Mock::watched(true, true, (0, 0));
        let options = Options::default().order(order);
        assert!(batch(&mut device, &jobs, &options).expect("meshes") == right, "{order:?}");
    }
}

#[test]
fn every_kind_of_link_carries_exclusive_jobs() {
    let jobs = mixed(&mut Random(71), 30);
    let right = alone(&jobs);
    for (takes_ahead, packs_records) in [(true, true), (true, false), (false, true), (false, false)] {
        for contexts in [None, Some(1), Some(2)] {
            let (mut device, most_ahead) = Mock::watched(takes_ahead, packs_records, (0, 0));
            let options = Options::default().contexts(contexts);
            assert!(batch(&mut device, &jobs, &options).expect("meshes") == right, "{takes_ahead}, {contexts:?}");
            // The next job is sent ahead, but no more than that.
            assert_eq!(most_ahead.get(), 1 + usize::from(takes_ahead));
        }
    }
    for beat_bits in [64, 128] {
        assert!(batch(&mut card(beat_bits, Mischief::default()), &jobs, &Options::default()).expect("meshes") == right);
    }
    for config in [SMALL, FULL, Config { ring: 6, contexts: 3, ..SMALL }] {
        let mut device = Device::clock_model(config).expect("possible");
        assert!(batch(&mut device, &jobs, &Options::default()).expect("meshes") == right, "{}", config.name);
    }
}

#[test]
fn exclusive_jobs_of_wide_points_and_jobs_too_large_to_be_sent_ahead() {
    let mut random = Random(72);
    let jobs = [9000, 65_600, 8193, 300].map(|count| random.points(count, 1 << 20));
    let mut device = Device::model(20, 70_000).expect("possible");
    assert!(batch(&mut device, &jobs, &Options::default()).expect("meshes") == alone(&jobs));
}

#[test]
fn an_exclusive_job_beyond_the_capacity_goes_in_parts() {
    let mut random = Random(73);
    let mut jobs = mixed(&mut random, 8);
    let right = alone(&jobs);
    // More points than the capacity do no harm, so long as there are not more distinct ones.
    let mut crowd = random.points(512, 1 << 16);
    crowd.extend_from_within(..200);
    jobs.push(crowd);
    for takes_ahead in [true, false] {
        let mut device = Mock::device(takes_ahead, true, (0, 0));
        assert!(batch(&mut device, &jobs, &Options::default()).expect("meshes") == alone(&jobs));
        for place in 0..8 {
            let mut jobs = jobs.clone();
            jobs.insert(place, random.points(600, 1 << 16));
            let mut session = device.session().expect("a session");
            let solutions = session.triangulate_batch(&jobs, &Options::default()).expect("meshes");
            assert!(solutions[place].report.parts > 1);
            assert!(solutions.into_iter().map(bare).eq(alone(&jobs)));
            jobs.remove(place);
            let meshes = session.triangulate_batch(&jobs[..8], &Options::default()).expect("in step");
            assert!(meshes.into_iter().map(bare).eq(right.iter().cloned()));
        }
    }
}

#[test]
fn a_batch_of_exclusive_jobs_can_be_cancelled_anywhere() {
    let jobs = mixed(&mut Random(74), 12);
    let right = alone(&jobs);
    let total: usize = jobs.iter().map(Vec::len).sum();
    let devices = [
        Mock::device(true, true, (0, 0)),
        Mock::device(false, true, (0, 0)),
        Device::clock_model(SMALL).expect("possible"),
        card(64, Mischief::default()),
    ];
    for mut device in devices {
        for patience in [0, 300, total / 2, total - 1, total] {
            check_cancelled(&mut device, &jobs, &right, patience);
        }
    }
}

#[test]
fn progress_never_goes_back() {
    let mut random = Random(75);
    let mut jobs = mixed(&mut random, 12);
    jobs.push(random.points(9000, 1 << 16));
    let total: usize = jobs.iter().map(Vec::len).sum();
    let fits = |capacity: usize| jobs.iter().filter(|job| job.len() <= capacity).cloned().collect::<Vec<_>>();
    let devices = [
        (Device::cpu(None), jobs.clone()),
        (Device::model(16, 9000).expect("possible"), jobs.clone()),
        (Device::clock_model(FULL).expect("possible"), fits(8192)),
        (Mock::device(false, true, (0, 0)), fits(512)),
        // On this card a job is done twice, since a read fails.
        (card(64, Mischief { bad_read: Some((9, 5)), ..Mischief::default() }), fits(1024)),
    ];
    for (mut device, jobs) in devices {
        let told = RefCell::new(Vec::new());
        let listener = |progress: Progress| {
            told.borrow_mut().push((progress.stage == Stage::Insert, progress.done, progress.total));
            ControlFlow::Continue(())
        };
        let options = Options::default().progress(&listener);
        batch(&mut device, &jobs, &options).expect("meshes");
        let told = told.into_inner();
        assert!(told.is_sorted() && told.iter().all(|&(_, done, total)| done <= total), "{told:?}");
        let points: usize = jobs.iter().map(Vec::len).sum();
        assert!(points <= total && told.last() == Some(&(true, points, points)), "{told:?}");
    }
}

#[test]
fn a_transfer_that_fails_once_costs_no_job() {
    let jobs = mixed(&mut Random(76), 16);
    let right = alone(&jobs);
    // The number of reads and of writes that the batch took.
    let run = |mischief| {
        let (mut device, card) = watched_card(64, mischief);
        assert!(batch(&mut device, &jobs, &Options::default()).expect("meshes") == right, "{mischief:?}");
        card.transfers()
    };
    let (reads, writes) = run(Mischief::default());
    assert!(reads > 20 && writes > 5, "{reads} {writes}");
    for errno in [5, 512] {
        // The greeting is left out: transfers are numbered from 0.
        for number in 1..writes {
            run(Mischief { bad_write: Some((number, errno)), ..Mischief::default() });
        }
        for number in 1..reads.min(30) {
            run(Mischief { bad_read: Some((number, errno)), ..Mischief::default() });
        }
        // One fault in the first jobs, and one in later ones.
        for number in 20..reads.min(40) {
            run(Mischief { bad_write: Some((1, errno)), bad_read: Some((number, errno)), ..Mischief::default() });
        }
    }
}

#[test]
fn a_card_that_is_lost_ends_the_batch_with_the_job() {
    let jobs: Vec<Vec<Point>> = (0..6).map(|_| Random(77).points(400, 1 << 16)).collect();
    let options = Options::default().timeout(Duration::from_secs(20));
    // Each job takes four reads, after the one of the greeting. The read of this number may be the last that brings
    // something, or the first that brings nothing.
    for number in 1..24 {
        let mut lost = card(64, Mischief { gone: Some(number), ..Mischief::default() });
        match batch(&mut lost, &jobs, &options) {
            Err(Error::InJob { job, source }) => {
                assert!(source.to_string().contains("the card is gone"), "{source}");
                assert!((number as usize - 1) / 4 == job || number as usize / 4 == job, "{job} at {number}");
            }
            other => panic!("{number}: {:?}", other.err()),
        }
    }
    let error = batch(&mut card(64, Mischief { silent: Some(6), ..Mischief::default() }), &jobs, &options);
    assert!(error.expect_err("silence").to_string().contains("errno 512"));
    let options = Options::default().timeout(Duration::from_millis(20));
    let error = batch(&mut card(64, Mischief { silent: Some(1), ..Mischief::default() }), &jobs, &options);
    let error = error.expect_err("silence");
    assert!(matches!(&error, Error::InJob { job: 0, .. }) && error.kind() == ErrorKind::Timeout, "{error}");
    // The time of the job itself, which the caller chose, and that of the job sent ahead.
    assert!(error.to_string().starts_with("job 0 of the batch, counted from 0: "), "{error}");
    assert!(error.to_string().contains(" within 0.02 s and 0.02 s more for the jobs sent ahead: "), "{error}");
}

#[test]
fn lies_about_exclusive_jobs_end_in_typed_errors() {
    let mut random = Random(78);
    let jobs: Vec<Vec<Point>> = (0..3).map(|_| random.points(270, 1 << 16)).collect();
    let right = alone(&jobs);
    let (mut faults, mut others) = (0, 0);
    for packs_records in [true, false] {
        // Lies begin after the identity.
        for place in (9..80).chain((80..2000).step_by(17)) {
            for bits in [1, 1 << 16, 1 << 31, 0xffff_ffff] {
                let mut device = Mock::device(true, packs_records, (place, bits));
                let mut session = device.session().expect("an honest greeting");
                match session.triangulate_batch(&jobs, &Options::default()) {
                    // This lie is after the last word, in a counter, or in a neighbour's id, which is not used.
                    Ok(meshes) => {
                        assert!(meshes.into_iter().map(bare).eq(right.iter().cloned()), "{place}, {bits:x}");
                        others += 1;
                    }
                    Err(Error::InJob { job, source }) => {
                        assert!(job < 3 && matches!(*source, Error::Device { .. } | Error::Link { .. }), "{source}");
                        faults += 1;
                        let again = session.triangulate_batch(&jobs, &Options::default()).expect_err("out of step");
                        assert_eq!(again.kind(), ErrorKind::Link, "{again}");
                    }
                    Err(error) => panic!("{place}, {bits:x}: {error}"),
                }
            }
        }
    }
    assert!(faults > 500 && others > 100, "{faults} {others}");
}

#[test]
fn the_clocks_of_exclusive_jobs_are_all_there_are() {
    let mut random = Random(79);
    let jobs: Vec<Vec<Point>> = (0..5).map(|_| random.points(5000, 1 << 16)).collect();
    let mut device = Device::clock_model(FULL).expect("possible");
    let mut session = device.session().expect("a session");
    let before = session.clocks().expect("a clock");
    let meshes = session.triangulate_batch(&jobs, &Options::default()).expect("meshes");
    let clocks = session.clocks().expect("a clock") - before;
    let of = |of: fn(&incircle::Report) -> Option<u64>| meshes.iter().filter_map(|mesh| of(&mesh.report)).sum::<u64>();
    assert_eq!(of(|report| report.clocks), clocks);
    let inserting = of(|report| Some(report.counters?.insert_cycles));
    let points: u64 = of(|report| Some(report.distinct as u64));
    // The read-out takes two clocks a point.
    let rest = clocks.checked_sub(inserting).expect("inserting is a part of it");
    assert!(2 * points < rest && rest < 3 * points, "{inserting} of {clocks} for {points} points");
    let alone = session.triangulate(&jobs[2]).expect("a mesh").report.counters.expect("counters");
    let with_others = meshes[2].report.counters.expect("counters");
    assert_eq!((alone.insertions, with_others.read_cycles), (with_others.insertions, 0));
    // So many points have work for all contexts.
    assert_eq!(meshes[2].report.contexts, 16);
}
