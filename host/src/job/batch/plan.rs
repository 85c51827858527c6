//! The division of a batch into groups and exclusive jobs that is expected to take the device the fewest clocks.
//!
//! A single context waits for its own visits most of the time. Jobs side by side therefore cost little more than one
//! job, until the read port of the triangle memory is busy ([`rounds`]). In an exclusive job the contexts share the
//! work of one mesh, but are in each other's way while the mesh is small ([`Plan::exclusive_with`]). A group takes as
//! long as its longest job, and each of its jobs takes the memory of the longest. Only few large jobs fit side by side,
//! and few together are slower than one after another.
//!
//! Both formulas are fitted to the clocks that the model by clock counts for uniform points, and are within an eighth
//! of them (`plan/tests.rs`). For other sets and devices they are a guess. A wrong guess costs clocks; the meshes do
//! not depend on it.

#[cfg(test)]
mod tests;

/// Hundredths of a clock in a clock. The costs below are in hundredths of a clock, unless they say otherwise.
const CLOCK: u64 = 100;
/// Cost of an insertion by a context that meets no other context: 155 clocks counted.
const UNDISTURBED_INSERTION: u64 = 155 * CLOCK;
/// Cost that one more job adds to a round of a group while the read port has room: now and then one of its visits waits
/// for a visit of another job. Fitted to the table at [`rounds`], up to 8 jobs.
const EXTRA_JOB: u64 = 230;
/// Jobs of a group, as a count, up to which the read port has room.
const UNCROWDED_JOBS: u64 = 8;
/// Growth of the cost of one more job, for each job beyond [`UNCROWDED_JOBS`]. Fitted to the table at [`rounds`],
/// from 10 jobs on.
const EXTRA_JOB_GROWTH: u64 = 120;
/// Upper bound on the cost of one more job: the 13 visits of an insertion, a clock of the read port each,
/// once nothing hides them.
const MOST_EXTRA_JOB: u64 = 13 * CLOCK;
/// Factor of the contention in an exclusive job, in whole clocks. A small mesh has no room for many insertions at once,
/// which costs `CONTENTION * (min(points, CONTENTION_POINTS) * contexts^3)^(1/4)` clocks. Fitted to
/// the table at [`Plan::exclusive_with`].
const CONTENTION: u64 = 300;
/// Points of a mesh, as a count, from which on contention does not grow.
const CONTENTION_POINTS: u64 = 1024;
/// Cost of the commands of a group or an exclusive job, with headers and pauses.
const COMMANDS: u64 = 250 * CLOCK;
/// Cost of the first triangle of a job.
const FIRST_TRIANGLE: u64 = 42 * CLOCK;

/// Costs of a round of a group, in which each job inserts a point: with one job, with two, up to `most`.
///
/// | jobs | 1 | 2 | 4 | 6 | 8 | 10 | 12 | 14 | 16 | 20 | 24 |
/// |---|---|---|---|---|---|---|---|---|---|---|---|
/// | clocks counted, 500 points a job | 155 | 157 | 161 | 166 | 171 | 179 | 191 | 207 | 230 | 282 | 335 |
/// | by this formula | 155 | 157 | 162 | 166 | 171 | 179 | 192 | 210 | 233 | 285 | 337 |
fn rounds(most: u32) -> Vec<u64> {
    let sums = (1..=u64::from(most)).scan(0, |clocks, jobs| {
        *clocks += one_more(jobs);
        Some(*clocks)
    });
    sums.collect()
}

/// Cost that the last of `jobs` jobs adds to a round.
fn one_more(jobs: u64) -> u64 {
    match jobs {
        1 => UNDISTURBED_INSERTION,
        _ => (EXTRA_JOB + EXTRA_JOB_GROWTH * jobs.saturating_sub(UNCROWDED_JOBS)).min(MOST_EXTRA_JOB),
    }
}

/// A part of a batch that has the memory of the device at one time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// A group of this many jobs, side by side.
    Group(usize),
    /// One job that has the memory to itself.
    Exclusive,
}

impl Part {
    fn jobs(self) -> usize {
        match self {
            Self::Group(jobs) => jobs,
            Self::Exclusive => 1,
        }
    }
}

/// Divides batches for a device.
pub(super) struct Plan {
    /// Costs of a round with one job, with two, up to the number of contexts that may work.
    rounds: Vec<u64>,
    /// Points that the device holds.
    capacity: usize,
}

impl Plan {
    /// A plan for a device of this capacity on which this many contexts may work; 0 counts as 1.
    pub(super) fn new(contexts: u32, capacity: u32) -> Self {
        Self { rounds: rounds(contexts.max(1)), capacity: capacity as usize }
    }

