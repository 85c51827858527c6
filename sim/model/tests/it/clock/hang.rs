//! No job hangs: thousands of small jobs in tiny boxes, where insertions hinder each other all the time. There are
//! 2,000 jobs for each of six numbers of contexts, and 200 for each of the other numbers up to 24; and 200 batches for
//! each of ten ways to divide contexts into teams, 9,400 jobs together.
//!
//! A job of `n` points may take 100 times 2,000 + 40 n clocks, and its mesh must be that of the model by commands. For
//! each number of contexts the jobs are the same in every run.

use crate::common::batches::{check_single_meshes, teams_word};
use crate::common::bench::Bench;
use crate::common::mesh_check::{canonical, records_of};
use crate::common::{sets, Random};
use incircle_model::CommandModel;
use incircle_protocol::{command_word, Config, Opcode, Status, MAX_CONTEXTS};
use incircle_testkit::Batch;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Number of jobs for each of these numbers of contexts.
const JOBS: u32 = 2000;
const CONTEXTS: [u32; 6] = [1, 2, 4, 8, 16, 24];
/// Number of jobs for each of the other numbers of contexts, on which it depends which contexts run in step.
const OTHER_JOBS: u32 = 200;
/// Numbers of contexts and of jobs side by side.
const TEAMS: [[u32; 2]; 10] = [[4, 2], [6, 3], [8, 2], [12, 4], [12, 6], [15, 5], [16, 2], [16, 8], [24, 3], [24, 12]];
/// Number of jobs that one thread does in a row.
const PORTION: u32 = 100;

fn points(random: &mut Random) -> Vec<u32> {
    let count = 3 + random.below(298);
    let side = 3 + random.below(38);
    match random.below(4) {
        0 => sets::stuttering(random, count, side),
        _ => sets::boxed(random, count, side),
    }
}

/// Does one job, and returns the fault, if there is one.
fn job(bench: &mut Bench, points: &[u32]) -> Result<(), String> {
    let Config { points: capacity, ring, .. } = bench.config;
    let mut model = CommandModel::new(16, capacity, ring).expect("a model that can be built");
    model.send(&[command_word(Opcode::Insert), points.len() as u32]);
    model.send(points);
    let answer = bench.insert(0, points).map_err(|hang| hang.0)?;
    let wanted = if model.mesh().is_collinear() { Status::Collinear } else { Status::Ok };
    let inserted = model.mesh().counts().insertions;
    if !answer.is(wanted) || answer.report().inserted != inserted {
        return Err(format!("{answer:?} in place of {wanted:?} and {inserted}: {}", bench.core.describe()));
    }
    let records = model.mesh().records().len() as u32;
    if records == 0 {
        return Ok(());
    }
    let found = canonical(&bench.records(records), points, capacity)?;
    if canonical(&records_of(model.mesh(), capacity), points, capacity)? != found {
        return Err("another mesh".to_string());
    }
    Ok(())
}

/// Does one batch, and returns the fault, if there is one.
fn batch(bench: &mut Bench, jobs: u32, points: &[u32]) -> Result<(), String> {
    let config = bench.config;
    let answer = bench.insert_after(teams_word(config.contexts, jobs), points).map_err(|hang| hang.0)?;
    if !answer.is(Status::Ok) {
        return Err(format!("{answer:?}: {}", bench.core.describe()));
    }
    check_single_meshes(&bench.records(answer.report().records), points, jobs, config)
}

/// Does some batches for one way to divide contexts into teams.
fn batches([contexts, jobs]: [u32; 2], which: u32) {
    let mut random = Random(u64::from(contexts << 20 | jobs << 10 | which));
    let ring = random.pick(&[6, 9, 12, 32, 32, 64]);
    let mut bench = Bench::new(Config { name: "test", points: 4096, ring, contexts, engines: 1 });
    for turn in 0..PORTION {
        let jobs_of = (0..jobs).map(|_| sets::started(points(&mut random))).collect();
        let points = Batch { jobs: jobs_of }.points();
        if let Err(fault) = batch(&mut bench, jobs, &points) {
            panic!("{fault}: {contexts} contexts, {jobs} jobs, ring {ring}, batch {turn} of {which}, {points:x?}");
        }
    }
}

/// Does some jobs for one number of contexts.
fn portion(contexts: u32, which: u32) {
    let mut random = Random(u64::from(contexts << 16 | which));
    let ring = random.pick(&[6, 9, 12, 32, 32, 64]);
    let mut bench = Bench::new(Config { name: "test", points: 512, ring, contexts, engines: 1 });
    for turn in 0..PORTION {
        let points = points(&mut random);
        if let Err(fault) = job(&mut bench, &points) {
            panic!("{fault}: {contexts} contexts, ring {ring}, job {turn} of portion {which}, points {points:x?}");
        }
    }
}

/// Does portions of work in as many threads as the machine has.
fn in_threads<W: Copy + Sync>(portions: &[W], work: impl Fn(W) + Sync) {
    let at = AtomicUsize::new(0);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(&portion) = portions.get(at.fetch_add(1, Ordering::Relaxed)) {
                    work(portion);
                }
            });
        }
    });
}

#[test]
fn no_job_hangs() {
    let jobs = |contexts| if CONTEXTS.contains(&contexts) { JOBS } else { OTHER_JOBS };
    let portions: Vec<(u32, u32)> = (1..=MAX_CONTEXTS)
        .flat_map(|contexts| (0..jobs(contexts) / PORTION).map(move |which| (contexts, which)))
        .collect();
    in_threads(&portions, |(contexts, which)| portion(contexts, which));
}

#[test]
fn no_team_hangs() {
    let portions: Vec<([u32; 2], u32)> =
        TEAMS.into_iter().flat_map(|teams| (0..OTHER_JOBS / PORTION).map(move |which| (teams, which))).collect();
    in_threads(&portions, |(teams, which)| batches(teams, which));
}
