//! The division of a batch into groups and exclusive jobs that is expected to take the device the fewest clocks.
//!
//! A single context waits for its own visits most of the time. More contexts therefore cost little more than one, until
//! the read port of the triangle memory is busy ([`rounds`]). The contexts that work on one mesh share its points, but
//! are in each other's way while the mesh is small ([`contention`]). So small jobs share the memory with a context
//! each, larger ones with a team of contexts each, and an exclusive job has all contexts that make it faster. A group
//! takes as long as its longest job, and each of its jobs takes the memory of the longest.
//!
//! The formulas are fitted to the clocks that the model by clock counts for uniform points, and are within an eighth
//! of them (`plan/tests.rs`). For other sets and devices they are a guess. A wrong guess costs clocks; the meshes do
//! not depend on it.

#[cfg(test)]
mod tests;

/// Hundredths of a clock in a clock. The costs below are in hundredths of a clock, unless they say otherwise.
const CLOCK: u64 = 100;
/// Cost of an insertion by a context that meets no other context: 136 clocks counted.
const UNDISTURBED_INSERTION: u64 = 136 * CLOCK;
/// Cost that one more context adds to a round while the read port has room: now and then one of its visits waits for a
/// visit of another context. Fitted to the table at [`rounds`], up to 8 contexts.
const EXTRA_CONTEXT: u64 = 190;
/// Contexts, as a count, up to which the read port has room.
const UNCROWDED_CONTEXTS: u64 = 8;
/// Growth of the cost of one more context, for each one beyond [`UNCROWDED_CONTEXTS`]. Fitted to the table at
/// [`rounds`], from 10 contexts on.
const EXTRA_CONTEXT_GROWTH: u64 = 105;
/// Upper bound on the cost of one more context: the 12 visits of an insertion, a clock of the read port each,
/// once nothing hides them.
const MOST_EXTRA_CONTEXT: u64 = 12 * CLOCK;
/// Factor of the contention in a mesh, in whole clocks; see [`contention`].
const CONTENTION: u64 = 340;
/// Contention in the mesh of a team, beside that in an exclusive job, in hundredths: a context that waits, waits longer
/// while other teams keep the read port busy. Fitted to the table at [`Plan::group_with`].
const TEAM_CONTENTION: u64 = 115;
/// Points of a mesh, as a count, from which on contention does not grow.
const CONTENTION_POINTS: u64 = 1024;
/// Cost of the commands of a group or an exclusive job, with headers and pauses.
const COMMANDS: u64 = 250 * CLOCK;
/// Cost of the first triangle of a job.
const FIRST_TRIANGLE: u64 = 42 * CLOCK;

/// Costs of a round of a group, in which each context inserts a point: with one context, with two, up to `most`.
///
/// | contexts | 1 | 2 | 4 | 6 | 8 | 10 | 12 | 14 | 16 | 20 | 24 |
/// |---|---|---|---|---|---|---|---|---|---|---|---|
/// | clocks counted, a job of 500 points for each | 136 | 139 | 143 | 146 | 151 | 157 | 167 | 184 | 204 | 252 | 300 |
/// | by this formula | 136 | 138 | 142 | 146 | 149 | 156 | 167 | 183 | 202 | 250 | 298 |
fn rounds(most: u32) -> Vec<u64> {
    let sums = (1..=u64::from(most)).scan(0, |clocks, contexts| {
        *clocks += one_more(contexts);
        Some(*clocks)
    });
    sums.collect()
}

/// Cost that the last of `contexts` contexts adds to a round.
fn one_more(contexts: u64) -> u64 {
    match contexts {
        1 => UNDISTURBED_INSERTION,
        _ => {
            (EXTRA_CONTEXT + EXTRA_CONTEXT_GROWTH * contexts.saturating_sub(UNCROWDED_CONTEXTS)).min(MOST_EXTRA_CONTEXT)
        }
    }
}

/// Cost of the contention in a mesh of `points` points: a small mesh has no room for many insertions at once, which
/// costs `CONTENTION * (min(points, CONTENTION_POINTS) * contexts^3)^(1/4)` clocks. Fitted to the table at
/// [`Plan::exclusive_with`].
fn contention(points: usize, contexts: u32) -> u64 {
    // The fourth power of CLOCK below the root makes the result a cost, in hundredths of a clock.
    let root = (points as u64).min(CONTENTION_POINTS) * u64::from(contexts).pow(3) * CLOCK.pow(4);
    if contexts == 1 {
        0
    } else {
        CONTENTION * root.isqrt().isqrt()
    }
}

/// A part of a batch that has the memory of the device at one time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// A group of `jobs` jobs, side by side, with a team of `contexts` contexts for each.
    Group { jobs: usize, contexts: u32 },
    /// One job that has the memory to itself.
    Exclusive,
}

