//! Notices that nothing is finished any more.

use super::wires::Wires;
use super::Registers;
use incircle_protocol::{patience, Config};

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Watchdog {
    /// Clocks since a point was finished, or since there was nothing to do.
    clocks: u32,
    /// A fault: points are refused until reset.
    pub stuck: bool,
}

impl Watchdog {
    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, config: Config) {
        let duplicate = wires.outcome.is_some_and(|outcome| outcome.duplicate);
        let finishes = wires.committed.is_some() || wires.solo_ends || wires.seeds || duplicate;
        self.clocks = if finishes || wires.is_quiet { 0 } else { self.clocks + 1 };
        self.stuck |= was.watchdog.clocks == patience(config.points);
    }
}
