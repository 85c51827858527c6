//! What pictures see of the core agrees with what the core does: locks belong to contexts at work, every point is
//! inserted by one context, and nothing is left at the end.

use crate::common::bench::{limit, Answers};
use crate::common::{sets, Random};
use incircle_model::{Activity, ClockModel, ContextView, Inputs};
use incircle_protocol::{clear_word, command_word, Config, Opcode, SMALL};
use std::collections::{BTreeMap, BTreeSet};

/// What was seen in a job.
#[derive(Default)]
struct Seen {
    activities: BTreeSet<&'static str>,
    /// The context of each vertex.
    contexts: BTreeMap<u32, usize>,
    most_at_work: usize,
    most_locks: usize,
    clocks: u64,
}

fn name(activity: Activity) -> &'static str {
    match activity {
        Activity::Idle => "idle",
        Activity::Walk => "walk",
        Activity::Root => "root",
        Activity::Cavity => "cavity",
        Activity::Drain => "drain",
        Activity::Rest => "rest",
        Activity::Solo => "solo",
    }
}

/// Checks one clock, in which the contexts are `contexts`.
fn check(core: &ClockModel, contexts: &[ContextView], seen: &mut Seen) {
    let flights: BTreeSet<usize> = core.visits().map(|visit| visit.context as usize).collect();
    let holders: Vec<usize> =
        (0..2 * SMALL.points).filter_map(|id| core.lock_holder(id)).map(|holder| holder as usize).collect();
    for (number, context) in contexts.iter().enumerate() {
        let holds = holders.contains(&number);
        match context.activity {
            Activity::Cavity => assert!(holds, "clock {}: {number} grows a cavity without a lock", seen.clocks),
            Activity::Idle | Activity::Walk | Activity::Rest => {
                assert!(!holds || context.is_ending, "clock {}: {number} keeps a lock: {context:?}", seen.clocks);
            }
            Activity::Root | Activity::Drain | Activity::Solo => {}
        }
        if matches!(context.activity, Activity::Walk | Activity::Root | Activity::Cavity) && core.records() > 0 {
            assert!(flights.contains(&number), "clock {}: no visit of {number}: {context:?}", seen.clocks);
        }
        if let Some(vertex) = context.vertex {
            assert_eq!(*seen.contexts.entry(vertex).or_insert(number), number, "two contexts insert {vertex}");
        }
        seen.activities.insert(name(context.activity));
    }
    assert!(contexts.iter().filter(|context| context.has_priority).count() < 2, "clock {}", seen.clocks);
    seen.most_at_work = seen.most_at_work.max(contexts.iter().filter(|one| one.vertex.is_some()).count());
    seen.most_locks = seen.most_locks.max(holders.len());
}

/// Does a job, and looks at every clock of it.
fn watch(config: Config, points: &[u32]) -> (ClockModel, Seen) {
    let mut core = ClockModel::new(config).expect("a core that can be built");
    let mut words = vec![clear_word(0), command_word(Opcode::Insert), points.len() as u32];
    words.extend(points);
    let (mut rest, mut answers, mut seen) = (&words[..], Answers::default(), Seen::default());
    while answers.whole.len() < 2 {
        let outputs = core.outputs();
        outputs.answer_words().for_each(|word| answers.take(word));
        let command_valid = !rest.is_empty();
        let command_data = rest.first().copied().unwrap_or_default();
        rest = if command_valid && outputs.command_ready { &rest[1..] } else { rest };
        core.clock(Inputs { reset: false, command_valid, command_data, response_ready: true });
        seen.clocks += 1;
        assert!(seen.clocks < limit(points.len()), "{}", core.describe());
        check(&core, &core.contexts(), &mut seen);
    }
    (core, seen)
}

#[test]
fn a_job_is_seen_from_its_first_point_to_its_last_lock() {
    let points = sets::boxed(&mut Random(3), 600, 1 << 16);
    let (core, seen) = watch(SMALL, &points);
    assert_eq!(seen.activities, BTreeSet::from(["cavity", "drain", "idle", "rest", "root", "walk"]));
    assert_eq!(seen.most_at_work, 16);
    assert!((30..500).contains(&seen.most_locks), "{}", seen.most_locks);
    let inserted: BTreeSet<u32> = seen.contexts.keys().copied().collect();
    assert!((3..600).all(|vertex| inserted.contains(&vertex)), "a vertex without a context");
    assert!(seen.contexts.values().collect::<BTreeSet<_>>().len() == 16, "contexts without a vertex");
    assert_eq!(core.finished_points(), 600);
    assert_eq!(core.records(), 2 * 600 - 2);
    assert!(core.contexts().iter().all(|context| context.vertex.is_none() && !context.is_ending));
    assert_eq!(core.visits().count(), 0);
    assert!((0..core.records()).all(|id| core.lock_holder(id).is_none()), "a lock stays");
    let record = core.record(5);
    assert!(record.n.iter().all(|&side| core.record(side).n.contains(&5)), "{record:?}");
}

#[test]
fn a_solo_insertion_is_seen() {
    // A fan: the last point sees all the others.
    let mut points: Vec<u32> = (0..40u32).map(|k| (20_000 + 500 * k) | (1000 + k.abs_diff(20).pow(2)) << 16).collect();
    points.push(30_000 | 60_000 << 16);
    let (_, seen) = watch(Config { ring: 6, contexts: 2, ..SMALL }, &points);
    assert!(seen.activities.contains("solo"), "{:?}", seen.activities);
}