impl Part {
    fn jobs(self) -> usize {
        match self {
            Self::Group { jobs, .. } => jobs,
            Self::Exclusive => 1,
        }
    }
}

/// Divides batches for a device.
pub(super) struct Plan {
    /// Costs of a round with one context, with two, up to the number of contexts that may work.
    rounds: Vec<u64>,
    /// Most contexts of a job in a group; 1 for a device without teams.
    most_of_team: u32,
    /// Points that the device holds.
    capacity: usize,
    /// The most points that jobs which share the memory have together.
    most_shared: usize,
    /// Number of devices of this kind that work side by side: the engines of a chip.
    engines: usize,
}

impl Plan {
    /// A plan for a device of this capacity on which this many contexts may work; 0 counts as 1. A device without teams
    /// gives each job of a group one context.
    pub(super) fn new(contexts: u32, capacity: u32, has_teams: bool) -> Self {
        let contexts = contexts.max(1);
        let most_of_team = if has_teams { contexts } else { 1 };
        let capacity = capacity as usize;
        Self { rounds: rounds(contexts), most_of_team, capacity, most_shared: capacity, engines: 1 }
    }

    /// The same plan with at most `points` points in jobs that share the memory: those whose mesh the device can keep
    /// for the line.
    pub(super) fn sharing_at_most(self, points: usize) -> Self {
        Self { most_shared: self.most_shared.min(points), ..self }
    }

    /// The same plan for this many engines that work side by side; 0 counts as 1. A group then has at most the share of
    /// an engine of all jobs, so that a small batch leaves no engine idle.
    pub(super) fn on_engines(self, engines: usize) -> Self {
        Self { engines: engines.max(1), ..self }
    }

    /// Whether jobs of this many points may share the memory: with some size of teams, as many such jobs as fit side by
    /// side take no longer than the same jobs one after another. On a device of 8,192 points and 16 contexts that is so
    /// up to 4,096 points, of which 2 fit; without teams up to 1,224 points, of which 6 fit.
    pub(super) fn shares(&self, points: usize) -> bool {
        let exclusive = self.exclusive(points).0;
        (1..=self.most_of_team).any(|contexts| {
            let most = self.most_jobs(contexts).min(self.most_shared / points.max(1));
            most >= least_jobs(contexts) && self.group_with(&vec![points; most], contexts) <= most as u64 * exclusive
        })
    }

    /// The most points of a part of a set that has `share` points for each engine. A share above the capacity counts as
    /// the capacity.
    ///
    /// Large parts cost the host little, because few of their points lie at a seam. So a part is as large as the share,
    /// unless halves of that size save more than a tenth of the clocks: two jobs side by side have room for more
    /// insertions at once. Quarters save less than they cost the host.
    pub(super) fn part_size(&self, share: usize) -> usize {
        let share = share.min(self.capacity);
        let half = share.div_ceil(2);
        let clocks = self.two_jobs(half).min(2 * self.exclusive(half).0);
        if half >= LEAST_PART && 10 * clocks < 9 * self.exclusive(share).0 {
            half
        } else {
            share
        }
    }

    /// Lowest cost of a group of two jobs of this many points.
    fn two_jobs(&self, points: usize) -> u64 {
        let teams = (1..=self.most_of_team).filter(|&contexts| self.most_jobs(contexts) >= 2);
        teams.map(|contexts| self.group_with(&[points; 2], contexts)).min().unwrap_or(u64::MAX)
    }

    /// Largest number of jobs with a team of this many contexts each.
    fn most_jobs(&self, contexts: u32) -> usize {
        self.rounds.len() / contexts as usize
    }

    /// Number of contexts with which an exclusive job of this many points takes the fewest clocks.
    pub(super) fn exclusive_contexts(&self, points: usize) -> u32 {
        self.exclusive(points).1
    }

