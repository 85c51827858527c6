//! Every lock rule of deletions is needed: a core without one of them does some script of insertions, deletions and
//! questions wrong, hangs, or comes into a state that no core can be in. The complete core does all of these scripts
//! right. Rules that deletions share with insertions have the defects of those.

use super::deletions::KINDS;
use super::moves;
use crate::common::living::{Fault, Pair};
use crate::living::scripts::Script;
use incircle_model::{ClockModel, Defect};
use incircle_protocol::RunKind;
use std::panic::{catch_unwind, AssertUnwindSafe};

/// What went wrong in a script without a rule.
#[derive(Clone, Debug)]
enum Symptom {
    Hang,
    Wrong,
    Panic,
}

/// Runs a script in 16 contexts on a core with or without one of its rules.
fn run(kinds: &'static [RunKind], seed: u32, defect: Option<Defect>) -> Result<(), Fault> {
    let mut script = Script::crowded(seed);
    script.kinds = kinds;
    let config = script.config();
    let core = ClockModel::new(config).expect("a core that can be built").with_core_runs();
    let core = match defect {
        Some(defect) => core.with_defect(defect),
        None => core,
    };
    script.run_on(Pair::of(config, core)).map(drop)
}

fn symptom(kinds: &'static [RunKind], seed: u32, defect: Defect) -> Option<Symptom> {
    match catch_unwind(AssertUnwindSafe(|| run(kinds, seed, Some(defect)).err())) {
        Err(_) => Some(Symptom::Panic),
        Ok(None) => None,
        Ok(Some(Fault::Hang)) => Some(Symptom::Hang),
        Ok(Some(Fault::Wrong(_))) => Some(Symptom::Wrong),
    }
}

/// Looks for the first of so many scripts that a core without this rule does wrong.
fn expect(defect: Defect, most: u32) {
    expect_in(&KINDS, defect, most);
}

/// As [`expect`], in scripts of these kinds of runs.
pub fn expect_in(kinds: &'static [RunKind], defect: Defect, most: u32) {
    for seed in 0..most {
        if let Some(found) = symptom(kinds, seed, defect) {
            if let Err(fault) = run(kinds, seed, None) {
                panic!("the complete core, script {seed}: {fault:?}");
            }
            println!("{defect:?}, script {seed}: {found:?}");
            return;
        }
    }
    panic!("{defect:?} does not show in {most} scripts");
}

/// M1: otherwise an attempt works on lists and locks that the change before still needs.
#[test]
fn roots_wait_for_the_last_locks() {
    // A walk to the next vertex of a run of deletions is hardly ever over before the locks of the last deletion are
    // released. That of a vertex that goes back into the mesh may be.
    expect_in(&moves::KINDS, Defect::OpensWhileBusy, 600);
}

/// M2: otherwise a record that has changed since the walk becomes the root of a star.
#[test]
fn roots_of_stars_are_looked_at_under_their_lock() {
    expect(Defect::TrustsTheWalkToAVertex, 600);
}

/// M3: otherwise two stars on both sides of an edge are filled at once.
#[test]
fn the_ring_of_a_star_is_locked() {
    expect(Defect::LeavesTheRingOpen, 600);
}

/// M4: otherwise two attempts write the same records.
#[test]
fn foreign_locks_count() {
    expect(Defect::IgnoresForeignLocks, 600);
}

/// M4: otherwise a visit that is in flight takes a lock after the release.
#[test]
fn attempts_drain_before_they_release() {
    expect(Defect::ReleasesBeforeDrained, 600);
}

/// M5: otherwise contexts abort each other for ever.
#[test]
fn somebody_waits() {
    expect(Defect::NobodyTakesPriority, 600);
}

/// M6: otherwise another attempt begins on records that are still to be written.
#[test]
fn locks_are_released_after_the_last_write() {
    expect(Defect::ReleasesBeforeWritten, 600);
}

/// M7: otherwise a context waits for itself, because a record can be outside two edges of one star.
#[test]
fn locks_name_their_holders() {
    expect(Defect::TakesOwnForForeign, 600);
}

/// M8: otherwise a walk ends in a record that is no triangle of the mesh any more.
#[test]
fn free_records_are_marked() {
    expect(Defect::LeavesFreeRecordsUnmarked, 600);
}
