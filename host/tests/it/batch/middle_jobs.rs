//! Jobs of which a few fit into a device, but fewer than it has contexts. Whether they go side by side or one after
//! another, each gets the mesh that it gets alone.

use crate::common::batches::{alone, bare, batch};
use crate::common::mock::Mock;
use crate::common::Random;
use incircle::{Device, Options, Point, Solution};
use incircle_protocol::{Config, FULL, SMALL};
use proptest::prelude::*;

/// Points that the mock holds, and the number of its contexts.
const CAPACITY: usize = 512;
const CONTEXTS: usize = 5;

/// Jobs with these numbers of points, all points of a job distinct.
fn jobs_of(random: &mut Random, lengths: &[usize]) -> Vec<Vec<Point>> {
    lengths.iter().map(|&count| distinct(random, count)).collect()
}

fn distinct(random: &mut Random, count: usize) -> Vec<Point> {
    let mut points = Vec::new();
    while points.len() < count {
        let point = Point::new(random.below(1 << 16), random.below(1 << 16));
        if !points.contains(&point) {
            points.push(point);
        }
    }
    points
}

/// Whether the job had the whole memory, which shows in its counters.
fn is_exclusive(mesh: &Solution) -> bool {
    mesh.report.counters.is_some()
}

#[test]
fn the_capacity_may_be_reached_exactly() {
    let mut random = Random(81);
    let fifth = CAPACITY / CONTEXTS;
    for lengths in [
        vec![fifth; 5],
        vec![fifth + 1, fifth + 1, fifth, fifth, fifth],
        vec![128; 4],
        // These exceed the capacity by one, or go one after another.
        vec![fifth + 1, fifth + 1, fifth + 1, fifth, fifth],
        vec![129, 128, 128, 128],
        vec![171; 3],
        vec![CAPACITY, 60, 60],
        vec![CAPACITY; 2],
    ] {
        let sum: usize = lengths.iter().sum();
        let jobs = jobs_of(&mut random, &lengths);
        for (takes_ahead, packs_records) in [(true, true), (true, false), (false, true), (false, false)] {
            let mut device = Mock::device(takes_ahead, packs_records, (0, 0));
            let mut session = device.session().expect("a session");
            let meshes = session.triangulate_batch(&jobs, &Options::default()).expect("meshes");
            // No job of a group is more than a point shorter than the longest, so the sum is the number of points sent.
            let is_divided = sum > CAPACITY;
            // The smaller groups of a divided batch have contexts to spare.
            let has_more = |mesh: &Solution| is_exclusive(mesh) || mesh.report.contexts > 1;
            assert_eq!(meshes.iter().any(has_more), is_divided, "{lengths:?}");
            assert!(meshes.into_iter().map(bare).eq(alone(&jobs)), "{lengths:?}");
        }
    }
}

#[test]
fn a_job_too_large_for_the_device_goes_in_parts() {
    let mut random = Random(82);
    let jobs = jobs_of(&mut random, &[170, 90, 171, 130, 260, 100, 170]);
    let right = alone(&jobs);
    for takes_ahead in [true, false] {
        let mut device = Mock::device(takes_ahead, true, (0, 0));
        let mut session = device.session().expect("a session");
        for place in 0..=jobs.len() {
            let mut jobs = jobs.clone();
            jobs.insert(place, distinct(&mut random, CAPACITY + 1));
            let solutions = session.triangulate_batch(&jobs, &Options::default()).expect("meshes");
            assert!(solutions.iter().enumerate().all(|(job, solution)| (solution.report.parts > 1) == (job == place)));
            let mut meshes: Vec<_> = solutions.into_iter().map(bare).collect();
            assert_eq!(meshes.remove(place), alone(&jobs[place..=place])[0]);
            assert_eq!(meshes, right);
        }
    }
}

