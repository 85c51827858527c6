//! `Watchdog` notices that no insertion ends any more, and the count of finished points tells whether any point is
//! left. The hardware has a block for each.

use super::wires::{Registers, Wires};
use incircle_protocol::{patience, Config};

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Watchdog {
    /// Whether a point was finished at the edge before, or there was nothing to do.
    rests: bool,
    /// Number of clocks since `rests` was last set.
    clocks: u32,
    /// Whether `clocks` has reached the patience.
    is_over: bool,
    /// A fault was found: the core refuses points until it is reset.
    pub stuck: bool,
}

impl Watchdog {
    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, config: Config) {
        let duplicate = was.outcome.is_some_and(|outcome| outcome.duplicate);
        let fills = wires.erased.is_some() || wires.fill_end.is_some();
        let finishes = fills || wires.committed.is_some() || wires.solo_ends || wires.seeds || duplicate;
        self.rests = finishes || wires.is_quiet;
        self.clocks = if was.watchdog.rests { 0 } else { self.clocks + 1 };
        self.is_over = was.watchdog.clocks == patience(config.points);
        self.stuck |= was.watchdog.is_over;
    }
}

/// The comparison of finished points with points that have come, as known two clocks ago: a finished point is counted
/// one clock later, and the counts are compared in the clock after that.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FinishedPoints {
    finished: u32,
    /// Whether some point is not finished.
    is_behind: bool,
}

impl FinishedPoints {
    /// Whether every point is finished, or never will be.
    pub(super) fn is_done(&self, was: &Registers) -> bool {
        !self.is_behind || was.seeder.has_no_start()
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires) {
        self.finished = if was.command.clears { 0 } else { was.contexts.finished };
        self.is_behind = match wires.has_changed {
            true => wires.is_pending,
            false => was.finished_points.finished != was.command.arrived,
        };
    }
}
