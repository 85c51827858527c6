//! Jobs that are in the memory of a device at once: their points, and whose a record is.

use incircle_protocol::InsertReport;

use crate::fault::DeviceFault;
use crate::prepare::Prepared;
use incircle_geometry::Point;

/// A job in the order of insertion.
pub(super) struct Ordered {
    /// Its place in the list of the caller.
    pub(super) job: usize,
    pub(super) prepared: Prepared,
}

impl Ordered {
    pub(super) fn vertices(&self) -> usize {
        self.prepared.order.len()
    }
}

/// Jobs that go to the device in one go: those that share its memory, the longest first, or a frame.
pub(super) struct Group {
    pub(super) jobs: Vec<Ordered>,
    /// Contexts that work on each of them: one, or more for a frame.
    pub(super) contexts: u32,
    /// It is one job that has the whole memory.
    pub(super) is_frame: bool,
}

impl Group {
    /// Jobs that share the memory, the longest first, each with a context of its own.
    pub(super) fn sharing(jobs: Vec<Ordered>) -> Self {
        Self { jobs, contexts: 1, is_frame: false }
    }

    /// A job that has the whole memory and so many contexts.
    pub(super) fn frame(job: Ordered, contexts: u32) -> Self {
        Self { jobs: vec![job], contexts, is_frame: true }
    }

    /// Where there is only one job: its place in the list of the caller.
    pub(super) fn only_job(&self) -> Option<usize> {
        match &self.jobs[..] {
            [ordered] => Some(ordered.job),
            _ => None,
        }
    }

    /// Records of all jobs.
    pub(super) fn records(&self) -> usize {
        self.jobs.iter().map(|ordered| 2 * ordered.vertices() - 2).sum()
    }

    /// The points in the order in which they are sent: three of each job, then one of each in turn. A job that has no more repeats its last
    /// one, which is found at once, until the longest is over. For a frame that is its own order.
    pub(super) fn points(&self, jobs: &[Vec<Point>]) -> Vec<Point> {
        let at = |ordered: &Ordered, index: u32| jobs[ordered.job][index as usize];
        let first = self
            .jobs
            .iter()
            .flat_map(|ordered| ordered.prepared.order[..3].iter().map(move |&index| at(ordered, index)));
        let mut points: Vec<Point> = first.collect();
        let longest = self.jobs.iter().map(Ordered::vertices).max().unwrap_or(0);
        // The jobs stand in the order of their lengths, so the last round ends with the last of the longest.
        let last_round = self.jobs.iter().take_while(|ordered| ordered.vertices() == longest).count();
        for place in 3..longest {
            let takers = if place + 1 == longest { last_round } else { self.jobs.len() };
            points.extend(self.jobs[..takers].iter().filter_map(|ordered| {
                let order = &ordered.prepared.order;
                order.get(place).or(order.last()).map(|&index| at(ordered, index))
            }));
        }
        points
    }

    /// All points must be in, and those that were repeated are duplicates.
    pub(super) fn check_report(&self, report: &InsertReport, sent: usize) -> Result<(), DeviceFault> {
        let vertices: usize = self.jobs.iter().map(Ordered::vertices).sum();
        let counts = [
            ("points arrived", report.arrived, sent),
            ("points inserted", report.inserted, vertices),
            ("duplicates", report.duplicates, sent - vertices),
            ("points refused", report.refused, 0),
            ("records", report.records, self.records()),
        ];
        match counts.into_iter().find(|&(_, found, expected)| found as usize != expected) {
            Some((what, found, expected)) => Err(DeviceFault::Count { what, found, expected: expected as u32 }),
            None => Ok(()),
        }
    }

    /// The job that a record belongs to, and its vertices as that job counts them.
    pub(super) fn own_vertices(
        &self,
        record: usize,
        v: [u32; 3],
        sent: usize,
        infinite: u32,
    ) -> Result<(usize, [u32; 3]), DeviceFault> {
        let (count, mut owner) = (self.jobs.len() as u32, None);
        let mut own = v;
        for (vertex, own) in v.into_iter().zip(&mut own).filter(|(vertex, _)| *vertex != infinite) {
            if vertex as usize >= sent {
                return Err(DeviceFault::VertexOutOfRange { record, vertex, points: sent });
            }
            let (job, place) = match vertex.checked_sub(3 * count) {
                None => (vertex / 3, vertex % 3),
                Some(dealt) => (dealt % count, 3 + dealt / count),
            };
            *own = place;
            if owner.replace(job).is_some_and(|other| other != job) {
                return Err(DeviceFault::MixedJobs { record, vertices: v });
            }
        }
        match owner {
            Some(job) => Ok((job as usize, own)),
            None => Err(DeviceFault::RepeatedVertex { record }),
        }
    }
}
