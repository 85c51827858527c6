//! Reports on jobs that are done.

use std::time::Duration;

use super::counters::{Counters, Latencies};
use super::options::Stage;
use incircle_geometry::lattice::Lattice;

/// A report on a job: counts of the mesh, times, and facts about the device.
///
/// Reach for it to show or log how a job went. Counts of the mesh are always there. Times, counters and latencies are
/// there where the device has them, as each field says; a [batch](crate::Session::triangulate_batch) has fewer of them.
///
/// ```
/// use incircle::{Device, Stage};
///
/// let mut device = Device::open("clock?config=tiny")?;
/// let report = device.session()?.triangulate(&[(0, 0), (9, 0), (3, 5), (9, 9), (9, 0)])?.report;
/// assert_eq!((report.points, report.distinct, report.triangles, report.hull), (5, 4, 2, 4));
/// assert!(report.stage(Stage::Insert).is_some());
/// assert!(report.cycles_per_insertion().is_some_and(|cycles| cycles > 1.0));
/// # Ok::<(), incircle::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Report {
    /// Input points, duplicates included.
    pub points: usize,
    /// Distinct points among them.
    pub distinct: usize,
    /// Points that fell onto an earlier one: `points - distinct`.
    pub duplicates: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Points on the hull, those in the middle of a hull edge included.
    pub hull: usize,
    /// Whether there is no triangle, because there are fewer than three distinct points, or all lie on one line. The
    /// host answers such a job alone.
    pub collinear: bool,
    /// Name of the back end, such as `cpu` or `clock:full`.
    pub backend: String,
    /// Name of the insertion order.
    pub order: &'static str,
    /// Name and time of each stage, in the order in which they ran. Empty if the job shared the device with others, or
    /// was sent ahead of its turn.
    pub stages: Vec<(&'static str, Duration)>,
    /// Counters of the device; `None` if the host answered alone, or if the job shared the memory of the device. For a
    /// job of a batch that was sent ahead they are read before its mesh, so that [`Counters::read_cycles`] is 0.
    pub counters: Option<Counters>,
    /// Latencies of insertions; `None` where there is no clock, where there are no counters, and for a job of a batch
    /// that was sent ahead.
    pub latencies: Option<Latencies>,
    /// Clocks of the device for an exclusive job that was sent ahead: from the last word of the previous job, or the
    /// beginning of the batch, to the last triangle of this job. For a set in parts on one device, the clocks from the
    /// first word of the first part to the last triangle of the last. `None` for all other jobs, for an exclusive job
    /// on a device of several engines, and where the transport does not know the clocks.
    pub clocks: Option<u64>,
    /// The lattice of the points; `None` if they have none, and the CPU triangulator worked on their doubles or long
    /// integers.
    pub lattice: Option<Lattice>,
    /// Bits of a coordinate of the device.
    pub coord_bits: u32,
    /// Points that the device holds; on a chip of several engines, those of one engine.
    pub capacity: u32,
    /// Contexts that worked, or threads of the CPU triangulator.
    pub contexts: u32,
    /// Parts into which the set was cut, because the device cannot hold it or several devices share it; 0 if the device
    /// did it at once or the host answered alone. A small set of a fleet is one part.
    pub parts: usize,
    /// Engines of the device, which do one job each; 0 for the CPU triangulator.
    pub engines: u32,
    /// Engines that got stuck over this job before another engine did it. They get no more jobs until the device is
    /// reset.
    pub stuck_engines: Vec<u32>,
    /// The share of each device of a [`Fleet`](crate::Fleet), in the order of the fleet; empty for a single device.
    pub shares: Vec<Share>,
}

/// The share of one device of a [`Fleet`](crate::Fleet) in the work on a set.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Share {
    /// Name of the device.
    pub device: String,
    /// Parts of the set that the device did.
    pub parts: usize,
    /// Distinct points of these parts.
    pub points: usize,
    /// The error for which the device was left out; `None` if the device was there to the end. Parts that it had not
    /// finished were done by others.
    pub left_out: Option<String>,
}

impl Report {
    /// Time of a stage; `None` if the job did not come to it, or has no times.
    pub fn stage(&self, stage: Stage) -> Option<Duration> {
        let found = self.stages.iter().find(|(name, _)| *name == stage.name());
        found.map(|&(_, duration)| duration)
    }

    /// Clock cycles of the device per distinct point, from the first point accepted to the last lock released.
    ///
    /// The time in which the device waits for points is included ([`Counters::wait_cycles`] counts it), the read-out is
    /// not. `None` where there is no clock, and where the host answered alone.
    pub fn cycles_per_insertion(&self) -> Option<f64> {
        let cycles = self.counters?.insert_cycles;
        (cycles > 0 && self.distinct > 0).then(|| cycles as f64 / self.distinct as f64)
    }

    /// Clock cycles of the device per distinct point, with the read-out, where [`clocks`](Self::clocks) are known: for
    /// a set in parts, and for an exclusive job of a batch.
    pub fn clocks_per_point(&self) -> Option<f64> {
        self.clocks.filter(|_| self.distinct > 0).map(|clocks| clocks as f64 / self.distinct as f64)
    }

    /// Time of all stages together.
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
        // Cycles of waiting are part of `insert_cycles`; cycles of the read-out are not.
        assert_eq!(report.cycles_per_insertion(), Some(125.0));
    }
}
