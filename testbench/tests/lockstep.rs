//! The core beside its model, every root port at every clock: random and adversarial jobs, crossed with idle and back-pressure,
//! resets in mid-job, random initial states; and broken cores, which must be caught. More than 11 million clocks in all.
//!
//! At the end of every job the host reads the whole triangle memory, lock bits included, so that is compared too, and all
//! answers are compared with the model by commands, which knows no clock.

mod lockstep_rig;

use incircle::Point;
use incircle_cli::generate::{generate, Distribution, SplitMix64};
use incircle_protocol::{command_word, Config, Counter, Opcode, COUNTER_WORDS, FULL, SMALL, TINY};
use incircle_testbench::lockstep::{Job, Stalls};
use lockstep_rig::{ordered, word, Rig};

const RING9: Config = Config { ring: 9, ..SMALL };

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
        let points: Vec<u32> = (0..count)
            .map(|_| word(random.below(side), random.below(side)))
            .collect();
        let piece = 1 + random.below(4) as usize;
        rig.run(&points, piece, Stalls::ALL[job as usize % 9]);
    }
    rig.expect_clocks(1_000_000);
}

#[test]
fn overflowing_lists() {
    let mut rig = Rig::new("core_small_ring9", RING9, 2);
    let mut random = SplitMix64::new(2);
    for (k, &distribution) in Distribution::all().iter().enumerate() {
        let points = ordered(distribution, 300, 12, k as u64);
        rig.run(&points, 300, Stalls::ALL[k % 9]);
        // Unordered points make large cavities.
        let mut points = points;
        random.shuffle(&mut points);
        rig.run(&points, 77, Stalls::NONE);
    }
    assert!(
        rig.counted(Counter::Overflows) > 150,
        "{} overflows",
        rig.counted(Counter::Overflows)
    );
    rig.expect_clocks(800_000);
}

#[test]
fn every_distribution_to_the_brim() {
    let mut rig = Rig::new("core_small", SMALL, 3);
    for (k, &distribution) in Distribution::all().iter().enumerate() {
        rig.start_anew(k as u32);
        // One point more than it holds, one less, and many duplicates in few bits.
        rig.run(
            &ordered(distribution, 1025, 16, k as u64),
            1025,
            Stalls::ALL[k % 9],
        );
        rig.run(
            &ordered(distribution, 1023, 8, k as u64),
            400,
            Stalls::ALL[(k + 4) % 9],
        );
        rig.run(
            &ordered(distribution, 600, 16, 7 + k as u64),
            600,
            Stalls::NONE,
        );
    }
    rig.expect_clocks(4_500_000);
}

#[test]
fn the_full_core() {
    let mut rig = Rig::new("core_full", FULL, 4);
    for distribution in [
        Distribution::Uniform,
        Distribution::Kuzmin,
        Distribution::Lattice,
        Distribution::Line,
    ] {
        rig.run(&ordered(distribution, 8192, 16, 4), 8192, Stalls::NONE);
    }
    rig.expect_clocks(4_600_000);
}

#[test]
fn resets_in_mid_job() {
    let mut rig = Rig::new("core_small_ring9", RING9, 5);
    let mut random = SplitMix64::new(5);
    for k in 0..150 {
        let points = ordered(Distribution::all()[k % 13], 60, 8, k as u64);
        rig.run_and_reset(&points, random.below(9000), Stalls::ALL[k % 9]);
        if k % 10 == 0 {
            rig.run(&points, 60, Stalls::NONE);
        }
    }
    rig.expect_clocks(500_000);
}

#[test]
fn commands_out_of_place() {
    let mut rig = Rig::new("core_tiny", TINY, 6);
    let mut random = SplitMix64::new(6);
    for k in 0..300 {
        let mut commands = Vec::new();
        for _ in 0..20 {
            let mut more = match random.below(6) {
                0 => vec![(random.below(256) as u32) << 24],
                1 => vec![
                    command_word(Opcode::Read),
                    random.below(20) as u32,
                    random.below(20) as u32,
                ],
                2 => vec![
                    command_word(Opcode::Read),
                    u32::MAX - random.below(3) as u32,
                    random.below(5) as u32,
                ],
                3 => vec![command_word(Opcode::Counters)],
                4 => vec![command_word(Opcode::Clear)],
                _ => vec![
                    command_word(Opcode::Insert),
                    2,
                    word(random.below(9), 3),
                    word(4, random.below(9)),
                ],
            };
            // A random opcode may want arguments.
            match more[0] >> 24 {
                3 if more.len() == 1 => more.push(0),
                4 if more.len() == 1 => more.extend([0, 0]),
                _ => {}
            }
            commands.extend(more);
        }
        rig.run_commands(&commands, Stalls::ALL[k % 9]);
    }
    rig.expect_clocks(300_000);
}

#[test]
fn broken_cores_are_caught() {
    for name in ["broken_comparison", "broken_link", "broken_tie"] {
        let caught = [Distribution::Uniform, Distribution::Lattice]
            .into_iter()
            .find_map(|distribution| {
                let points: Vec<u32> = ordered(distribution, 200, 6, 1);
                let job = Job::of(&points, 200, SMALL.points, SMALL.ring);
                let mut pair = incircle_testbench::lockstep::Lockstep::new(name, SMALL, 1);
                let mut random = SplitMix64::new(1);
                pair.run(&job, Stalls::NONE, &mut || random.next_u64())
                    .err()
            });
        let mismatch = caught.unwrap_or_else(|| panic!("{name} passes"));
        println!("{name}: {mismatch}\n");
    }
}

#[test]
fn the_words_of_a_job_hold_what_the_documents_say() {
    // The rig compares the answers' tail with the model by commands; this holds that the tail is where it looks.
    let job = Job::of(
        &[0, word(9, 0), word(0, 9), word(3, 3)],
        4,
        TINY.points,
        TINY.ring,
    );
    assert_eq!(
        job.answers,
        2 + 7 + 2 + 2 + 5 + 2 + 3 * 6 + 2 + COUNTER_WORDS
    );
    assert_eq!(
        generate(Distribution::Uniform, 3, 16, 1)
            .map(|points| points.len())
            .ok(),
        Some(3)
    );
    assert_eq!(Point::from((1, 2)), Point { x: 1, y: 2 });
}
