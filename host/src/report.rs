//! What a job says about itself.

use std::time::Duration;

use incircle_protocol::{Counter, COUNTER_WORDS};

use crate::options::Stage;

/// The device's event counters after a job. Cycle counts are 0 where there is no clock (the software model).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Clock cycles from the first point accepted to the last lock released.
    pub insert_cycles: u64,
    /// Those of them in which the engine waited for a point.
    pub wait_cycles: u64,
    /// Clock cycles of reading records out.
    pub read_cycles: u64,
    /// Points inserted.
    pub insertions: u32,
    /// Points that fell onto an earlier one; 0, as the host removes them first.
    pub duplicates: u32,
    /// Points refused; 0 after a job that ended well.
    pub refused: u32,
    /// Triangles visited by walks, the located ones included.
    pub walk_visits: u32,
    /// Conflict tests.
    pub tests: u32,
    /// Triangles removed by cavities.
    pub cavity_triangles: u32,
    /// Insertions whose boundary list overflowed.
    pub overflows: u32,
    /// Flips of those insertions.
    pub flips: u32,
}

impl Counters {
    /// From the words of the answer to `Counters`.
    pub fn from_words(words: &[u32; COUNTER_WORDS]) -> Self {
        let narrow = |counter: Counter| words[counter as usize];
        let wide = |counter: Counter| {
            let low = counter as usize;
            u64::from(words[low]) | u64::from(words[low + 1]) << 32
        };
        Self {
            insert_cycles: wide(Counter::InsertCycles),
            wait_cycles: wide(Counter::WaitCycles),
            read_cycles: wide(Counter::ReadCycles),
            insertions: narrow(Counter::Insertions),
            duplicates: narrow(Counter::Duplicates),
            refused: narrow(Counter::Refused),
            walk_visits: narrow(Counter::WalkVisits),
            tests: narrow(Counter::Tests),
            cavity_triangles: narrow(Counter::CavityTriangles),
            overflows: narrow(Counter::Overflows),
            flips: narrow(Counter::Flips),
        }
    }
}

/// What a job says about itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Input points.
    pub points: usize,
    /// Distinct ones.
    pub distinct: usize,
    /// Points that fell onto an earlier one: `points - distinct`.
    pub duplicates: usize,
    /// Triangles.
    pub triangles: usize,
    /// Points on the hull, those in the middle of a hull edge included.
    pub hull: usize,
    /// There is no triangle: fewer than three distinct points, or all on one line. The host answered alone.
    pub collinear: bool,
    /// Name of the device.
    pub backend: String,
    /// Name of the insertion order.
    pub order: &'static str,
    /// Time per stage, in the order in which they ran.
    pub stages: Vec<(&'static str, Duration)>,
    /// The device's counters; `None` if the host answered alone.
    pub counters: Option<Counters>,
    /// Bits of a coordinate of the device.
    pub coord_bits: u32,
    /// Points the device holds.
    pub capacity: u32,
}

impl Report {
    /// Time of a stage; `None` if the job did not come to it.
    pub fn stage(&self, stage: Stage) -> Option<Duration> {
        let found = self.stages.iter().find(|(name, _)| *name == stage.name());
        found.map(|&(_, duration)| duration)
    }

    /// Clock cycles per distinct point, from the first point accepted to the last lock released: waiting for points, which
    /// [`Counters::wait_cycles`] counts, lies within, reading out lies outside. `None` where there is no clock, or where
    /// the host answered alone.
    pub fn cycles_per_insertion(&self) -> Option<f64> {
        let cycles = self.counters?.insert_cycles;
        (cycles > 0 && self.distinct > 0).then(|| cycles as f64 / self.distinct as f64)
    }

    /// Time of all stages.
    pub fn total(&self) -> Duration {
        self.stages.iter().map(|&(_, duration)| duration).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counters_come_from_their_words() {
        let mut words = [0; COUNTER_WORDS];
        for (index, word) in words.iter_mut().enumerate() {
            *word = index as u32 + 1;
        }
        let counters = Counters::from_words(&words);
        assert_eq!(counters.insert_cycles, 1 | 2 << 32);
        assert_eq!(counters.read_cycles, 5 | 6 << 32);
        assert_eq!(counters.insertions, 7);
        assert_eq!(counters.flips, 14);
    }

    #[test]
    fn cycles_per_insertion_needs_a_clock() {
        let mut report = Report { distinct: 4, ..Report::default() };
        assert_eq!(report.cycles_per_insertion(), None);
        let mut counters = Counters::default();
        report.counters = Some(counters);
        assert_eq!(report.cycles_per_insertion(), None);
        counters.insert_cycles = 500;
        counters.wait_cycles = 100;
        counters.read_cycles = 70;
        report.counters = Some(counters);
        // Waiting lies within the span, reading out does not.
        assert_eq!(report.cycles_per_insertion(), Some(125.0));
    }
}
