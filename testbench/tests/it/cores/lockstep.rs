//! Runs the core beside its model and compares every root port at every clock: random and adversarial jobs, crossed
//! with idle clocks and back-pressure, resets in the middle of a job, random initial states, 1 to 24 contexts. Broken
//! cores must be caught. All tests together run more than 30 million clocks.
//!
//! At the end of every job the host reads the whole triangle memory, lock bits included, so that memory is
//! compared too. The vertex memory shows only in the decisions of the core. All answers are compared with the
//! model by commands, which knows no clock.

use crate::rig::lockstep::{ordered, word, Rig};
use incircle_protocol::{
    batch_word, clear_word, command_word, Config, Counter, Opcode, CLEAR_TAG_SHIFT, FULL, LARGE, PADDING, SMALL, TINY,
};
use incircle_testbench::lockstep::{Job, Lockstep, Mismatch, Stalls, FAULTS};
use incircle_testkit::{words, Batch, Distribution, Random32, SplitMix64};
use std::path::PathBuf;

const RING9: Config = Config { ring: 9, ..SMALL };
const ONE_CONTEXT: Config = Config { contexts: 1, ..SMALL };
const LONG_LIST: Config = Config { ring: 64, contexts: 8, ..SMALL };
const TWELVE_CONTEXTS: Config = Config { contexts: 12, ..SMALL };

#[test]
fn tiny_jobs_in_tiny_boxes() {
    let mut rig = Rig::new("core_tiny", TINY, 1);
    let mut random = SplitMix64::new(1);
    for job in 0..2000 {
        if job % 100 == 0 {
            rig.start_anew(job);
        }
        let side = [2, 3, 4, 16, 1 << 16][job as usize % 5];
        let count = random.below(12);
        let points: Vec<u32> = (0..count).map(|_| word(random.below(side), random.below(side))).collect();
        let piece = 1 + random.below(4) as usize;
        rig.run(&points, piece, job % 3, Stalls::ALL[job as usize % 9]);
    }
    rig.expect_clocks(1_000_000);
}

#[test]
fn overflowing_lists() {
    let mut rig = Rig::new("core_small_ring9", RING9, 2);
    let mut random = SplitMix64::new(2);
    for (k, &distribution) in Distribution::all().iter().enumerate() {
        let points = ordered(distribution, 300, 12, k as u64, 4);
        rig.run(&points, 300, 0, Stalls::ALL[k % 9]);
        // Points without an order make large cavities.
        let mut points = points;
        random.shuffle(&mut points);
        rig.run(&points, 77, k as u32 % 5, Stalls::NONE);
    }
    assert!(rig.counted(Counter::Overflows) > 150, "{} overflows", rig.counted(Counter::Overflows));
    rig.expect_clocks(800_000);
}

#[test]
fn every_distribution_to_the_brim() {
    let mut rig = Rig::new("core_small", SMALL, 3);
    for (k, &distribution) in Distribution::all().iter().enumerate() {
        rig.start_anew(k as u32);
        // One point more than the core holds, one less, and many duplicates in few bits.
        rig.run(&ordered(distribution, 1025, 16, k as u64, 4), 1025, 0, Stalls::ALL[k % 9]);
        rig.run(&ordered(distribution, 1023, 8, k as u64, 3), 400, 3, Stalls::ALL[(k + 4) % 9]);
        rig.run(&ordered(distribution, 600, 16, 7 + k as u64, 1), 600, 1, Stalls::NONE);
        rig.run(&ordered(distribution, 700, 12, 9 + k as u64, 2), 700, 2, Stalls::NONE);
    }
    rig.expect_clocks(3_000_000);
}

/// The cores of `incircle-sim` are translated from a text that was rewritten for speed, which must change no port.
#[test]
fn fast_clocks_change_no_port() {
    let mut rig = Rig::new("core_fast_clocks", SMALL, 5);
    for (k, &distribution) in Distribution::all().iter().enumerate() {
        rig.start_anew(k as u32);
        rig.run(&ordered(distribution, 1000, 16, k as u64, 16), 1000, 0, Stalls::ALL[k % 9]);
        rig.run(&ordered(distribution, 400, 8, k as u64, 1), 100, 1, Stalls::ALL[(k + 4) % 9]);
    }
    rig.expect_clocks(500_000);
}

