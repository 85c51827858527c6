//! How long a job of a batch waits for the others: no longer than for as much work of each of them.

use crate::common::batches::{job_of, own_points, teams_word};
use crate::common::bench::{limit, Answers, Bench};
use crate::common::{sets, Random};
use incircle_model::Inputs;
use incircle_protocol::{command_word, Config, Counter, Opcode, Status};
use incircle_testkit::Batch;

/// Does a batch, and returns for each job the clock in which the last of its vertices came into the mesh, and the clocks
/// of the whole batch.
fn clocks_of_jobs(bench: &mut Bench, [contexts, jobs]: [u32; 2], points: &[u32]) -> (Vec<u64>, u64) {
    let mut words = vec![teams_word(contexts, jobs), command_word(Opcode::Insert), points.len() as u32];
    words.extend(points);
    let mut is_new = vec![true; points.len()];
    let mut last = vec![0; jobs as usize];
    let (mut rest, mut answers) = (&words[..], Answers::default());
    for clock in 0..limit(points.len()) {
        let outputs = bench.core.outputs();
        outputs.answer_words().filter(|_| outputs.response_valid).for_each(|word| answers.take(word));
        let written = outputs.write.valid && outputs.write.vertices;
        for vertex in outputs.write.record.v.into_iter().filter(|_| written) {
            if is_new.get_mut(vertex as usize).is_some_and(std::mem::take) {
                last[job_of(vertex, jobs) as usize] = clock;
            }
        }
        let command_data = rest.first().copied().unwrap_or(0xdead_beef);
        let command_valid = !rest.is_empty();
        rest = if command_valid && outputs.command_ready { &rest[1..] } else { rest };
        bench.core.clock(Inputs { reset: false, command_valid, command_data, response_ready: true });
        if answers.whole.len() == 2 {
            assert!(answers.whole[1].is(Status::Ok), "{:?}", answers.whole[1]);
            return (last, clock);
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
fn crowded(random: &mut Random, jobs: u32, kind: u32, victim: usize, few: u32) -> Batch {
    let full = 1000 / jobs;
    let side = random.pick(&[8, 300, 1 << 16]);
    let job = |place: usize| {
        sets::started(match kind {
            _ if place == victim => sets::boxed(random, few, side),
            0 => sets::boxed(random, full, 1 << 16),
            1 => sets::parabola(random, full.min(255)),
            2 => sets::wheel_from_outside(random, full),
            _ => sets::stuttering(random, full, 300),
        })
    };
    Batch { jobs: (0..jobs as usize).map(job).collect() }
}

/// The bound on the time of a job in a full batch. A group takes at most a quarter longer than its jobs would take one
/// after another, each with the contexts of its team. A short job does not wait for longer ones: when its last point is
/// in the mesh, at most 3 times the clocks have passed that as many points of each job take one after another. With
/// lists of 3 edges nearly every point needs a solo insertion, for which all other teams wait.
#[test]
fn no_job_waits_longer_than_for_as_much_work_of_each_other_job() {
    let mut random = Random(39);
    let (mut longest_group, mut longest_job) = (0.0f64, 0.0f64);
    for [contexts, jobs] in [[16, 16], [16, 8], [16, 4], [16, 2], [15, 5], [24, 12], [24, 2]] {
        for ring in [3, 6, 32] {
            let config = Config { name: "test", points: 4096, ring, contexts };
            let mut bench = Bench::new(config);
            for turn in 0..8 {
                let victim = random.below(jobs) as usize;
                let few = [20, 60][turn as usize / 4].min(900 / jobs);
                let batch = crowded(&mut random, jobs, turn % 4, victim, few);
                let what = format!("{contexts} contexts, {jobs} jobs, ring {ring}, turn {turn}, job {victim}");
                let points = batch.points();
                let (last, clocks) = clocks_of_jobs(&mut bench, [contexts, jobs], &points);
                let own = own_points(&points, jobs);
                let all = one_after_another(&mut bench, contexts / jobs, own.iter().map(Vec::as_slice));
                let length = batch.jobs[victim].len();
                let firsts = own.iter().map(|points| &points[..length]);
                let first = one_after_another(&mut bench, contexts / jobs, firsts);
                let (group, job) = (clocks as f64 / all as f64, last[victim] as f64 / first as f64);
                assert!(group <= 1.25, "the group takes {group:.2} of the time one after another: {what}");
                assert!(job <= 3.0, "the job takes {job:.2} of the time of as many points of each job: {what}");
                longest_group = longest_group.max(group);
                longest_job = longest_job.max(job);
            }
        }
    }
    println!("groups take at most {longest_group:.2} of the time one after another, short jobs {longest_job:.2}");
}
