//! What a job says about itself.

use std::time::Duration;

use super::counters::{Counters, Latencies};
use super::options::Stage;

/// What a job says about itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
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
    /// Time per stage, in the order in which they ran; none where a device did the job with others, or as one
    /// that was sent ahead.
    pub stages: Vec<(&'static str, Duration)>,
    /// The device's counters; `None` if the host answered alone, or the job shared the memory of the device with
    /// others. Of a job of a batch that had the whole memory they are read before its mesh is, so that
    /// [`Counters::read_cycles`] is 0.
    pub counters: Option<Counters>,
    /// How long insertions took; `None` where there is no clock, where there are no counters, and for a job of a batch
    /// that was sent ahead.
    pub latencies: Option<Latencies>,
    /// Clocks of the device for a job of a batch that had the whole memory: from the last word of the job before it, or
    /// the first of the batch, to its own last triangle. `None` elsewhere, and where the link does not know.
    pub clocks: Option<u64>,
    /// Bits of a coordinate of the device.
    pub coord_bits: u32,
    /// Points the device holds.
    pub capacity: u32,
    /// Contexts that worked: insertions in flight at once.
    pub contexts: u32,
}

impl Report {
    /// Time of a stage; `None` if the job did not come to it.
    pub fn stage(&self, stage: Stage) -> Option<Duration> {
        let found = self.stages.iter().find(|(name, _)| *name == stage.name());
        found.map(|&(_, duration)| duration)
    }

    /// Clock cycles per distinct point, from the first point accepted to the last lock released: waiting for points,
    /// which [`Counters::wait_cycles`] counts, lies within, reading out lies outside. `None` where there is no clock,
    /// or where the host answered alone.
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
