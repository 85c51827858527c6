//! Jobs that are in the memory of a device at once: their points, and whose a record is.

use std::ops::Range;

use incircle_protocol::InsertReport;

use super::prepare::Prepared;
use crate::error::DeviceFault;
use incircle_geometry::Point;

/// A job in the order of insertion.
pub(crate) struct Ordered {
    /// Its place in the list of the caller.
    pub(crate) job: usize,
    pub(crate) prepared: Prepared,
}

impl Ordered {
    pub(crate) fn vertices(&self) -> usize {
        self.prepared.order.len()
    }
}

/// Jobs that go to the device in one go: one that has the whole memory, or several that share it, the longest first.
pub(crate) struct Group {
    pub(crate) jobs: Vec<Ordered>,
    /// Contexts that work on each of them: one where they share the memory.
    pub(crate) contexts: u32,
    /// The jobs share the memory; one alone may do so too.
    pub(crate) is_shared: bool,
}

impl Group {
    /// Jobs that share the memory, the longest first, each with a context of its own.
    pub(crate) fn sharing(jobs: Vec<Ordered>) -> Self {
        Self { jobs, contexts: 1, is_shared: true }
    }

    /// A job that has the whole memory and so many contexts.
    pub(crate) fn alone(job: Ordered, contexts: u32) -> Self {
        Self { jobs: vec![job], contexts, is_shared: false }
    }

    /// Where there is only one job: its place in the list of the caller.
    pub(crate) fn only_job(&self) -> Option<usize> {
        match &self.jobs[..] {
            [ordered] => Some(ordered.job),
            _ => None,
        }
    }

    /// Records of all jobs.
    pub(crate) fn records(&self) -> usize {
        self.jobs.iter().map(|ordered| 2 * ordered.vertices() - 2).sum()
    }

    /// Points that are sent, repeated ones included.
    pub(crate) fn sent(&self) -> usize {
        let (longest, last_round) = self.longest();
        // Each job has as many places as the longest, but for the last round.
        if longest > 3 {
            (longest - 1) * self.jobs.len() + last_round
        } else {
            3 * self.jobs.len()
        }
    }

    /// Vertices of the longest job, and how many jobs have as many: the first ones, since they stand in the order of
    /// their lengths.
    fn longest(&self) -> (usize, usize) {
        let longest = self.jobs.first().map_or(0, Ordered::vertices);
        (longest, self.jobs.iter().take_while(|ordered| ordered.vertices() == longest).count())
    }

    /// Hands on a stretch of the points that are sent, in their order: three of each job, then one of each in turn. A
    /// job that has no more repeats its last one, which is found at once, until the longest is over. For a job alone
    /// that is its own order.
    pub(crate) fn for_points(&self, jobs: &[Vec<Point>], stretch: Range<usize>, mut take: impl FnMut(Point)) {
        let at = |ordered: &Ordered, index: u32| jobs[ordered.job][index as usize];
        if let [only] = &self.jobs[..] {
            return only.prepared.order[stretch].iter().for_each(|&index| take(at(only, index)));
        }
        let first =
            self.jobs.iter().flat_map(|ordered| ordered.prepared.order[..3].iter().map(move |&index| (ordered, index)));
        let (longest, last_round) = self.longest();
        let rounds = (3..longest).flat_map(|place| {
            let takers = if place + 1 == longest { last_round } else { self.jobs.len() };
            self.jobs[..takers].iter().filter_map(move |ordered| {
                let order = &ordered.prepared.order;
                order.get(place).or(order.last()).map(|&index| (ordered, index))
            })
        });
        first
            .chain(rounds)
            .skip(stretch.start)
            .take(stretch.len())
            .for_each(|(ordered, index)| take(at(ordered, index)));
    }

    /// After so many points all of them must be in, and those that were repeated are duplicates. The points of jobs
    /// that share the memory are sent at once.
    pub(crate) fn check_report(&self, report: &InsertReport, sent: usize) -> Result<(), DeviceFault> {
        let (vertices, records) = match &self.jobs[..] {
            [_] => (sent, 2 * sent - 2),
            jobs => (jobs.iter().map(Ordered::vertices).sum(), self.records()),
        };
        let counts = [
            ("points arrived", report.arrived, sent),
            ("points inserted", report.inserted, vertices),
            ("duplicates", report.duplicates, sent - vertices),
            ("points refused", report.refused, 0),
            ("records", report.records, records),
        ];
        match counts.into_iter().find(|&(_, found, expected)| found as usize != expected) {
            Some((what, found, expected)) => Err(DeviceFault::Count { what, found, expected: expected as u32 }),
            None => Ok(()),
        }
    }

    /// The job that a record belongs to, and its vertices as that job counts them.
    pub(crate) fn own_vertices(
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
