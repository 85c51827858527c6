//! How long a job of a batch waits for the others.

use crate::common::batches::{job_of, own_points, teams_word};
use crate::common::bench::{limit, Answers, Bench};
use crate::common::{sets, Random};
use incircle_model::Inputs;
use incircle_protocol::{command_word, Config, Counter, Opcode, Status};
use incircle_testkit::Batch;
use std::collections::BTreeSet;

/// Counts how often a team is overtaken: the points that each other team finishes between two points of this one.
struct Overtaking {
    team: usize,
    /// Points of the team that are still to come into the mesh.
    left: usize,
    /// For each team, the points since the last one of `team`; and the most that any team has had.
    since: Vec<u32>,
    most: u32,
}

impl Overtaking {
    fn take(&mut self, team: usize) {
        if team == self.team {
            self.left -= 1;
            self.since.fill(0);
        } else if self.left > 0 {
            self.since[team] += 1;
            self.most = self.most.max(self.since[team]);
        }
    }
}

/// Does a batch. Returns its clocks, and the most points that another team finishes between two points of this one.
/// Duplicates of this one are not counted.
fn clocks_and_overtaking(bench: &mut Bench, [contexts, jobs]: [u32; 2], points: &[u32], team: usize) -> (u64, u32) {
    let mut words = vec![teams_word(contexts, jobs), command_word(Opcode::Insert), points.len() as u32];
    words.extend(points);
    let mut is_new = vec![true; points.len()];
    let distinct = own_points(points, jobs)[team].iter().collect::<BTreeSet<_>>().len();
    let mut overtaking = Overtaking { team, left: distinct, since: vec![0; jobs as usize], most: 0 };
    let (mut rest, mut answers) = (&words[..], Answers::default());
    // After a reset the memory of locks is cleared first, which is not counted.
    let mut clock = 0;
    for _ in 0..limit(points.len()) {
        clock += u64::from(rest.len() < points.len());
        let outputs = bench.core.outputs();
        outputs.answer_words().filter(|_| outputs.response_valid).for_each(|word| answers.take(word));
        let written = outputs.write.valid && outputs.write.vertices;
        for vertex in outputs.write.record.v.into_iter().filter(|_| written) {
            if is_new.get_mut(vertex as usize).is_some_and(std::mem::take) {
                overtaking.take(job_of(vertex, jobs) as usize);
            }
        }
        let command_data = rest.first().copied().unwrap_or(0xdead_beef);
        let command_valid = !rest.is_empty();
        rest = if command_valid && outputs.command_ready { &rest[1..] } else { rest };
        bench.core.clock(Inputs { reset: false, command_valid, command_data, response_ready: true });
        if answers.whole.len() == 2 {
            assert!(answers.whole[1].is(Status::Ok), "{:?}", answers.whole[1]);
            assert_eq!(overtaking.left, 0, "all points of the team are in the mesh");
            return (clock, overtaking.most);
        }
    }
    panic!("stuck: {contexts} contexts, {jobs} jobs, {}, {points:x?}", bench.core.describe());
}

/// Clocks of jobs one after another, each alone with this many contexts.
fn one_after_another<'a>(bench: &mut Bench, contexts: u32, jobs: impl IntoIterator<Item = &'a [u32]>) -> u64 {
    let clocks = jobs.into_iter().map(|points| {
        bench.insert(contexts, points).expect("in time");
        bench.counters().expect("in time").counter(Counter::InsertCycles)
    });
    clocks.sum()
}

/// A job of a few points beside long ones: of uniform points, points that all lie on the hull, a wheel, or duplicates
/// of points that are still being inserted.
fn crowded(random: &mut Random, jobs: u32, kind: u32, team: usize, few: u32) -> Batch {
    let full = 1000 / jobs;
    let job = |place: usize| {
        sets::started(match kind {
            _ if place == team => sets::boxed(random, few, 1 << 16),
            0 => sets::boxed(random, full, 1 << 16),
            1 => sets::parabola(random, full.min(255)),
            2 => sets::wheel_from_outside(random, full),
            _ => sets::stuttering(random, full, 300),
        })
    };
    Batch { jobs: (0..jobs as usize).map(job).collect() }
}

/// The bounds on the time of a job in a full batch. A group takes at most twice the clocks of its jobs one after
/// another, each with the contexts of its team. No team is passed over: between two points of a team, no other team
/// finishes more than 8 for each of its contexts. With lists of 3 edges nearly every point needs a solo insertion, for
/// which all other teams wait.
#[test]
fn no_job_waits_longer_than_for_all_others_and_no_team_is_passed_over() {
    let mut random = Random(39);
    let (mut longest, mut most) = (0.0f64, 0.0f64);
    for [contexts, jobs] in [[16, 16], [16, 8], [16, 4], [16, 2], [15, 5], [24, 12], [24, 2]] {
        for ring in [3, 6, 32] {
            let config = Config { name: "test", points: 4096, ring, contexts, engines: 1 };
            let mut bench = Bench::new(config);
            for (turn, few) in (0..8).zip([20, 60, 20, 60, 60, 20, 60, 20]) {
                let team = random.below(jobs) as usize;
                let points = crowded(&mut random, jobs, turn % 4, team, few).points();
                let (clocks, overtaken) = clocks_and_overtaking(&mut bench, [contexts, jobs], &points, team);
                let own = own_points(&points, jobs);
                let all = one_after_another(&mut bench, contexts / jobs, own.iter().map(Vec::as_slice));
                let share = clocks as f64 / all as f64;
                let overtaken = f64::from(overtaken) / f64::from(contexts / jobs);
                let what = format!("{contexts} contexts, {jobs} jobs, ring {ring}, turn {turn}, team {team}");
                assert!(share <= 2.0, "the group takes {share:.2} of the time one after another: {what}");
                assert!(overtaken <= 8.0, "another team finishes {overtaken:.1} points for each context: {what}");
                longest = longest.max(share);
                most = most.max(overtaken);
            }
        }
    }
    println!("groups take at most {longest:.2} of the time one after another, {most:.2} points for each context");
}
