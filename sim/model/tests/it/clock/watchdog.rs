//! The watchdog: a core that stops finishing points reports it, takes the rest of its points and refuses them. A
//! reset restores the core.

use crate::common::bench::{Bench, Stalls};
use crate::common::mesh_check::canonical;
use crate::common::{sets, Random};
use incircle_model::{Defect, Inputs};
use incircle_protocol::{clear_word, command_word, patience, Config, Counter, Opcode, Status};

const CONFIG: Config = Config { name: "test", points: 128, ring: 32, contexts: 4, engines: 1 };

/// A core that aborts at its own locks, and points whose insertion meets such locks.
fn hanging() -> (Bench, Vec<u32>) {
    (Bench::with_defect(CONFIG, Some(Defect::TakesOwnForForeign)), sets::boxed(&mut Random(1), 100, 1 << 16))
}

#[test]
fn a_core_that_hangs_says_so() {
    let (mut bench, points) = hanging();
    let answer = bench.insert(0, &points).unwrap();
    let report = answer.report();
    assert!(answer.is(Status::Stuck), "{answer:?}");
    assert_eq!(report.arrived + report.refused, 100);
    assert!(report.inserted < 100);
    let least = u64::from(patience(CONFIG.points));
    assert!((least..least + 20_000).contains(&bench.clocks), "{} clocks", bench.clocks);
}

#[test]
fn a_stuck_core_still_answers_and_takes_no_points() {
    let (mut bench, points) = hanging();
    let stuck = bench.insert(0, &points).unwrap();
    let mut words = vec![command_word(Opcode::Insert), 50];
    words.extend(&points[..50]);
    words.extend([command_word(Opcode::Hello), command_word(Opcode::Counters)]);
    let answers = bench.run(&words, 3, Stalls { idle: 3, full: 3, beat: 0 }, 10_000, &mut Random(2)).unwrap();
    assert!(answers[0].is(Status::Stuck));
    assert_eq!(answers[0].report().arrived, stuck.report().arrived);
    assert_eq!(answers[0].report().refused, stuck.report().refused + 50);
    assert!(answers[1].is(Status::Ok));
    assert_eq!(answers[2].counter(Counter::Insertions), u64::from(stuck.report().inserted));
}

#[test]
fn reset_mends_a_stuck_core() {
    let (mut bench, points) = hanging();
    assert!(bench.insert(0, &points).unwrap().is(Status::Stuck));
    bench.reset();
    // With so few points no attempt meets a lock of its own.
    let few = [0, 9, 0x9_0000, 0x2_0002];
    let answer = bench.insert(0, &few).unwrap();
    assert!(answer.is(Status::Ok), "{answer:?}");
    canonical(&bench.records(answer.report().records), &few, CONFIG.points).unwrap();
}

/// Runs clocks in which nothing is offered.
fn rest(bench: &mut Bench, clocks: u32) {
    for _ in 0..clocks {
        bench.core.clock(Inputs { response_ready: true, ..Inputs::default() });
    }
}

#[test]
fn a_slow_host_is_no_fault() {
    let mut bench = Bench::new(CONFIG);
    let points = sets::boxed(&mut Random(3), 12, 1 << 16);
    let mut words = vec![clear_word(0), command_word(Opcode::Insert), 12];
    words.extend(&points);
    let mut answers = Vec::new();
    // The host rests before the first point, after each of the first four, and before the last.
    for (piece, count) in [(0..3, 1), (3..4, 0), (4..5, 0), (5..6, 0), (6..7, 0), (7..14, 0), (14..15, 1)] {
        answers.extend(bench.run(&words[piece], count, Stalls::default(), 100_000, &mut Random(4)).unwrap());
        rest(&mut bench, patience(CONFIG.points) + 100);
    }
    assert!(answers.iter().all(|answer| answer.is(Status::Ok)), "{answers:?}");
    assert_eq!(answers[1].report().inserted, 12);
}
