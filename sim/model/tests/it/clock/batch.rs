//! Jobs side by side in one memory: each job gets the mesh that it gets on its own, from the model by commands
//! and clock by clock.

use crate::common::batches::{check_single_meshes, teams_word};
use crate::common::bench::{limit, Answer, Answers, Bench, Stalls};
use crate::common::mesh_check::records_of;
use crate::common::{sets, Random};
use incircle_model::CommandModel;
use incircle_protocol::{
    batch_word, clear_word, command_word, Config, Counter, Opcode, Status, COUNTER_WORDS, FULL, SMALL,
};
use incircle_testkit::Batch;

/// A `Clear` for a batch, and an `Insert` for each piece of `piece` points.
fn words_of(clear: u32, points: &[u32], piece: usize) -> Vec<u32> {
    let mut words = vec![clear];
    for piece in points.chunks(piece.max(1)) {
        words.extend([command_word(Opcode::Insert), piece.len() as u32]);
        words.extend(piece);
    }
    words
}

/// The answers of the model by commands.
fn expected(model: &mut CommandModel, words: &[u32]) -> Vec<Answer> {
    model.send(words);
    let mut answers = Answers::default();
    let mut word = [0];
    while model.receive(&mut word) == 1 {
        answers.take(word[0]);
    }
    answers.whole
}

fn model(config: Config) -> CommandModel {
    CommandModel::new(16, config.points, config.ring).expect("possible").with_contexts(config.contexts)
}

/// Runs a batch with a context for each job on both models and compares them; returns the counters.
fn compare(bench: &mut Bench, jobs: u32, points: &[u32], piece: usize, stalls: Stalls, random: &mut Random) -> Answer {
    let counters = compare_teams(bench, [jobs, jobs], points, piece, stalls, random);
    let met = counters.counter(Counter::Aborts);
    assert_eq!(met, 0, "jobs meet no locks of each other, {:?}, {jobs} jobs, {points:x?}", bench.config);
    counters
}

/// Runs a batch of `jobs` jobs on `contexts` contexts on both models and compares them; returns the counters.
fn compare_teams(
    bench: &mut Bench,
    [contexts, jobs]: [u32; 2],
    points: &[u32],
    piece: usize,
    stalls: Stalls,
    random: &mut Random,
) -> Answer {
    let config = bench.config;
    let clear = if contexts == jobs { batch_word(jobs) } else { teams_word(contexts, jobs) };
    let words = words_of(clear, points, piece);
    let mut by_commands = model(config);
    let wanted = expected(&mut by_commands, &words);
    let what = || format!("{config:?}, {jobs} jobs, {contexts} contexts, pieces of {piece}, {points:x?}");
    let most = 4 * limit(points.len());
    let mut run = |words: &[u32], count| match bench.run(words, count, stalls, most, random) {
        Ok(answers) => answers,
        Err(hang) => panic!("stuck: {}, {}", hang.0, what()),
    };
    assert_eq!(run(&words, wanted.len()), wanted, "{}", what());
    let count = by_commands.mesh().records().len() as u32;
    let read = run(&[command_word(Opcode::Read), 0, count], 1).swap_remove(0);
    let records: Vec<[u32; 3]> = read.payload.chunks_exact(3).map(|words| [words[0], words[1], words[2]]).collect();
    assert!(read.is(Status::Ok));
    let arrived = &points[..points.len().min(config.points as usize)];
    let is_whole = arrived.len() as u32 >= 3 * jobs && !by_commands.mesh().is_collinear();
    if is_whole {
        for records in [records, records_of(by_commands.mesh(), config.points)] {
            check_single_meshes(&records, arrived, jobs, config).unwrap_or_else(|fault| panic!("{fault}: {}", what()));
        }
    }
    let free = (0..2 * config.points).all(|id| bench.core.record_words(id)[0] >> 31 == 0);
    assert!(free, "a lock is left, {}", what());
    bench.counters().expect("in time")
}

