//! Writes the triangles that fill holes, as they become known, and in the end the marks of the two free records.
//!
//! A triangle is written with the records outside as its neighbours across both sides. Where another triangle will
//! stand on a side, that one sets the link when it is written itself. Until then a walk that crosses the side comes to
//! a record nearby.
//!
//! Hardware twin: the block `HoleWriter`.

use super::hole::{Base, Hole};
use crate::clock::commit_job::CommitJob;
use crate::clock::memory::{Memory, Write};
use std::collections::VecDeque;

/// Number of clocks from one job to the next: the entries of the ring are read one after the other.
const CLOCKS: u32 = 3;
/// Number of clocks from the take of a job to its first write.
const LATENCY: usize = 5;

/// Number of jobs that wait at most.
const PLACES: usize = 32;

/// A triangle, or the end of a deletion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Job {
    context: usize,
    /// Beginning, apex and end of the interval.
    i: usize,
    m: usize,
    j: usize,
    base: Base,
    /// Whether the ring edge from `i` to `m` is a side of the triangle.
    mends: bool,
    /// The vertex and the number of locks of a deletion that ends.
    ends: Option<(u32, u32)>,
}

impl Job {
    /// The triangle with this apex on the base of the interval.
    pub(super) fn triangle(context: usize, hole: &Hole, apex: usize) -> Self {
        let mends = hole.next(hole.i) == apex;
        Self { context, i: hole.i, m: apex, j: hole.j, base: hole.base, mends, ends: None }
    }

    /// The end of the deletion of a vertex.
    pub(super) fn end(context: usize, hole: &Hole, vertex: u32) -> Self {
        let i = hole.next(hole.end);
        let m = hole.next(i);
        Self { context, i, m, j: hole.end, base: Base::Ring, mends: false, ends: Some((vertex, hole.locks)) }
    }
}

#[derive(Clone, Debug, Default)]
pub(super) struct Writer {
    queue: VecDeque<Job>,
    /// Number of clocks until the next job is taken.
    wait: u32,
    /// The job that was taken so many clocks ago.
    stages: [Option<Job>; LATENCY + 2],
    /// The links of the triangle that was written last.
    links: [Write; 2],
    pub write: Write,
}

impl Writer {
    pub(super) fn push(&mut self, job: Job) {
        self.queue.push_back(job);
    }

    /// The deletion whose last write is requested at this edge.
    pub(super) fn ends(&self) -> Option<CommitJob> {
        let job = self.stages[LATENCY].as_ref()?;
        let (vertex, locks) = job.ends?;
        Some(CommitJob { context: job.context, vertex, locks, ..CommitJob::default() })
    }

    /// The vertex of that deletion, and the ids of the two records that become free.
    pub(super) fn kept(&self, memory: &Memory) -> Option<(u32, [u32; 2])> {
        let job = self.stages[LATENCY].as_ref()?;
        let (vertex, _) = job.ends?;
        let at = |place: usize| memory.entries[job.context][place].cavity_record;
        Some((vertex, [at(job.i), at(job.j)]))
    }

    /// Whether a write will be requested in the next clock.
    pub(super) fn writes_next(&self) -> bool {
        let is_at = |clocks: usize| self.stages[clocks].is_some();
        is_at(LATENCY - 1) || is_at(LATENCY) || is_at(LATENCY + 1) && self.links[1].valid
    }

    /// Whether no job can be taken in.
    pub(super) fn is_full(&self) -> bool {
        self.queue.len() >= PLACES
    }

    /// Simulates one edge. A job that has come at the same edge may be taken.
    pub(super) fn clock(&mut self, memory: &mut Memory) {
        self.write.valid = false;
        if let Some(job) = self.stages[LATENCY - 1] {
            self.write_first(&job, memory);
        } else if self.stages[LATENCY].is_some() {
            self.write = self.links[0];
            if let Some((vertex, ids)) = self.kept(memory) {
                memory.keep(vertex, ids);
            }
        } else if self.stages[LATENCY + 1].is_some() {
            self.write = self.links[1];
        }
        self.stages.rotate_right(1);
        self.stages[0] = None;
        self.wait = self.wait.saturating_sub(1);
        if self.wait == 0 {
            self.stages[0] = self.queue.pop_front();
            self.wait = if self.stages[0].is_some() { CLOCKS } else { 0 };
        }
    }

    fn write_first(&mut self, job: &Job, memory: &Memory) {
        let entries = &memory.entries[job.context];
        let [i, m, j] = [job.i, job.m, job.j].map(|place| entries[place]);
        let id = m.cavity_record;
        if job.ends.is_some() {
            // M8: a walk that stands there must find its way on.
            let free = |record| Write::record(record, [memory.infinite; 3], [id; 3]);
            self.write = free(i.cavity_record);
            self.links = [free(j.cavity_record), Write::default()];
            return;
        }
        let (behind, base_link) = match job.base {
            Base::Ring => (j.outside_record, Write::link(j.outside_record, j.slot, id)),
            Base::End => (j.cavity_record, Write::link(j.cavity_record, 0, id)),
            Base::Beginning => (i.cavity_record, Write::link(i.cavity_record, 1, id)),
        };
        let v = [j.first_vertex, i.first_vertex, m.first_vertex];
        self.write = Write::record(id, v, [i.outside_record, m.outside_record, behind]);
        let mend = if job.mends { Write::link(i.outside_record, i.slot, id) } else { Write::default() };
        self.links = [base_link, mend];
    }
}
