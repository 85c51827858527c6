//! The lock log: every lock that the insertion set, and their release. After reset it clears the whole lock memory.

use super::context::Phase;
use super::memory::Memory;
use super::wires::Wires;
use super::Registers;
use incircle_protocol::{triangle_capacity, Config};

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Release {
    pub is_busy: bool,
    /// The lock memory is being cleared after reset.
    pub sweeps: bool,
    /// Log entry to be released, or lock to be cleared by the sweep.
    index: u32,
    /// Locks in the log.
    count: u32,
    /// The lock cleared in this clock.
    pub clear: Option<u32>,
}

impl Release {
    pub(super) fn reset(&mut self) {
        *self = Self { sweeps: true, ..Self::default() };
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, memory: &mut Memory, config: Config) {
        if let Some(id) = self.clear {
            memory.locks[id as usize] = false;
        }
        self.clear = None;
        let takes_locks = matches!(was.context.phase, Phase::Cavity | Phase::Drain);
        if let Some(done) = wires.done.filter(|done| takes_locks && done.token.locks && !done.was_set) {
            memory.lock_log[self.count as usize] = done.token.u;
            self.count += 1;
        }
        if self.sweeps {
            self.clear = Some(self.index);
            self.index += 1;
            if self.index == triangle_capacity(config.points) {
                self.sweeps = false;
                self.index = 0;
            }
        } else if self.is_busy {
            self.clear = Some(memory.lock_log[self.index as usize]);
            self.index += 1;
            if self.index == self.count {
                self.is_busy = false;
                self.index = 0;
                self.count = 0;
            }
        } else {
            self.is_busy = wires.commit_ends || wires.drained;
        }
    }
}
