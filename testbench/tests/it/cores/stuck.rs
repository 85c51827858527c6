//! Tests the watchdog in the whole core. Core and model both take a context's own locks for those of another one, so a
//! job hangs in both. Both must report it in the same clock, refuse what comes then, and work again after a reset.
//! Cores in which some block does not hear of it must be caught.

use incircle_model::{Defect, Inputs};
use incircle_protocol::{answer_status, command_word, patience, Opcode, Status, INSERT_REPORT_WORDS, SMALL};
use incircle_testbench::lockstep::{Job, Lockstep, Mismatch, Stalls};
use incircle_testkit::SplitMix64;

/// A core with faults behind switches; see `src/lockstep/faults.rs`.
const FAULTY: &str = "faulty_core_small";
/// Answer words of an `Insert`, with its header.
const REPORT: usize = 2 + INSERT_REPORT_WORDS;

/// Points among which a cavity meets a lock of its own.
fn points(seed: u64, count: u32) -> Vec<u32> {
    let mut random = SplitMix64::new(seed);
    (0..count).map(|_| random.next_u64() as u32).collect()
}

/// A job that inserts all points at once.
fn insert(points: &[u32]) -> Job {
    Job { commands: [&[command_word(Opcode::Insert), points.len() as u32], points].concat(), answers: REPORT }
}

/// A pair in which both hang; the core has these faults besides.
fn hanging(seed: u32, faults: &[&str]) -> Lockstep {
    Lockstep::faulty(FAULTY, SMALL, seed, &[&["own_lock"], faults].concat()).with_defect(Defect::TakesOwnForForeign)
}

/// Checks everything that a stuck core must do: report it, refuse points, answer other commands,
/// and work again after a reset.
fn get_stuck(pair: &mut Lockstep, stalls: Stalls) -> Result<(), Mismatch> {
    let mut random = SplitMix64::new(9);
    let mut random = || random.next_u64();
    let is_stuck = |answers: &[u32]| answer_status(answers[0]) == Status::Stuck as u8;
    let answers = pair.run(&insert(&points(1, 100)), stalls, &mut random)?;
    assert!(is_stuck(&answers), "{answers:x?}");
    assert!(pair.clocks() > u64::from(patience(SMALL.points)), "{} clocks", pair.clocks());
    let again = pair.run(&insert(&points(2, 30)), stalls, &mut random)?;
    assert!(is_stuck(&again), "{again:x?}");
    let refused = 5;
    assert_eq!(again[refused], answers[refused] + 30, "{again:x?} after {answers:x?}");
    for opcode in [Opcode::Hello, Opcode::Counters, Opcode::Latencies] {
        let commands = vec![command_word(opcode)];
        let answer = pair.run(&Job { commands, answers: 1 }, stalls, &mut random)?;
        assert!(!is_stuck(&answer), "{answer:x?}");
        // Takes the rest of the answer.
        for _ in 0..400 {
            pair.clock(Inputs { response_ready: true, ..Inputs::default() })?;
        }
    }
    // `Clear` empties the mesh but mends nothing: there is no first triangle then, and points must not wait for one.
    pair.run(&Job { commands: vec![command_word(Opcode::Clear)], answers: 2 }, stalls, &mut random)?;
    let cleared = pair.run(&insert(&points(3, 30)), stalls, &mut random)?;
    assert!(is_stuck(&cleared), "{cleared:x?}");
    pair.clock(Inputs { reset: true, ..Inputs::default() })?;
    let few = pair.run(&insert(&[0, 9, 0x9_0000]), stalls, &mut random)?;
    assert_eq!(answer_status(few[0]), Status::Ok as u8, "{few:x?}");
    Ok(())
}

#[test]
fn a_core_that_hangs_says_so_in_the_clock_in_which_the_model_does() {
    for (seed, stalls) in (1..).zip([Stalls::NONE, Stalls::ALL[4]]) {
        get_stuck(&mut hanging(seed, &[]), stalls).unwrap_or_else(|mismatch| panic!("{mismatch}"));
    }
}

#[test]
fn cores_in_which_a_block_does_not_hear_of_it_are_caught() {
    for fault in [
        "watchdog_is_silent",
        "command_port_ignores_stuck",
        "settle_ignores_stuck",
        "slot_ignores_stuck",
        "answer_ignores_stuck",
    ] {
        let mismatch = get_stuck(&mut hanging(1, &[fault]), Stalls::NONE).expect_err(fault);
        println!("{fault}: {mismatch}\n");
        assert!(mismatch.clock > u64::from(patience(SMALL.points)), "{fault}: {mismatch}");
    }
}
