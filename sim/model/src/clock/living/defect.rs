//! Rules of the living engine that a model can leave out, to show what each prevents.

/// A rule that is left out. `docs/living-mesh.md` describes the rules by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LivingDefect {
    /// M1: a walk begins an attempt while the locks of the last one are still due.
    OpensWhileBusy,
    /// M2: the visit under the lock of the root does not look whether the root is still right.
    TrustsTheWalk,
    /// M3: the records outside the ring of a star are neither locked nor looked at.
    LeavesTheRingOpen,
    /// M4: an attempt goes on where it meets a lock of another context.
    IgnoresForeignLocks,
    /// M4: locks are released while visits of the attempt are in flight.
    ReleasesBeforeDrained,
    /// M5: no context ever holds the priority.
    NobodyTakesPriority,
    /// M6: locks are released when the writes begin.
    ReleasesBeforeWritten,
    /// M7: a lock does not name its holder, so a context's own locks count as foreign.
    TakesOwnForForeign,
    /// M8: free records are not marked.
    LeavesNoMark,
    /// M9: a walk does not visit a record again that it read in the clock of its write, or before its first write.
    ReadsTheUnwritten,
    /// M10: of equal distances the lower number is the nearer, and not the smaller point.
    NearestByNumber,
    /// M11: a change is answered before it is written, and the next run begins.
    AnswersBeforeWritten,
    /// M12: a move whose edges change writes the point alone.
    MovesWithoutLook,
    /// M13: an insertion whose list is full begins while other contexts work.
    SoloBesideOthers,
}

impl LivingDefect {
    /// All rules that can be left out.
    pub const ALL: [Self; 14] = [
        Self::OpensWhileBusy,
        Self::TrustsTheWalk,
        Self::LeavesTheRingOpen,
        Self::IgnoresForeignLocks,
        Self::ReleasesBeforeDrained,
        Self::NobodyTakesPriority,
        Self::ReleasesBeforeWritten,
        Self::TakesOwnForForeign,
        Self::LeavesNoMark,
        Self::ReadsTheUnwritten,
        Self::NearestByNumber,
        Self::AnswersBeforeWritten,
        Self::MovesWithoutLook,
        Self::SoloBesideOthers,
    ];
}
