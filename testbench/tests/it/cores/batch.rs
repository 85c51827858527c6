//! Runs batches in lock-step: the core and its model are compared at every root port and every clock. There are 2, 4
//! and 16 jobs side by side and teams of every size, crossed with idle clocks and back-pressure, jobs of several
//! lengths, lists that overflow, three points on a line, and resets. `sim/model/tests/it/clock/batch.rs` proves for the
//! model that every job gets the mesh it gets alone; these tests compare the reports with the model by commands as
//! well.

use incircle_model::{CommandModel, Inputs};
use incircle_protocol::{
    answer_status, Config, Counter, Status, CORE_COORD_BITS, COUNTER_WORDS, IDENTITY_WORDS, INSERT_REPORT_WORDS, SMALL,
    TINY,
};
use incircle_testbench::lockstep::{Job, Lockstep, Stalls};
use incircle_testkit::{words, Batch, Random32, SplitMix64};

/// A pair of core and model, with the counters summed over all its batches.
struct Rig {
    pair: Lockstep,
    config: Config,
    chances: SplitMix64,
    counters: [u64; COUNTER_WORDS],
}

impl Rig {
    fn new(name: &str, config: Config, seed: u32) -> Self {
        let pair = Lockstep::new(name, config, seed);
        Self { pair, config, chances: SplitMix64::new(seed.into()), counters: [0; COUNTER_WORDS] }
    }

    /// Runs a whole batch: clear, insert in pieces, read everything, latencies, counters.
    fn run(&mut self, points: &[u32], piece: usize, jobs: u32, stalls: Stalls) {
        self.run_job(&Job::batch_of(points, piece, jobs, self.config), points, piece, stalls);
    }

    /// Runs such a job, which inserts these points in pieces.
    fn run_job(&mut self, job: &Job, points: &[u32], piece: usize, stalls: Stalls) {
        let chances = &mut self.chances;
        let answers = self.pair.run(job, stalls, &mut || chances.next_u64());
        let answers = answers.unwrap_or_else(|mismatch| panic!("{mismatch}\njob {:x?}", job.commands));
        let mut model = CommandModel::new(CORE_COORD_BITS, self.config.points, self.config.ring)
            .expect("possible")
            .with_contexts(self.config.contexts);
        model.send(&job.commands);
        let mut expected = vec![0; job.answers];
        assert_eq!((model.receive(&mut expected), answers.len()), (job.answers, job.answers));
        let hello = 2 + IDENTITY_WORDS;
        let reports = hello + 2 + points.chunks(piece).len() * (2 + INSERT_REPORT_WORDS);
        assert_eq!(answers[..reports], expected[..reports], "reports of {:x}, {points:x?}", job.commands[1]);
        for (sum, word) in self.counters.iter_mut().zip(&answers[answers.len() - COUNTER_WORDS..]) {
            *sum += u64::from(*word);
        }
    }

    fn counted(&self, counter: Counter) -> u64 {
        self.counters[counter as usize]
    }
}

/// Runs `batches` batches of all kinds; in about every fourth, some job has three points on a line.
fn run_all(rig: &mut Rig, batches: u32, most: u32, seed: u64) {
    let mut random = Random32(seed);
    for turn in 0..batches as usize {
        let asked = random.below(rig.config.contexts + 1);
        let jobs = if asked == 0 { rig.config.contexts } else { asked };
        let points = Batch::random(&mut random, jobs, most, turn % 4 != 0).points();
        let piece = [points.len(), 1 + random.below(30) as usize][turn % 2];
        rig.run(&points, piece, asked, Stalls::ALL[turn % 9]);
        if turn % 5 == 0 {
            // A job that is not a batch must work as ever in between.
            let job = Job::of(&points[..points.len().min(60)], 60, asked, rig.config);
            let chances = &mut rig.chances;
            let done = rig.pair.run(&job, Stalls::NONE, &mut || chances.next_u64());
            assert!(done.is_ok(), "{}", done.expect_err("a mismatch"));
        }
    }
    assert_eq!(rig.counted(Counter::Aborts), 0, "jobs do not meet each other");
}

#[test]
fn two_jobs() {
    let mut rig = Rig::new("core_tiny", TINY, 51);
    run_all(&mut rig, 400, 3, 51);
    assert!(rig.counted(Counter::Refused) > 50 && rig.counted(Counter::Duplicates) > 50);
}

#[test]
fn four_jobs_whose_lists_overflow() {
    let config = Config { ring: 9, ..SMALL };
    let mut rig = Rig::new("core_small_ring9", config, 52);
    run_all(&mut rig, 60, 120, 52);
    assert!(rig.counted(Counter::Overflows) > 50, "{}", rig.counted(Counter::Overflows));
}

