//! How many clocks each item of a run takes. The hardware has no such count: it is for tables of cycles.

use std::collections::HashMap;

#[derive(Clone, Debug, Default)]
pub(super) struct Latencies {
    now: u64,
    /// The clock at which each item that is under way began, by its number in the run.
    begun: HashMap<u32, u64>,
    ended: Vec<u32>,
}

impl Latencies {
    /// Simulates one edge, at which a run may begin, an item may begin, and one may end.
    pub(super) fn clock(&mut self, run_begins: bool, begins: Option<u32>, ends: Option<u32>) {
        self.now += 1;
        if run_begins {
            self.begun.clear();
            self.ended.clear();
        }
        if let Some(number) = begins {
            self.begun.insert(number, self.now);
        }
        if let Some(since) = ends.and_then(|number| self.begun.remove(&number)) {
            self.ended.push(u32::try_from(self.now - since).unwrap_or(u32::MAX));
        }
    }

    /// The clocks from start to end of the items that have ended, in the order in which they ended.
    pub(super) fn ended(&self) -> &[u32] {
        &self.ended
    }
}