    /// Cuts a list of jobs into parts that an engine does one after another. `lengths` are the distinct points of the
    /// jobs, the longest first, each from 1 to the capacity. Of all cuts whose parts fit, and whose groups have at most
    /// an engine's share of the jobs, the result has the fewest clocks. O(jobs * contexts * log contexts).
    pub(super) fn divide(&self, lengths: &[usize]) -> Vec<Part> {
        // Dynamic programming from the last job to the first. For each job: the lowest cost of this job and all after
        // it, and the part with which that division begins.
        let mut best = vec![(0, Part::Exclusive); lengths.len() + 1];
        // Jobs of one length follow each other, so the cost of the last length is worth keeping.
        let mut kept = (0, 0);
        let share = lengths.len().div_ceil(self.engines);
        for (first, &points) in lengths.iter().enumerate().rev() {
            if kept.0 != points {
                kept = (points, self.exclusive(points).0);
            }
            let exclusive = (kept.1 + best[first + 1].0, Part::Exclusive);
            let groups = (1..=self.most_of_team).flat_map(|contexts| {
                let groups = self.groups(&lengths[first..], contexts).take_while(move |&(jobs, _)| jobs <= share);
                groups.map(move |(jobs, clocks)| (jobs, clocks, Part::Group { jobs, contexts }))
            });
            let groups = groups.map(|(jobs, clocks, part)| (clocks + best[first + jobs].0, part));
            // Of equal costs the larger group wins.
            best[first] = groups.fold(exclusive, |best, next| if next.0 <= best.0 { next } else { best });
        }
        let first_parts = std::iter::successors(Some(0), |&first| Some(first + best[first].1.jobs()));
        first_parts.take_while(|&first| first < lengths.len()).map(|first| best[first].1).collect()
    }

    /// The groups with teams of this size that fit and begin with the first of these jobs: the number of jobs, and the
    /// cost without the read-out.
    fn groups<'a>(&'a self, lengths: &'a [usize], contexts: u32) -> impl Iterator<Item = (usize, u64)> + use<'a> {
        let (most_shared, longest) = (self.most_shared, lengths.first().map_or(0, |&first| first));
        let mut full = 0;
        let mut clocks = COMMANDS + contention(longest, contexts) * TEAM_CONTENTION / 100;
        let most = lengths.len().min(self.most_jobs(contexts));
        let steps = (1..).zip(&lengths[..most]).map(move |(jobs, &points)| {
            clocks += self.one_more_job(points, jobs, contexts);
            full += usize::from(points == longest);
            // Each job takes as many places as the longest. Only the last round leaves out the jobs that are shorter.
            (jobs, clocks, jobs * longest.saturating_sub(1) + full)
        });
        let fitting = steps.take_while(move |&(_, _, sent)| sent <= most_shared);
        fitting.filter(move |&(jobs, ..)| jobs >= least_jobs(contexts)).map(|(jobs, clocks, _)| (jobs, clocks))
    }

    /// Cost that the last of `jobs` jobs adds to a group with teams of this size. Its contexts share its points, so
    /// they add to the cost of `points / contexts` rounds. A job that is over repeats points, which are found at once
    /// and cost next to nothing.
    fn one_more_job(&self, points: usize, jobs: usize, contexts: u32) -> u64 {
        let last = jobs * contexts as usize;
        let before = (last - contexts as usize).checked_sub(1).map_or(0, |place| self.rounds[place]);
        points as u64 * (self.rounds[last - 1] - before) / u64::from(contexts) + FIRST_TRIANGLE
    }

    /// Cost of a group of jobs of these lengths, the longest first, without the read-out.
    ///
    /// | points of a job | 200 | 200 | 200 | 1,000 | 1,000 | 1,000 | 2,000 | 4,000 |
    /// |---|---|---|---|---|---|---|---|---|
    /// | jobs, contexts of each | 8, 2 | 5, 3 | 4, 4 | 8, 2 | 5, 3 | 4, 4 | 4, 4 | 2, 8 |
    /// | clocks a point counted | 14.2 | 17.6 | 19.0 | 13.3 | 14.6 | 14.7 | 13.8 | 14.4 |
    /// | by this formula | 14.6 | 16.6 | 18.4 | 13.2 | 13.9 | 14.3 | 13.5 | 14.0 |
    fn group_with(&self, lengths: &[usize], contexts: u32) -> u64 {
        let longest = lengths.first().map_or(0, |&first| first);
        let steps = (1..).zip(lengths).map(|(jobs, &points)| self.one_more_job(points, jobs, contexts));
        COMMANDS + contention(longest, contexts) * TEAM_CONTENTION / 100 + steps.sum::<u64>()
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
    /// | clocks a point counted | 56.6 | 49.4 | 35.7 | 27.9 | 28.2 | 28.1 | 20.3 | 18.2 |
    /// | by this formula | 50.2 | 49.7 | 35.3 | 27.1 | 27.2 | 28.2 | 20.3 | 17.9 |
    fn exclusive_with(&self, points: usize, contexts: u32) -> u64 {
        let round = self.rounds[contexts as usize - 1];
        points as u64 * round / u64::from(contexts) + contention(points, contexts) + FIRST_TRIANGLE + COMMANDS
    }
}

/// Fewest points of a part of a set. About a third of the points of a part of this size lie at seams.
const LEAST_PART: usize = 256;

/// Smallest number of jobs of a group with teams of this size. One job with several contexts is an exclusive job.
fn least_jobs(contexts: u32) -> usize {
    if contexts == 1 {
        1
    } else {
        2
    }
}