#[test]
fn sixteen_jobs() {
    let mut rig = Rig::new("core_small", SMALL, 53);
    run_all(&mut rig, 60, 62, 53);
    let insertions = rig.counted(Counter::Insertions);
    assert!(insertions > 8000, "{insertions}");
}

/// Runs batches for every way in which every number of contexts forms teams.
fn run_teams(rig: &mut Rig, batches: u32, most: u32, seed: u64) {
    let mut random = Random32(seed);
    let built = rig.config.contexts;
    let ways = (1..=built).flat_map(|contexts| (1..=contexts).map(move |jobs| [contexts, jobs]));
    for [contexts, jobs] in ways.filter(|[contexts, jobs]| contexts.is_multiple_of(*jobs)) {
        for turn in 0..batches as usize {
            let points = Batch::random(&mut random, jobs, 1 + most / jobs, turn % 4 != 3).points();
            let piece = [points.len(), 1 + random.below(30) as usize][turn % 2];
            let stalls = Stalls::ALL[(turn + contexts as usize + jobs as usize) % 9];
            rig.run_job(&Job::teams_of(&points, piece, [contexts, jobs], rig.config), &points, piece, stalls);
        }
    }
    // Numbers of jobs that do not divide that of the contexts are refused, and the points belong to the mesh before.
    for [contexts, jobs] in [[built, built + 1], [0, 2 * built], [built, 127], [built + 1, 1]] {
        let job = Job::teams_of(&[1], 1, [contexts, jobs], rig.config);
        let chances = &mut rig.chances;
        let [hello, refused, ..] = job.commands[..] else { panic!("a job begins with `Hello` and `Clear`") };
        let job = Job { commands: vec![hello, refused], answers: 2 + IDENTITY_WORDS + 2 };
        let answers = rig.pair.run(&job, Stalls::NONE, &mut || chances.next_u64());
        let answers = answers.unwrap_or_else(|mismatch| panic!("{mismatch}"));
        assert_eq!(answer_status(answers[2 + IDENTITY_WORDS]), Status::BadContexts as u8, "{contexts} {jobs}");
    }
}

#[test]
fn teams_in_a_tiny_core() {
    let mut rig = Rig::new("core_tiny", TINY, 55);
    run_teams(&mut rig, 60, 6, 55);
    let refused = rig.counted(Counter::Refused);
    assert!(refused > 20 && rig.counted(Counter::Duplicates) > 50, "{refused}");
}

#[test]
fn teams_of_every_size_in_a_middle_core() {
    let config = Config { contexts: 12, ..SMALL };
    let mut rig = Rig::new("core_small_twelve", config, 56);
    run_teams(&mut rig, 4, 700, 56);
    // The first point inside a wheel has a longer boundary than the list.
    let mut random = Random32(57);
    for jobs in [1, 2, 3, 4, 6, 12] {
        let wheels = (0..jobs).map(|_| words::started(words::wheel_from_outside(&mut random, 24))).collect();
        let points = Batch { jobs: wheels }.points();
        let job = Job::teams_of(&points, points.len(), [12, jobs], config);
        rig.run_job(&job, &points, points.len(), Stalls::NONE);
    }
    let (aborts, taken) = (rig.counted(Counter::Aborts), rig.counted(Counter::PrioritiesTaken));
    assert!(aborts > 2000 && taken > 500 && rig.counted(Counter::Overflows) > 50, "{aborts} {taken}");
}

#[test]
fn resets_in_mid_batch() {
    let mut rig = Rig::new("core_small", SMALL, 54);
    let mut random = Random32(54);
    for turn in 0..20 {
        let points = Batch::random(&mut random, 16, 20, true).points();
        let job = Job::batch_of(&points, points.len(), 16, SMALL);
        let mut rest = job.commands.as_slice();
        for _ in 0..random.below(7000) {
            let inputs = Stalls::ALL[turn % 9].inputs(rest, rig.chances.next_u64());
            if inputs.command_valid && rig.pair.outputs().command_ready {
                rest = &rest[1..];
            }
            rig.pair.clock(inputs).unwrap_or_else(|mismatch| panic!("{mismatch}"));
        }
        let reset = Inputs { reset: true, ..Inputs::default() };
        rig.pair.clock(reset).unwrap_or_else(|mismatch| panic!("{mismatch}"));
        rig.run(&points, points.len(), 0, Stalls::NONE);
    }
}