#[test]
fn the_full_core() {
    let mut rig = Rig::new("core_full", FULL, 4);
    use Distribution::{Checkers, Kuzmin, Lattice, Line, Normal, Uniform};
    for (contexts, distributions) in [
        (0, &[Uniform, Kuzmin, Lattice, Line, Normal, Checkers][..]),
        (4, &[Normal, Lattice]),
        (2, &[Kuzmin, Line]),
        (1, &[Uniform]),
    ] {
        for &distribution in distributions {
            let dealt = if contexts == 0 { FULL.contexts } else { contexts };
            rig.run(&ordered(distribution, 8192, 16, 4, dealt), 8192, contexts, Stalls::NONE);
        }
    }
    rig.expect_clocks(3_700_000);
}

#[test]
fn one_context() {
    let mut rig = Rig::new("core_small_one", ONE_CONTEXT, 10);
    for (k, &distribution) in Distribution::all().iter().enumerate() {
        for seed in 0..4 {
            rig.start_anew(k as u32 + seed);
            let bits = [16, 10, 6, 16][seed as usize];
            rig.run(
                &ordered(distribution, 1024, bits, u64::from(seed), 1),
                1024,
                1,
                Stalls::ALL[(k + 2 * seed as usize) % 9],
            );
        }
    }
    rig.expect_clocks(7_500_000);
}

#[test]
fn four_contexts() {
    let mut rig = Rig::new("core_small", SMALL, 11);
    let mut random = SplitMix64::new(11);
    for (k, &distribution) in Distribution::all().iter().enumerate() {
        for seed in 0..10 {
            rig.start_anew(k as u32 + seed);
            let bits = [16, 10, 6, 4, 12][seed as usize % 5];
            let mut points = ordered(distribution, 1024, bits, u64::from(seed), 4);
            // Contexts meet often when their points come in no order.
            if seed % 2 == 1 {
                random.shuffle(&mut points[3..]);
            }
            rig.run(&points, 1024, 4, Stalls::ALL[(k + 2 * seed as usize) % 9]);
        }
    }
    rig.expect_clocks(7_500_000);
}

#[test]
fn twelve_contexts() {
    let mut rig = Rig::new("core_small_twelve", TWELVE_CONTEXTS, 12);
    let mut random = SplitMix64::new(12);
    for (k, &distribution) in Distribution::all().iter().enumerate() {
        for seed in 0..12 {
            rig.start_anew(k as u32 + seed);
            let bits = [16, 10, 6, 4, 12][seed as usize % 5];
            let mut points = ordered(distribution, 1024, bits, u64::from(seed), 12);
            if seed % 2 == 1 {
                random.shuffle(&mut points[3..]);
            }
            rig.run(&points, 1024, 12, Stalls::ALL[(k + 2 * seed as usize) % 9]);
        }
    }
    let counted =
        [Counter::Aborts, Counter::PrioritiesTaken, Counter::RootRetries, Counter::Revisits, Counter::Overflows];
    for counter in counted {
        assert!(rig.counted(counter) > 15, "{counter:?}: {}", rig.counted(counter));
    }
    rig.expect_clocks(7_500_000);
}

#[test]
fn resets_in_mid_job() {
    let mut rig = Rig::new("core_small_ring9", RING9, 5);
    let mut random = SplitMix64::new(5);
    for k in 0..150 {
        let points = ordered(Distribution::all()[k % Distribution::all().len()], 60, 8, k as u64, 4);
        rig.run_and_reset(&points, random.below(9000), Stalls::ALL[k % 9]);
        if k % 10 == 0 {
            rig.run(&points, 60, 0, Stalls::NONE);
        }
    }
    rig.expect_clocks(500_000);
}

/// A random command at any place of a stream: with any low bits, even where they mean nothing; batches; inserts of no
/// point and of more points than fit.
fn any_command(random: &mut SplitMix64, config: Config) -> Vec<u32> {
    let [most, records] = [config.points, 2 * config.points].map(u64::from);
    let mut below = |limit: u64| random.below(limit) as u32;
    let low = [0, below(1 << 24)][below(2) as usize];
    let command = |opcode| command_word(opcode) | low;
    match below(11) {
        0 => vec![below(256) << 24 | low],
        1 => vec![command(Opcode::Read), below(records + 4), below(20)],
        2 => vec![command(Opcode::Read), u32::MAX - below(3), below(5)],
        3 => vec![command(Opcode::Counters)],
        4 => vec![clear_word(below(4)) | below(256) << CLEAR_TAG_SHIFT],
        5 => vec![batch_word(below(u64::from(config.contexts) + 2)) | below(256) << CLEAR_TAG_SHIFT],
        6 => vec![command(Opcode::Triangles), below(records), below(14)],
        7 => vec![PADDING; below(4) as usize + 1],
        8 => vec![command(Opcode::Clear)],
        kind => {
            let count = below(if kind == 9 { 7 } else { (most + 3).min(40) });
            let points = (0..count).map(|_| below(9) | below(9) << 16);
            [command(Opcode::Insert), count].into_iter().chain(points).collect()
        }
    }
}