#[test]
fn every_job_gets_the_mesh_it_gets_alone() {
    let mut random = Random(31);
    let mut seen = [0u64; COUNTER_WORDS];
    for ring in [3, 6, 9, 32, 64] {
        for contexts in [1, 2, 3, 4, 7, 16, 24] {
            let config = Config { name: "test", points: 512, ring, contexts, engines: 1 };
            let mut bench = Bench::new(config);
            for turn in 0..12 {
                let asked = random.below(contexts + 1);
                let jobs = if asked == 0 { contexts } else { asked };
                let most = [4, 20, 400 / jobs, 600 / jobs][turn % 4];
                let batch = Batch::random(&mut random, jobs, most, true);
                let mut points = batch.points();
                // The last round may be cut short, which leaves the later jobs a point shorter.
                points.truncate(points.len() - random.below(jobs) as usize);
                let points = &points[..points.len().max(3 * jobs as usize)];
                let stalls = [(0, 0), (2, 3), (5, 2), (40, 40)][turn % 4];
                let stalls = Stalls { idle: stalls.0, full: stalls.1, beat: 0 };
                let piece = [points.len(), 1 + random.below(40) as usize][turn % 2];
                let counters = compare(&mut bench, jobs, points, piece, stalls, &mut random);
                for (sum, value) in seen.iter_mut().zip(&counters.payload) {
                    *sum += u64::from(*value);
                }
                if turn % 3 == 0 {
                    // A job outside a batch still works in between.
                    let points = sets::started(sets::boxed(&mut random, 60, 100));
                    let answer = bench.insert(0, &points).expect("in time");
                    assert!(answer.is(Status::Ok));
                }
            }
        }
    }
    let least = |counter: Counter, count: u64| {
        let found = seen[counter as usize];
        assert!(found >= count, "{counter:?} only {found} times");
    };
    least(Counter::Insertions, 40_000);
    least(Counter::Duplicates, 20_000);
    least(Counter::Refused, 1000);
    least(Counter::Overflows, 5000);
}

/// Every way in which some numbers of contexts form teams of two and more, with all kinds of points.
#[test]
fn every_job_of_a_team_gets_the_mesh_it_gets_alone() {
    let mut random = Random(37);
    let mut seen = [0u64; COUNTER_WORDS];
    for ring in [3, 6, 9, 32, 64] {
        for contexts in [2, 4, 6, 9, 12, 15, 16, 24] {
            let config = Config { name: "test", points: 512, ring, contexts, engines: 1 };
            let mut bench = Bench::new(config);
            for jobs in (1..contexts).filter(|jobs| contexts.is_multiple_of(*jobs)) {
                for turn in 0..5 {
                    let most = [4, 30, 400 / jobs, 600 / jobs, 200 / jobs][turn];
                    let mut points = Batch::random(&mut random, jobs, most, true).points();
                    points.truncate(points.len() - random.below(jobs) as usize);
                    let points = &points[..points.len().max(3 * jobs as usize)];
                    let stalls = [(0, 0), (2, 3), (5, 2), (0, 0)][random.below(4) as usize];
                    let stalls = Stalls { idle: stalls.0, full: stalls.1, beat: 0 };
                    let piece = [points.len(), 1 + random.below(40) as usize][turn % 2];
                    let counters = compare_teams(&mut bench, [contexts, jobs], points, piece, stalls, &mut random);
                    for (sum, value) in seen.iter_mut().zip(&counters.payload) {
                        *sum += u64::from(*value);
                    }
                }
            }
        }
    }
    let least = |counter: Counter, count: u64| {
        let found = seen[counter as usize];
        assert!(found >= count, "{counter:?} only {found} times");
    };
    least(Counter::Insertions, 40_000);
    least(Counter::Duplicates, 20_000);
    least(Counter::Refused, 1000);
    least(Counter::Overflows, 5000);
    least(Counter::Aborts, 20_000);
    least(Counter::PrioritiesTaken, 5000);
}

#[test]
fn a_triple_on_a_line_ends_the_batch() {
    let mut random = Random(32);
    for contexts in [1, 2, 5, 16] {
        let config = Config { name: "test", points: 256, ring: 9, contexts, engines: 1 };
        let mut bench = Bench::new(config);
        for _ in 0..20 {
            let mut batch = Batch::random(&mut random, contexts, 10, true);
            let flat = random.below(contexts) as usize;
            batch.jobs[flat][..3].copy_from_slice(&[0, 0x1_0001, 0x5_0005]);
            let points = batch.points();
            let piece = 1 + random.below(points.len() as u32) as usize;
            compare(&mut bench, contexts, &points, piece, Stalls { idle: 3, full: 3, beat: 0 }, &mut random);
            let nothing = bench.run(&[command_word(Opcode::Insert), 0], 1, Stalls::default(), 500, &mut random);
            let nothing = nothing.expect("in time").swap_remove(0);
            let report = nothing.report();
            assert!(nothing.is(Status::Collinear));
            assert_eq!((report.inserted, report.records), (3 * flat as u32, 4 * flat as u32));
        }
    }
}

