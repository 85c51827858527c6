//! Rules of the engine that can be left out, to show that each is needed and that tests notice.

/// A rule left out, or a part of one. `docs/engine.md` says what each rule demands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Defect {
    /// L1: a test that finds another context's lock goes on.
    IgnoresForeignLocks,
    /// L1: a failed attempt releases its locks while visits of it are still out.
    ReleasesBeforeDrained,
    /// L1: a failed attempt does not rest before it tries again.
    NeverRests,
    /// L2: nobody ever holds the priority.
    NobodyTakesPriority,
    /// L3: others try again beside a holder that has waited for long.
    NobodyYields,
    /// L4: locks are released when the ring is finished, before its star is written.
    ReleasesBeforeWritten,
    /// L5: the visit of the root under its lock takes the walk's word.
    TrustsTheWalk,
    /// L6: a walk ends at its goal while a commit or release of its context is due.
    OpensWhileBusy,
    /// L7: new ids count as written as soon as they are taken.
    ReadsTheUnwritten,
    /// L7: a record that is being written counts.
    ReadsTheTorn,
    /// L8: all contexts take points from the start.
    AllFromTheStart,
    /// L9: a lock does not tell its holder: a context's own locks count as foreign.
    TakesOwnForForeign,
}
