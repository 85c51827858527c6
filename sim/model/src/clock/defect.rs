//! Rules of the engine that can be left out, to show that each rule is needed and that tests notice its absence.

/// A rule, or a part of a rule, that is left out. `docs/engine.md` says what each rule of insertions (L) demands, and
/// `docs/living-mesh.md` each rule of a mesh that lives (M). Deletions without M1, M4, M5, M6 or M7 are those without
/// L6, L1, L2, L4 or L9.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Defect {
    /// L1: a test that finds a foreign lock goes on.
    IgnoresForeignLocks,
    /// L1: an aborting attempt releases its locks while some of its visits are still in flight.
    ReleasesBeforeDrained,
    /// L1: a context that has aborted does not rest before it tries again.
    NeverRests,
    /// L2: no context ever holds the priority.
    NobodyTakesPriority,
    /// L2: all teams share one priority, and all yield to the context that holds it.
    OnePriority,
    /// L3: other contexts retry while the context with the priority has waited for long.
    NobodyYields,
    /// L4: locks are released when the ring is complete, before its star is written.
    ReleasesBeforeWritten,
    /// L5: the root visit trusts what the walk found.
    TrustsTheWalk,
    /// L6: a walk ends at its goal while a commit or release of its context is due.
    OpensWhileBusy,
    /// L7: new ids count as written as soon as they are taken.
    ReadsTheUnwritten,
    /// L7: a record that is read while it is being written counts as valid.
    ReadsTheTorn,
    /// L8: all contexts take points from the start.
    AllFromTheStart,
    /// L8: the contexts of all teams take points as soon as one team is over its first round.
    TeamsStartTogether,
    /// L9: a lock does not name its holder, so a context's own locks count as foreign.
    TakesOwnForForeign,
    /// L10: a walk goes on until a record holds the point.
    WalksToTheEnd,
    /// L10: the edge across which a record was reached decides a tie.
    TiesByTheWayIn,
    /// L11: a first walk starts in the mesh of job 0, whatever the job of its context.
    StartsInAnyMesh,
    /// M2: the root visit of a deletion trusts that the record still names the vertex.
    TrustsTheWalkToAVertex,
    /// M3: the records outside a star are read without their locks.
    LeavesTheRingOpen,
    /// M8: a free record gets no mark and no link, and keeps the triangle that it was.
    LeavesFreeRecordsUnmarked,
    /// M12: a move writes the point alone without a look at the edges.
    MovesWithoutLook,
    /// M14: a point that is read or fetched while one is being written counts as valid.
    ReadsTheTornPoint,
}