    /// Whether jobs of this many points may share the memory: as many of them as fit side by side take no longer than
    /// one after another. On a device of 8,192 points and 16 contexts that is so up to 1,170 points, of which 7 fit.
    pub(super) fn shares(&self, points: usize) -> bool {
        let most = self.rounds.len().min(self.capacity / points.max(1));
        let rounds = most.checked_sub(1).and_then(|place| self.rounds.get(place));
        let group = rounds.map(|round| COMMANDS + most as u64 * FIRST_TRIANGLE + points as u64 * round);
        group.is_some_and(|clocks| clocks <= most as u64 * self.exclusive(points).0)
    }

    /// Number of contexts with which an exclusive job of this many points takes the fewest clocks.
    pub(super) fn exclusive_contexts(&self, points: usize) -> u32 {
        self.exclusive(points).1
    }

    /// Cuts a list of jobs into parts that the device does one after another. `lengths` are the distinct points of the
    /// jobs, the longest first, each from 1 to the capacity. Of all cuts whose parts fit, the result has the fewest
    /// clocks. O(jobs * contexts).
    pub(super) fn divide(&self, lengths: &[usize]) -> Vec<Part> {
        // Dynamic programming from the last job to the first. For each job: the lowest cost of this job and all after
        // it, and the part with which that division begins.
        let mut best = vec![(0, Part::Exclusive); lengths.len() + 1];
        // Jobs of one length follow each other, so the cost of the last length is worth keeping.
        let mut kept = (0, 0);
        for (first, &points) in lengths.iter().enumerate().rev() {
            if kept.0 != points {
                kept = (points, self.exclusive(points).0);
            }
            let exclusive = (kept.1 + best[first + 1].0, Part::Exclusive);
            let groups = self.groups(&lengths[first..]);
            let groups = groups.map(|(jobs, clocks)| (clocks + best[first + jobs].0, Part::Group(jobs)));
            // Of equal costs the larger group wins.
            best[first] = groups.fold(exclusive, |best, next| if next.0 <= best.0 { next } else { best });
        }
        let first_parts = std::iter::successors(Some(0), |&first| Some(first + best[first].1.jobs()));
        first_parts.take_while(|&first| first < lengths.len()).map(|first| best[first].1).collect()
    }

    /// The groups that fit and begin with the first of these jobs: the number of jobs, from 1 on, and the
    /// cost without the read-out.
    fn groups<'a>(&self, lengths: &'a [usize]) -> impl Iterator<Item = (usize, u64)> + use<'a> {
        let (capacity, longest) = (self.capacity, lengths.first().map_or(0, |&first| first));
        let (mut clocks, mut full) = (COMMANDS, 0);
        let steps = (1..).zip(&lengths[..lengths.len().min(self.rounds.len())]).map(move |(jobs, &points)| {
            // A job that is over repeats its last point, which is found at once and costs next to nothing.
            clocks += points as u64 * one_more(jobs as u64) + FIRST_TRIANGLE;
            full += usize::from(points == longest);
            // Each job takes as many places as the longest. Only the last round leaves out the jobs that are shorter.
            (jobs, clocks, jobs * longest.saturating_sub(1) + full)
        });
        steps.take_while(move |&(_, _, sent)| sent <= capacity).map(|(jobs, clocks, _)| (jobs, clocks))
    }

    /// Lowest cost of an exclusive job without the read-out, and the number of contexts that gives it.
    fn exclusive(&self, points: usize) -> (u64, u32) {
        let clocks = |contexts| (self.exclusive_with(points, contexts), contexts);
        (1..=self.rounds.len() as u32).map(clocks).min().unwrap_or((u64::MAX, 1))
    }

    /// Cost of an exclusive job with this many contexts, without the read-out: the contexts share the rounds, and wait
    /// for room in the mesh.
    ///
    /// | points | 200 | 300 | 500 | 1,000 | 1,000 | 1,000 | 2,000 | 3,000 |
    /// |---|---|---|---|---|---|---|---|---|
    /// | contexts | 6 | 4 | 12 | 9 | 14 | 16 | 15 | 16 |
    /// | clocks a point counted | 53.8 | 51.3 | 33.9 | 28.5 | 26.7 | 28.1 | 20.9 | 19.2 |
    /// | by this formula | 49.4 | 52.2 | 34.3 | 28.2 | 27.2 | 28.0 | 21.2 | 19.1 |
    fn exclusive_with(&self, points: usize, contexts: u32) -> u64 {
        let (points, many) = (points as u64, u64::from(contexts));
        let round = self.rounds[contexts as usize - 1];
        // The fourth power of CLOCK below the root makes the result a cost, in hundredths of a clock.
        let root = (points.min(CONTENTION_POINTS) * many.pow(3) * CLOCK.pow(4)).isqrt().isqrt();
        let contention = if contexts == 1 { 0 } else { CONTENTION * root };
        points * round / many + contention + FIRST_TRIANGLE + COMMANDS
    }
}