#[test]
fn fewer_points_than_three_a_job_are_waited_for() {
    let mut random = Random(33);
    for contexts in [2, 4, 16] {
        let config = Config { name: "test", points: 64, ring: 9, contexts, engines: 1 };
        let mut bench = Bench::new(config);
        let batch = Batch::random(&mut random, contexts, 5, true);
        let points = batch.points();
        for count in 0..=3 * contexts as usize {
            compare(&mut bench, contexts, &points[..count], 1 + count / 3, Stalls::default(), &mut random);
        }
        // The batch has more jobs than the memory has room for.
        let tight = Config { points: 4, ..config };
        let mut bench = Bench::new(tight);
        compare(&mut bench, contexts, &points, points.len(), Stalls::default(), &mut random);
    }
}

#[test]
fn too_many_jobs_are_refused() {
    let mut bench = Bench::new(SMALL);
    let mut by_commands = model(SMALL);
    let mut random = Random(34);
    let points = sets::started(sets::boxed(&mut random, 40, 100));
    bench.insert(0, &points).expect("in time");
    for jobs in [17, 24, 255] {
        let refused = bench.run(&[batch_word(jobs)], 1, Stalls::default(), 500, &mut random).expect("in time");
        assert!(refused[0].is(Status::BadContexts));
        assert_eq!(expected(&mut by_commands, &[batch_word(jobs)]), refused);
    }
    let more = bench.run(&[command_word(Opcode::Insert), 1, 0x7_0009], 1, Stalls::default(), 5000, &mut random);
    assert_eq!(more.expect("in time")[0].report().arrived, 44, "nothing was cleared");
}

/// A number of jobs that does not divide that of the contexts leaves everything as it is.
#[test]
fn a_number_of_jobs_must_divide_that_of_the_contexts() {
    let config = Config { name: "test", points: 64, ring: 32, contexts: 24, engines: 1 };
    let mut bench = Bench::new(config);
    let mut by_commands = model(config);
    let mut random = Random(38);
    let points = sets::started(sets::boxed(&mut random, 20, 100));
    bench.insert(0, &points).expect("in time");
    by_commands.send(&words_of(clear_word(0), &points, points.len()));
    by_commands.receive(&mut [0; 9]);
    for contexts in 0..=26 {
        for jobs in 0..=127 {
            let working = if contexts == 0 { 24 } else { contexts };
            let fits = working <= 24 && (jobs == 0 || working % jobs == 0);
            if fits {
                continue;
            }
            let words = [teams_word(contexts, jobs)];
            let refused = bench.run(&words, 1, Stalls::default(), 500, &mut random).expect("in time");
            assert!(refused[0].is(Status::BadContexts), "{contexts} contexts, {jobs} jobs");
            assert_eq!(expected(&mut by_commands, &words), refused);
        }
    }
    let more = bench.run(&[command_word(Opcode::Insert), 1, 0x7_0009], 1, Stalls::default(), 5000, &mut random);
    assert_eq!(more.expect("in time")[0].report().arrived, 24, "nothing was cleared");
    assert_eq!(by_commands.mesh().counts().arrived, 23, "nothing was cleared");
}

#[test]
fn reset_in_mid_batch_leaves_nothing_behind() {
    let mut random = Random(35);
    for contexts in [2, 16] {
        let config = Config { name: "test", points: 256, ring: 9, contexts, engines: 1 };
        let mut bench = Bench::new(config);
        for _ in 0..20 {
            let points = Batch::random(&mut random, contexts, 12, true).points();
            let clocks = u64::from(random.below(6000));
            let words = words_of(batch_word(0), &points, points.len());
            // The run may end before the limit or not; both are fine.
            let _ = bench.run(&words, 2, Stalls::default(), clocks, &mut random);
            bench.reset();
            // A reset must end the batch as well.
            let points = sets::started(sets::boxed(&mut random, 60, 50));
            let words = words_of(clear_word(0), &points, points.len());
            let answers = bench.run(&words[1..], 1, Stalls::default(), limit(60), &mut random).expect("in time");
            let mut alone = model(config);
            assert_eq!(expected(&mut alone, &words)[1], answers[0]);
        }
    }
}

/// Sixteen jobs of 200 points each, without back-pressure.
#[test]
fn sixteen_small_jobs_side_by_side_keep_the_core_busy() {
    let mut random = Random(36);
    let jobs = (0..16).map(|_| sets::started(sets::boxed(&mut random, 197, 1 << 16))).collect();
    let points = Batch { jobs }.points();
    assert_eq!(points.len(), 3200);
    let mut bench = Bench::new(FULL);
    let counters = compare(&mut bench, 16, &points, points.len(), Stalls::default(), &mut random);
    let cycles = counters.counter(Counter::InsertCycles) as f64 / counters.counter(Counter::Insertions) as f64;
    println!("{cycles:.2} cycles an insertion");
    assert!(cycles < 30.0, "{cycles}");
}
