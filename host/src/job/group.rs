//! Jobs whose meshes are in the memory of a device at one time: their points, and which job a record belongs to.

use std::ops::Range;

use incircle_protocol::InsertReport;

use super::deal::repeated_place;
use super::prepare::Prepared;
use crate::error::DeviceFault;
use incircle_geometry::Point;

/// A job whose points are in the order of insertion.
pub(crate) struct Ordered {
    /// Index of the job in the list of the caller.
    pub(crate) job: usize,
    pub(crate) prepared: Prepared,
}

impl Ordered {
    /// Deals the points, which are in order for one context, to a team of this many.
    pub(crate) fn dealt(self, contexts: u32) -> Self {
        Self { prepared: self.prepared.dealt(contexts), ..self }
    }

    pub(crate) fn vertices(&self) -> usize {
        self.prepared.order.len()
    }
}

/// Jobs that the device does at one time: one job that has the whole memory, or several that share it.
pub(crate) struct Group {
    /// Jobs of the group, the longest first.
    pub(crate) jobs: Vec<Ordered>,
    /// Contexts that work on each job.
    pub(crate) contexts: u32,
    /// Whether the jobs share the memory. A group of one may be sent in this form too.
    pub(crate) is_shared: bool,
}

impl Group {
    /// A group of jobs that share the memory, the longest first, each with a team of `contexts` contexts, for which its
    /// points are dealt.
    pub(crate) fn sharing(jobs: Vec<Ordered>, contexts: u32) -> Self {
        Self { jobs, contexts, is_shared: true }
    }

    /// A group of one job, which has the whole memory and this many contexts.
    pub(crate) fn alone(job: Ordered, contexts: u32) -> Self {
        Self { jobs: vec![job], contexts, is_shared: false }
    }

    /// Index of the job in the list of the caller, if there is only one.
    pub(crate) fn only_job(&self) -> Option<usize> {
        match &self.jobs[..] {
            [ordered] => Some(ordered.job),
            _ => None,
        }
    }

    /// Number of records of all jobs together.
    pub(crate) fn records(&self) -> usize {
        self.jobs.iter().map(|ordered| 2 * ordered.vertices() - 2).sum()
    }

    /// Number of points that are sent, repeated ones included.
    pub(crate) fn sent(&self) -> usize {
        let (longest, last_round) = self.longest();
        // Each job takes as many places as the longest. Only the last round leaves out the jobs that are shorter.
        if longest > 3 {
            (longest - 1) * self.jobs.len() + last_round
        } else {
            3 * self.jobs.len()
        }
    }

    /// Number of vertices of the longest job, and number of jobs that are as long. They come first in the list.
    fn longest(&self) -> (usize, usize) {
        let longest = self.jobs.first().map_or(0, Ordered::vertices);
        (longest, self.jobs.iter().take_while(|ordered| ordered.vertices() == longest).count())
    }

    /// Calls `take` for a range of the points that are sent, in the order of sending: first three points of each job,
    /// then one point of each job in turn. A job that has no more points repeats one that the device finds at once
    /// ([`repeated_place`]), until the longest job is over. A job alone is sent in its own order.
    pub(crate) fn for_points(&self, jobs: &[Vec<Point>], range: Range<usize>, mut take: impl FnMut(Point)) {
        let at = |ordered: &Ordered, index: u32| jobs[ordered.job][index as usize];
        if let [only] = &self.jobs[..] {
            return only.prepared.order[range].iter().for_each(|&index| take(at(only, index)));
        }
        let first =
            self.jobs.iter().flat_map(|ordered| ordered.prepared.order[..3].iter().map(move |&index| (ordered, index)));
        let (longest, last_round) = self.longest();
        let rounds = (3..longest).flat_map(|place| {
            let takers = if place + 1 == longest { last_round } else { self.jobs.len() };
            self.jobs[..takers].iter().filter_map(move |ordered| {
                let order = &ordered.prepared.order;
                let repeated = || order.get(repeated_place(place, order.len(), self.contexts));
                order.get(place).or_else(repeated).map(|&index| (ordered, index))
            })
        });
        first.chain(rounds).skip(range.start).take(range.len()).for_each(|(ordered, index)| take(at(ordered, index)));
    }

    /// Checks the counts that the device reports after `sent` points: all must have arrived, and those that were
    /// repeated must count as duplicates. The points of jobs that share the memory are sent with one command, so all
    /// of them are due.
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

    /// The job that a record belongs to, as an index into `jobs`, and the vertices of the record, numbered within that
    /// job. Place `j` of the points sent is vertex `j` of the device, so the order of sending gives both.
    pub(crate) fn own_vertices(
        &self,
        record: usize,
        v: [u32; 3],
        sent: usize,
        infinite: u32,
    ) -> Result<(usize, [u32; 3]), DeviceFault> {
        let (count, mut found) = (self.jobs.len() as u32, None);
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
            if found.replace(job).is_some_and(|other| other != job) {
                return Err(DeviceFault::MixedJobs { record, vertices: v });
            }
        }
        match found {
            Some(job) => Ok((job as usize, own)),
            None => Err(DeviceFault::RepeatedVertex { record }),
        }
    }
}