#[test]
fn every_core_gives_every_length_its_mesh() {
    let mut random = Random(83);
    let lengths = |parts: &[usize], points: u32| -> Vec<usize> {
        let near = |&part: &usize| [points as usize / part - 1, points as usize / part, points as usize / part + 1];
        parts.iter().flat_map(near).filter(|&length| length <= points as usize).collect()
    };
    for (config, parts) in [
        (SMALL, vec![4, 4, 4, 3, 3, 2, 5, 6, 1]),
        (Config { ring: 6, contexts: 3, ..SMALL }, vec![3, 3, 2, 4, 4]),
        (FULL, vec![7, 7, 7, 8, 8, 15, 16, 17, 6]),
    ] {
        let mut jobs = jobs_of(&mut random, &lengths(&parts, config.points));
        // Two of the jobs have fewer distinct points than the host expects before it has looked at them.
        jobs[1].extend_from_within(..40);
        jobs[2] = (0..300).map(|k| Point::new(2 * k, 3 * k)).collect();
        let mut device = Device::clock_model(config).expect("possible");
        assert!(batch(&mut device, &jobs, &Options::default()).expect("meshes") == alone(&jobs), "{}", config.name);
    }
}

/// The clocks counted are the same on every machine, so this test does not depend on the speed of this one.
#[test]
fn side_by_side_they_take_fewer_clocks_than_one_after_the_other() {
    let mut random = Random(84);
    let mut device = Device::clock_model(FULL).expect("possible");
    let mut session = device.session().expect("a session");
    for (count, length, most) in
        [(15, 520, 18), (10, 800, 19), (8, 1000, 18), (7, 1170, 20), (4, 2000, 18), (2, 4000, 19)]
    {
        let jobs = jobs_of(&mut random, &vec![length; count]);
        let before = session.clocks().expect("it is counted");
        let meshes = session.triangulate_batch(&jobs, &Options::default()).expect("meshes");
        let together = session.clocks().expect("it is counted") - before;
        assert!(!meshes.iter().any(is_exclusive), "{count} jobs of {length}");
        assert!(together < most * (count * length) as u64, "{together} clocks for {count} jobs of {length}");
        // The job of a batch of one is exclusive, with as many contexts as pay.
        let before = session.clocks().expect("it is counted");
        for job in &jobs {
            let alone = session.triangulate_batch(std::slice::from_ref(job), &Options::default()).expect("a mesh");
            assert!(is_exclusive(&alone[0]) && (8..=16).contains(&alone[0].report.contexts), "{:?}", alone[0].report);
        }
        let one_by_one = session.clocks().expect("it is counted") - before;
        assert!(together < one_by_one, "{together} and {one_by_one} clocks for {count} jobs of {length}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    #[test]
    fn any_lengths_around_the_thresholds(
        raw in prop::collection::vec((1usize..7, 0usize..5, any::<bool>()), 0..14),
        contexts in 1u32..6,
        takes_ahead in any::<bool>(),
        seed in any::<u64>(),
    ) {
        let mut random = Random(seed);
        let job = |(parts, more, is_crowded): (usize, usize, bool)| {
            let count = (CAPACITY / parts + more - 2).min(CAPACITY);
            random.points(count, if is_crowded { 20 } else { 1 << 16 })
        };
        let jobs: Vec<Vec<Point>> = raw.into_iter().map(job).collect();
        let options = Options::default().contexts(contexts);
        let mut device = Mock::device(takes_ahead, true, (0, 0));
        prop_assert!(batch(&mut device, &jobs, &options).expect("meshes") == alone(&jobs));
    }
}

#[test]
fn a_job_left_over_has_as_many_contexts_as_pay_whether_it_is_sent_ahead_or_not() {
    let jobs = jobs_of(&mut Random(84), &[20]);
    let contexts = [true, false].map(|takes_ahead| {
        let mut device = Mock::device(takes_ahead, true, (0, 0));
        let mut session = device.session().expect("a session");
        let meshes = session.triangulate_batch(&jobs, &Options::default()).expect("meshes");
        meshes[0].report.contexts as usize
    });
    assert!(contexts[0] == contexts[1] && (1..CONTEXTS).contains(&contexts[0]), "{contexts:?}");
}
