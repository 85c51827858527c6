//! Divisions fit the device and are the cheapest there are, and the formulas agree with the clocks that the model
//! counts.

use incircle_protocol::{Config, FULL, LARGE, SMALL};
use proptest::prelude::*;

use super::*;
use crate::job::group::{Group, Ordered};
use crate::job::prepare::Prepared;
use crate::{Device, Options, Point};

/// Points spread over the whole grid, from a seed.
fn points(seed: u32, count: usize) -> Vec<Point> {
    let mix = |k: u32| (u64::from(k) + (u64::from(seed) << 32) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let spread = |k: u32| mix(k) ^ mix(k) >> 29;
    let point = |k: u32| spread(k).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 32;
    (0..count as u32).map(|k| Point::new(point(k) as u32 & 0xffff, point(k) as u32 >> 16)).collect()
}

/// Points of a group that are sent, counted one by one.
fn sent(group: &Group, sets: &[Vec<Point>]) -> usize {
    // Asking for more points than `sent` says must bring none. A job alone has no such bound: its order is indexed.
    let beyond = if group.jobs.len() > 1 { 9 } else { 0 };
    let mut count = 0;
    group.for_points(sets, 0..group.sent() + beyond, |_| count += 1);
    assert_eq!(count, group.sent());
    count
}

/// Clocks that the model counts for these jobs in one batch, without the read-out of two clocks a point.
fn counted(config: Config, contexts: u32, jobs: &[Vec<Point>]) -> u64 {
    let mut device = Device::clock_model(config).expect("possible");
    let mut session = device.session().expect("a session");
    let before = session.clocks().expect("it is counted");
    let options = Options::default().contexts(contexts);
    session.triangulate_batch(jobs, &options).expect("meshes");
    let read = 2 * jobs.iter().map(Vec::len).sum::<usize>();
    session.clocks().expect("it is counted") - before - read as u64
}

fn assert_near(counted: u64, expected: u64, percent: u64, what: &str) {
    let expected = expected / CLOCK;
    assert!(100 * counted.abs_diff(expected) <= percent * counted, "{what}: {counted} counted, {expected} expected");
}

#[test]
fn a_group_takes_what_is_expected() {
    for (config, jobs, count) in
        [(FULL, 1, 300), (FULL, 4, 900), (FULL, 8, 400), (FULL, 12, 60), (FULL, 16, 200), (LARGE, 24, 200)]
    {
        let plan = Plan::new(jobs, config.points, true);
        let lengths = vec![count; jobs as usize];
        let (of, expected) = plan.groups(&lengths, 1).last().expect("they fit");
        assert_eq!((of, plan.divide(&lengths)), (jobs as usize, vec![Part::Group { jobs: of, contexts: 1 }]));
        let sets: Vec<_> = (0..jobs).map(|seed| points(seed, count)).collect();
        assert_near(counted(config, jobs, &sets), expected, 10, &format!("{jobs} of {count}"));
    }
}

#[test]
fn a_group_of_teams_takes_what_is_expected() {
    for (config, jobs, contexts, count) in [
        (SMALL, 5, 3, 200),
        (SMALL, 3, 5, 340),
        (SMALL, 2, 7, 500),
        (FULL, 8, 2, 200),
        (FULL, 4, 4, 200),
        (FULL, 8, 2, 1000),
        (FULL, 5, 3, 1600),
        (FULL, 4, 4, 2000),
        (FULL, 2, 8, 4000),
    ] {
        let plan = Plan::new(jobs * contexts, config.points, true);
        let lengths = vec![count; jobs as usize];
        let expected = plan.group_with(&lengths, contexts);
        assert_eq!(plan.groups(&lengths, contexts).last(), Some((jobs as usize, expected)));
        let divided = plan.divide(&lengths);
        assert_eq!(divided, [Part::Group { jobs: jobs as usize, contexts }], "{jobs} of {count}");
        let sets: Vec<_> = (0..jobs).map(|seed| points(seed, count)).collect();
        let what = format!("{jobs} of {count}, {contexts} contexts each");
        assert_near(counted(config, jobs * contexts, &sets), expected, 12, &what);
    }
}

#[test]
fn jobs_that_are_over_cost_next_to_nothing() {
    let lengths = [400, 400, 300, 200, 100, 100, 50, 50, 50, 50, 50, 50];
    let plan = Plan::new(12, FULL.points, true);
    let (mut expected, mut rest) = (0, &lengths[..]);
    for part in plan.divide(&lengths) {
        expected += clocks_of(&plan, part, rest).expect("it fits");
        rest = &rest[part.jobs()..];
    }
    let one_group = plan.group_with(&lengths, 1);
    assert!(expected < one_group, "{expected} and {one_group}");
    let sets: Vec<_> = (0..).zip(lengths).map(|(seed, count)| points(seed, count)).collect();
    assert_near(counted(FULL, 12, &sets), expected, 12, "mixed lengths");
}

#[test]
fn an_exclusive_job_takes_what_is_expected() {
    let mut device = Device::clock_model(LARGE).expect("possible");
    let mut session = device.session().expect("a session");
    let plan = Plan::new(LARGE.contexts, LARGE.points, true);
    for (count, contexts) in [
        (200, 2),
        (200, 6),
        (300, 4),
        (500, 4),
        (500, 12),
        (1000, 8),
        (1000, 14),
        (1300, 16),
        (2000, 15),
        (4000, 16),
        (4000, 20),
    ] {
        let options = Options::default().contexts(contexts);
        let clocks = |seed| {
            let mesh = session.triangulate_with(&points(seed, count), &options).expect("a mesh");
            mesh.report.counters.expect("they are counted").insert_cycles
        };
        let mean = (0..16).map(clocks).sum::<u64>() / 16;
        assert_near(mean, plan.exclusive_with(count, contexts), 12, &format!("{count} points, {contexts} contexts"));
    }
}

#[test]
fn the_full_core_shares_its_memory_up_to_a_half() {
    let plan = Plan::new(FULL.contexts, FULL.points, true);
    for points in (1..8192).step_by(7) {
        assert_eq!(plan.shares(points), points <= 4096, "{points}");
    }
    assert!(plan.shares(4096) && !plan.shares(4097) && !plan.shares(u32::MAX as usize));
    let group = |jobs, contexts| Part::Group { jobs, contexts };
    assert_eq!(plan.divide(&[200; 16]), [group(16, 1)]);
    assert_eq!(plan.divide(&[1000; 16]), [group(8, 2), group(8, 2)]);
    assert_eq!(plan.divide(&[2000; 4]), [group(4, 4)]);
    assert_eq!(plan.divide(&[4096; 5]), [group(2, 8), group(2, 8), Part::Exclusive]);
    assert_eq!(plan.divide(&[4097; 2]), [Part::Exclusive; 2]);
    assert_eq!(plan.divide(&[300; 2]), [group(2, 6)]);
}

#[test]
fn the_full_core_without_teams_shares_its_memory_among_six_jobs_or_more() {
    let plan = Plan::new(FULL.contexts, FULL.points, false);
    // Six jobs of 1,224 points share the memory. Longer ones are quicker one after another.
    for points in 1..8192 {
        assert_eq!(plan.shares(points), points <= 1224, "{points}");
    }
    assert!(!plan.shares(8193) && !plan.shares(u32::MAX as usize));
    let group = |jobs| Part::Group { jobs, contexts: 1 };
    assert_eq!(plan.divide(&[1170; 7]), [group(7)]);
    assert_eq!(plan.divide(&[1224; 6]), [group(6)]);
    assert_eq!(plan.divide(&[1225; 6]), [Part::Exclusive; 6]);
    // A few jobs that are left over go one after another.
    assert_eq!(plan.divide(&[1000; 17]), [group(8), group(8), Part::Exclusive]);
    assert_eq!(plan.divide(&[300; 2]), [Part::Exclusive; 2]);
    assert_eq!(plan.divide(&[]), []);
    assert_eq!([4000, 1000, 10].map(|points| plan.exclusive_contexts(points)), [15, 11, 1]);
}

#[test]
fn one_context_has_one_job_at_a_time_and_no_exclusive_ones() {
    for capacity in [8, 1024, 1 << 20] {
        let plan = Plan::new(1, capacity, true);
        for points in [1, 3, 8, 1000, 8192, 1 << 20] {
            assert_eq!(plan.shares(points), points <= capacity as usize, "{points} of {capacity}");
            if points <= capacity as usize {
                assert_eq!(plan.divide(&[points; 3]), [Part::Group { jobs: 1, contexts: 1 }; 3]);
            }
        }
    }
    assert_eq!(Plan::new(0, 8, true).divide(&[5]), [Part::Group { jobs: 1, contexts: 1 }]);
}

/// Jobs of these lengths. Their points are all the same, since only the counts matter.
fn jobs_of(lengths: &[usize]) -> (Vec<Vec<Point>>, Vec<Ordered>) {
    let sets: Vec<Vec<Point>> = lengths.iter().map(|&count| vec![Point::new(0, 0); count]).collect();
    let ordered = |(job, &count): (usize, &usize)| {
        let order = (0..count as u32).collect();
        Ordered { job, prepared: Prepared { order, duplicates: Vec::new(), collinear: false, starts: Vec::new() } }
    };
    (sets, lengths.iter().enumerate().map(ordered).collect())
}

/// Cost of a part, if it fits, with the points that are sent counted one by one.
fn clocks_of(plan: &Plan, part: Part, lengths: &[usize]) -> Option<u64> {
    let Part::Group { jobs, contexts } = part else {
        return Some(plan.exclusive(lengths[0]).0);
    };
    let own = &lengths[..jobs];
    let (sets, ordered) = jobs_of(own);
    let is_allowed = contexts <= plan.most_of_team && (contexts == 1 || jobs > 1);
    let has_contexts = jobs * contexts as usize <= plan.rounds.len();
    let fits = is_allowed && has_contexts && sent(&Group::sharing(ordered, contexts), &sets) <= plan.capacity;
    fits.then(|| plan.group_with(own, contexts))
}

/// The lowest cost of all divisions, found by trying each of them.
fn fewest(plan: &Plan, lengths: &[usize]) -> u64 {
    if lengths.is_empty() {
        return 0;
    }
    let groups = (1..=lengths.len()).flat_map(|jobs| (1..7).map(move |contexts| Part::Group { jobs, contexts }));
    let parts = std::iter::once(Part::Exclusive).chain(groups);
    let clocks = |part: Part| Some(clocks_of(plan, part, lengths)? + fewest(plan, &lengths[part.jobs()..]));
    parts.filter_map(clocks).min().expect("an exclusive job always fits")
}

proptest! {
    #[test]
    fn every_part_fits_and_no_division_takes_fewer_clocks(
        mut lengths in prop::collection::vec(3usize..70, 0..7),
        contexts in 1u32..7,
        has_teams in any::<bool>(),
        capacity in 70u32..200,
    ) {
        lengths.sort_unstable_by_key(|&points| std::cmp::Reverse(points));
        let plan = Plan::new(contexts, capacity, has_teams);
        let (mut clocks, mut rest) = (0, &lengths[..]);
        for part in plan.divide(&lengths) {
            clocks += clocks_of(&plan, part, rest).expect("it fits");
            rest = &rest[part.jobs()..];
        }
        prop_assert!(rest.is_empty());
        prop_assert_eq!(clocks, fewest(&plan, &lengths));
    }

    #[test]
    fn the_capacity_may_be_reached_exactly(jobs in 2usize..17, share in 3usize..60, longer in 0usize..16) {
        // `longer` of the jobs are a point longer than the others, so the last round is theirs alone.
        let longer = longer % jobs;
        let mut lengths = vec![share; jobs];
        lengths[..longer].fill(share + 1);
        let sent = jobs * share + longer;
        let groups = |capacity: usize| {
            let plan = Plan::new(16, capacity as u32, true);
            plan.groups(&lengths, 1).map(|(jobs, _)| jobs).last()
        };
        prop_assert_eq!(groups(sent), Some(jobs));
        prop_assert!(groups(sent - 1) < Some(jobs));
        let (sets, ordered) = jobs_of(&lengths);
        prop_assert_eq!(super::tests::sent(&Group::sharing(ordered, 1), &sets), sent);
    }
}

#[test]
fn parts_are_halves_only_where_that_saves_clocks() {
    let size = |contexts, capacity| Plan::new(contexts, capacity, true).part_size(usize::MAX);
    // Cores of the named configurations `full`, `dual`, `quad` and `small`, and the software model.
    assert_eq!([size(16, 8192), size(16, 4096), size(16, 2048), size(16, 1024)], [8192, 4096, 1024, 512]);
    assert_eq!(size(1, 1 << 20), 1 << 20);
    assert_eq!([size(2, 8), size(1, 4)], [8, 4]);
    assert_eq!(Plan::new(16, 2048, false).part_size(usize::MAX), 2048);
    // A set of 4,000 points on the four engines of `quad`.
    assert_eq!(Plan::new(16, 2048, true).part_size(1000), 500);
}

#[test]
fn a_small_batch_goes_to_all_engines() {
    let groups = |engines, jobs| {
        let parts = Plan::new(16, 2048, true).on_engines(engines).divide(&vec![500; jobs]);
        parts.iter().map(|part| part.jobs()).collect::<Vec<_>>()
    };
    assert_eq!([groups(1, 8), groups(4, 8), groups(4, 4)], [vec![4; 2], vec![2; 4], vec![1; 4]]);
    // A batch that gives every engine its fill is divided as for one engine.
    assert_eq!(groups(4, 16), groups(1, 16));
}

#[test]
fn meshes_that_the_device_cannot_keep_are_not_put_side_by_side() {
    let plan = |kept| Plan::new(FULL.contexts, FULL.points, true).sharing_at_most(kept);
    assert_eq!(plan(usize::MAX).divide(&[1000; 8]), [Part::Group { jobs: 8, contexts: 2 }]);
    let points_of = |part: &Part| part.jobs() * 1000;
    for kept in [5461, 3000] {
        let parts = plan(kept).divide(&[1000; 8]);
        assert!(parts.iter().all(|part| points_of(part) <= kept), "{parts:?}");
    }
    assert!(plan(8192).shares(4000) && !plan(5461).shares(4000));
    assert_eq!(plan(5461).divide(&[4000, 4000]), [Part::Exclusive; 2]);
}