fn commands_out_of_place_on(core: &'static str, config: Config, seed: u32) {
    let mut rig = Rig::new(core, config, seed);
    let mut random = SplitMix64::new(u64::from(seed));
    for k in 0..300 {
        let mut commands = Vec::new();
        for _ in 0..20 {
            let mut more = any_command(&mut random, config);
            // A random opcode may need arguments.
            match more[0] >> 24 {
                3 if more.len() == 1 => more.push(0),
                4 | 7 if more.len() == 1 => more.extend([0, 0]),
                _ => {}
            }
            commands.extend(more);
        }
        rig.run_commands(&commands, Stalls::ALL[k % 9]);
    }
    rig.expect_clocks(300_000);
}

#[test]
fn commands_out_of_place() {
    commands_out_of_place_on("core_tiny", TINY, 6);
}

#[test]
fn commands_out_of_place_on_a_core_of_four_contexts() {
    commands_out_of_place_on("core_small", SMALL, 16);
}

#[test]
fn the_least_core_and_the_longest_list() {
    let least = Config { points: 4, ring: 3, ..SMALL };
    let mut rig = Rig::new("core_least", least, 7);
    let mut random = SplitMix64::new(7);
    for job in 0..500 {
        let side = [3, 9, 1 << 16][job % 3];
        let count = random.below(7);
        let points: Vec<u32> = (0..count).map(|_| word(random.below(side), random.below(side))).collect();
        rig.run(&points, 3, 0, Stalls::ALL[job % 9]);
    }
    rig.expect_clocks(100_000);
    let ring64 = Config { ring: 64, ..SMALL };
    let mut rig = Rig::new("core_small_ring64", ring64, 8);
    for distribution in [Distribution::Parabola, Distribution::TwoChains, Distribution::Lattice] {
        let mut points = ordered(distribution, 700, 16, 8, 4);
        rig.run(&points, 700, 0, Stalls::NONE);
        random.shuffle(&mut points);
        rig.run(&points, 700, 0, Stalls::ALL[4]);
    }
    rig.expect_clocks(500_000);
}

#[test]
fn the_large_core_to_the_brim() {
    let mut rig = Rig::new("core_large", LARGE, 9);
    rig.run(&ordered(Distribution::Uniform, 16385, 16, 9, 24), 16385, 0, Stalls::NONE);
    rig.run(&ordered(Distribution::Kuzmin, 8192, 16, 9, 20), 8192, 20, Stalls::NONE);
    rig.expect_clocks(500_000);
}

/// A core with faults behind switches; see `src/lockstep/faults.rs`.
const FAULTY: &str = "faulty_core_small";

/// Runs some jobs with these faults, returns the first mismatch and leaves its waveform.
fn first_mismatch(core: &str, faults: &[&str], config: Config, jobs: &[Job]) -> Option<(Mismatch, PathBuf)> {
    jobs.iter().find_map(|job| {
        let mut pair = Lockstep::faulty(core, config, 1, faults);
        let mut random = SplitMix64::new(1);
        let mismatch = pair.run(job, Stalls::NONE, &mut || random.next_u64()).err()?;
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{core}_{}.vcd", faults.join("_")));
        pair.leave_waveform(&path).unwrap();
        Some((mismatch, path))
    })
}

/// Checks that one of the jobs catches each fault by itself, and that the same core without a fault passes all jobs.
fn expect_caught(core: &str, faults: &[&str], config: Config, jobs: &[Job]) {
    let sound = first_mismatch(core, &[], config, jobs).map(|(mismatch, _)| mismatch.to_string());
    assert_eq!(sound, None, "the sound core passes the same jobs");
    for fault in faults {
        let (mismatch, path) =
            first_mismatch(core, &[fault], config, jobs).unwrap_or_else(|| panic!("{fault} is not caught"));
        let report = mismatch.to_string();
        println!("{fault}: {report}\n");
        assert_ne!(mismatch.expected, mismatch.found);
        for part in ["clock ", mismatch.port, "the model says", "the model is at: asleep", "last events:\n"] {
            assert!(report.contains(part), "{part:?} is missing in {report}");
        }
        let wave = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert!(wave.contains("$enddefinitions") && wave.contains("response_data"), "{fault}: no waveform");
    }
}

