//! `Watchdog` notices that no point is finished any more; `FinishedPoints` counts down the points that are left.

use super::wires::{Registers, Wires};
use incircle_protocol::{patience, Config};

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Watchdog {
    /// A point was finished at the edge before, or there was nothing to do.
    rests: bool,
    /// Clocks since then.
    clocks: u32,
    /// They have become too many.
    is_over: bool,
    /// A fault: points are refused until reset.
    pub stuck: bool,
}

impl Watchdog {
    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, config: Config) {
        let duplicate = was.outcome.is_some_and(|outcome| outcome.duplicate);
        let finishes = wires.committed.is_some() || wires.solo_ends || wires.seeds || duplicate;
        self.rests = finishes || wires.is_quiet;
        self.clocks = if was.watchdog.rests { 0 } else { self.clocks + 1 };
        self.is_over = was.watchdog.clocks == patience(config.points);
        self.stuck |= was.watchdog.is_over;
    }
}

/// Whether every point is finished, as it was known two clocks ago: a point that is finished is counted a clock later, and the counts
/// are compared in the clock after that.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FinishedPoints {
    finished: u32,
    /// Some point is not finished.
    is_behind: bool,
}

impl FinishedPoints {
    /// Every point is finished, or never will be.
    pub(super) fn is_done(&self, was: &Registers) -> bool {
        !self.is_behind || was.seeder.has_no_start()
    }

    pub(super) fn clock(&mut self, was: &Registers) {
        self.finished = if was.command.clears { 0 } else { was.contexts.finished };
        self.is_behind = was.finished_points.finished != was.command.arrived;
    }
}
