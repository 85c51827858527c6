//! Every lock rule of the living engine is needed: a core without one of them does some script wrong, hangs, or comes
//! into a state that no core can be in. The complete core does all of these scripts right.

use super::scripts::Script;
use crate::common::living::Fault;
use incircle_model::LivingDefect;
use std::panic::{catch_unwind, AssertUnwindSafe};

/// What went wrong in a script without this rule.
#[derive(Clone, Debug)]
enum Symptom {
    Hang,
    Wrong,
    Panic,
}

fn symptom(seed: u32, rule: LivingDefect) -> Option<Symptom> {
    let result = catch_unwind(AssertUnwindSafe(|| Script::crowded(seed).run(Some(rule)).err()));
    match result {
        Err(_) => Some(Symptom::Panic),
        Ok(None) => None,
        Ok(Some(Fault::Hang)) => Some(Symptom::Hang),
        Ok(Some(Fault::Wrong(_))) => Some(Symptom::Wrong),
    }
}

/// Looks for the first script that a core without this rule does wrong.
fn expect(rule: LivingDefect, most: u32) {
    for seed in 0..most {
        if let Some(found) = symptom(seed, rule) {
            if let Err(fault) = Script::crowded(seed).run(None) {
                panic!("the complete core, script {seed}: {fault:?}");
            }
            println!("{rule:?}, script {seed}: {found:?}");
            return;
        }
    }
    panic!("{rule:?} does not show in {most} scripts");
}

/// M1: otherwise an attempt works on lists and locks that the commit before still needs.
#[test]
fn roots_wait_for_the_last_locks() {
    expect(LivingDefect::OpensWhileBusy, 600);
}

/// M2: otherwise a record that has changed since the walk becomes a root.
#[test]
fn roots_are_looked_at_under_their_lock() {
    expect(LivingDefect::TrustsTheWalk, 600);
}

/// M3: otherwise two stars on both sides of an edge are filled at once.
#[test]
fn the_ring_of_a_star_is_locked() {
    expect(LivingDefect::LeavesTheRingOpen, 600);
}

/// M4: otherwise two attempts write the same records.
#[test]
fn foreign_locks_count() {
    expect(LivingDefect::IgnoresForeignLocks, 600);
}

/// M4: otherwise a visit that is in flight takes a lock after the release.
#[test]
fn attempts_drain_before_they_release() {
    expect(LivingDefect::ReleasesBeforeDrained, 600);
}

/// M5: otherwise contexts abort each other for ever.
#[test]
fn somebody_waits() {
    expect(LivingDefect::NobodyTakesPriority, 600);
}

/// M6: otherwise another attempt begins on records that are still to be written.
#[test]
fn locks_are_released_after_the_last_write() {
    expect(LivingDefect::ReleasesBeforeWritten, 600);
}

/// M7: otherwise an attempt waits for a lock of its own.
#[test]
fn locks_name_their_holders() {
    expect(LivingDefect::TakesOwnForForeign, 600);
}

/// M8: otherwise a walk takes a record that is free for one of the mesh.
#[test]
fn free_records_are_marked() {
    expect(LivingDefect::LeavesNoMark, 600);
}

/// M10: otherwise the search for the nearest vertex ends at another vertex of a tie.
#[test]
fn the_smaller_point_is_the_nearer() {
    expect(LivingDefect::NearestByNumber, 600);
}

/// M11: otherwise a question sees a mesh that is being written.
#[test]
fn parts_are_given_after_the_last_write() {
    expect(LivingDefect::AnswersBeforeWritten, 600);
}

/// M12: otherwise a vertex moves out of its star.
#[test]
fn moves_look_at_all_edges() {
    expect(LivingDefect::MovesWithoutLook, 600);
}

/// M13: otherwise flips change records that other attempts have locked.
#[test]
fn solo_insertions_are_alone() {
    expect(LivingDefect::SoloBesideOthers, 600);
}

/// `INCIRCLE_SCRIPTS` says how many scripts run without each rule; 300 if it says nothing.
#[test]
#[ignore = "counts for docs/living-mesh.md, which take a minute"]
fn how_many_scripts_go_wrong_without_each_rule() {
    let scripts = std::env::var("INCIRCLE_SCRIPTS").ok().and_then(|text| text.parse().ok()).unwrap_or(300);
    for rule in LivingDefect::ALL {
        let found: Vec<Symptom> = (0..scripts).filter_map(|seed| symptom(seed, rule)).collect();
        let count = |is: fn(&Symptom) -> bool| found.iter().filter(|&symptom| is(symptom)).count();
        let (hangs, panics) = (count(|s| matches!(s, Symptom::Hang)), count(|s| matches!(s, Symptom::Panic)));
        let wrong = found.len() - hangs - panics;
        println!("{rule:?}: {wrong} wrong, {hangs} hang, {panics} panic, of {scripts}");
    }
}