#[test]
fn broken_cores_are_caught_and_reported() {
    let jobs = [(Distribution::Uniform, 6), (Distribution::Lattice, 6), (Distribution::Uniform, 5)]
        .map(|(distribution, bits)| Job::of(&ordered(distribution, 300, bits, 1, 4), 300, 0, SMALL));
    expect_caught(FAULTY, &["comparison", "link", "tie"], SMALL, &jobs);
}

/// Leaves out each rule of `docs/engine.md` in hardware, beside a model that keeps the rule.
/// Rules are named by their ids.
#[test]
fn cores_without_a_rule_of_the_engine_are_caught() {
    let jobs: Vec<Job> = (0..40)
        .map(|seed| {
            let mut points = ordered(Distribution::Uniform, 250, 5 + seed % 3, u64::from(seed), 4);
            SplitMix64::new(u64::from(seed)).shuffle(&mut points[3..]);
            Job::of(&points, 250, 0, SMALL)
        })
        .collect();
    expect_caught(FAULTY, &["foreign_lock", "drain", "rest"], SMALL, &jobs); // L1
    expect_caught(FAULTY, &["priority", "yield"], SMALL, &jobs); // L2 and L3
    expect_caught(FAULTY, &["release", "root", "busy"], SMALL, &jobs); // L4, L5 and L6
    expect_caught(FAULTY, &["torn"], SMALL, &jobs); // L7, of records that are being written
    expect_caught(FAULTY, &["first_round", "own_lock"], SMALL, &jobs); // L8 and L9
    expect_caught(FAULTY, &["walk_end", "tie_side"], SMALL, &jobs); // L10
}

/// Leaves out what keeps teams apart, beside a model that keeps it.
#[test]
fn cores_without_a_rule_of_teams_are_caught() {
    let jobs: Vec<Job> = (0..12)
        .map(|seed| {
            let mut random = Random32(seed);
            let jobs = (0..4).map(|_| words::started(words::boxed(&mut random, 120, 300))).collect();
            let points = Batch { jobs }.points();
            Job::teams_of(&points, points.len(), [16, 4], SMALL)
        })
        .collect();
    expect_caught(FAULTY, &["one_priority"], SMALL, &jobs); // L2
    expect_caught(FAULTY, &["teams_together", "any_mesh"], SMALL, &jobs); // L8 and L11
}

#[test]
fn a_core_that_reads_what_is_not_written_yet_is_caught() {
    // Long cavities take many clocks to write: a walk follows close behind a commit.
    let wheel = |seed| words::started(words::wheel_from_outside(&mut Random32(seed), 120));
    let jobs: Vec<Job> = (0..40).map(|seed| Job::of(&wheel(seed), 250, 0, LONG_LIST)).collect();
    expect_caught("faulty_core_long_list", &["watermark"], LONG_LIST, &jobs);
}

/// Starts a core twenty times out of random flip-flops. The sound core passes every time. A core with a block that
/// lacks its reset fails in at least a quarter of the starts, and for most blocks in nearly all. The jobs clear nothing
/// before they insert, so only the reset can mend the first state of a block.
#[test]
fn cores_with_a_block_that_is_not_reset_are_caught() {
    const STARTS: u32 = 20;
    let points = ordered(Distribution::Uniform, 60, 6, 1, 4);
    let whole = Job::of(&points, 60, 0, SMALL);
    let [hello, _, rest @ ..] = whole.commands.as_slice() else { panic!("a job begins with `Hello` and `Clear`") };
    let commands = [&[*hello], rest].concat();
    let job = Job { commands, answers: whole.answers - 2 };
    let caught = |faults: &[&str]| {
        let run = |seed: &u32| {
            let mut random = SplitMix64::new(u64::from(*seed));
            Lockstep::faulty(FAULTY, SMALL, *seed, faults).run(&job, Stalls::NONE, &mut || random.next_u64()).is_err()
        };
        (0..STARTS).filter(run).count()
    };
    assert_eq!(caught(&[]), 0, "the sound core passes every start");
    let blocks = FAULTS.iter().map(|fault| fault.name).filter(|name| name.ends_with("_without_reset"));
    for (number, fault) in blocks.enumerate() {
        let caught = caught(&[fault]);
        println!("{number} {fault}: {caught} of {STARTS} starts");
        assert!(caught >= STARTS as usize / 4, "{fault}: {caught} of {STARTS} starts");
    }
}
