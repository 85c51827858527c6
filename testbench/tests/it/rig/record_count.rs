//! The number of records, as the test of a commit keeps it.

use std::collections::VecDeque;

/// The count of records: `fresh` with those that are about to be written, `records` without them.
#[derive(Default)]
pub struct Count {
    pub fresh: u64,
    pub records: u64,
    /// Rings that have ended and do not count as written yet: the clocks left, and the number of records written then.
    ended: VecDeque<(u32, u64)>,
}

/// Events at an edge that change the number.
#[derive(Clone, Copy, Debug, Default)]
pub struct Event {
    pub takes: bool,
    pub ends: bool,
    pub solo_inserts: bool,
    pub seeds: bool,
    pub clears: bool,
    pub reset: bool,
}

impl Count {
    pub fn edge(&mut self, event: Event) {
        if event.ends {
            self.ended.push_back((3, self.fresh));
        }
        for (clocks, _) in &mut self.ended {
            *clocks -= 1;
        }
        if let Some((0, records)) = self.ended.front().copied() {
            self.records = records;
            self.ended.pop_front();
        }
        self.fresh += u64::from(event.takes);
        let all = match event {
            Event { reset: true, .. } => {
                self.ended.clear();
                Some(0)
            }
            Event { clears: true, .. } => Some(0),
            Event { seeds: true, .. } => Some(self.fresh + 4),
            Event { solo_inserts: true, .. } => Some(self.fresh + 2),
            _ => None,
        };
        if let Some(all) = all {
            (self.fresh, self.records) = (all, all);
        }
    }

    /// True if nothing is at work, and all records count as written.
    pub fn is_settled(&self) -> bool {
        self.ended.is_empty() && self.fresh == self.records
    }
}
