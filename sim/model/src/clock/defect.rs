//! Rules of the engine that can be left out, to show that each is needed and that tests notice.

/// A rule left out. See `docs/engine.md` for what each rule says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // the names say it
pub enum Defect {
    IgnoresForeignLocks,
    ReleasesBeforeDrained,
    NeverBacksOff,
    NobodyWaits,
    NobodyYields,
    ReleasesBeforeWritten,
    TrustsTheWalk,
    OpensWhileBusy,
    ReadsTheUnwritten,
    ReadsTheTorn,
    AllFromTheStart,
    TakesOwnForForeign,
}
