//! The rules of moves are needed: a core without one of them does some script of moves, deletions, insertions and
//! questions wrong, or comes into a state that no core can be in. The complete core does all of these scripts right.

use super::deletion_defects::expect_in;
use super::moves::KINDS;
use incircle_model::Defect;

fn expect(defect: Defect, most: u32) {
    expect_in(&KINDS, defect, most);
}

/// M12: otherwise an edge stays that the new place does not allow.
#[test]
fn moves_in_place_look_at_all_edges() {
    expect(Defect::MovesWithoutLook, 600);
}

/// M14: otherwise a walk takes a word that is no point for a vertex at its place.
#[test]
fn points_that_are_torn_are_read_again() {
    expect(Defect::ReadsTheTornPoint, 20_000);
}

/// M3, M6: a move locks the records outside its star, and releases them after its last write.
#[test]
fn moves_lock_as_deletions_do() {
    expect(Defect::LeavesTheRingOpen, 600);
    expect(Defect::ReleasesBeforeWritten, 600);
}
