//! Which jobs go side by side, and which have the memory alone: whatever takes the device the fewest clocks.
//!
//! A context alone waits for its own visits most of the time, so jobs side by side cost little more than one, until the read port of the
//! triangle memory is busy ([`round`]). In a frame contexts share the work, but stand in each other's way while the mesh is small
//! ([`Plan::frame`]). Jobs side by side are held to the longest of them, and to the capacity by it: so few large jobs fit, and few
//! together are slower than a frame each. Both formulas are fitted to the model by clock, uniform points, and hold within an eighth
//! there (`plan/tests.rs`). For other sets and devices they are a guess: the clocks depend on it, the meshes do not.

#[cfg(test)]
mod tests;

/// Hundredths of a clock in a clock: the unit of what follows.
const CLOCK: u64 = 100;
/// An insertion by a context that nobody is in the way of.
const ALONE: u64 = 155 * CLOCK;
/// What one more job side by side adds to a round while the read port has room: waiting for a visit of another.
const BESIDE: u64 = 230;
/// As many jobs side by side leave room on the read port; each job beyond adds so much more than the one before it, up to the visits of
/// an insertion, which no neighbour hides.
const ROOM: u64 = 8;
const CROWDED: u64 = 120;
const VISITS: u64 = 13 * CLOCK;
/// What the commands of a group or a frame take besides, its headers and pauses; and each first triangle of a group.
const COMMANDS: u64 = 250 * CLOCK;
const FIRST_TRIANGLE: u64 = 42 * CLOCK;
/// Points from which on a mesh has room for all contexts.
const GROWN: u64 = 1024;

/// A round of a group: a point of each of so many jobs.
///
/// | jobs | 1 | 2 | 4 | 6 | 8 | 10 | 12 | 14 | 16 | 20 | 24 |
/// |---|---|---|---|---|---|---|---|---|---|---|---|
/// | clocks counted, 500 points a job | 155 | 157 | 161 | 166 | 171 | 179 | 191 | 207 | 230 | 282 | 335 |
/// | clocks by this formula | 155 | 157 | 162 | 166 | 171 | 179 | 191 | 208 | 232 | 284 | 336 |
fn round(jobs: u64) -> u64 {
    (2..=jobs).fold(ALONE, |clocks, job| clocks + one_more(job))
}

/// What the last of so many jobs adds to a round.
fn one_more(jobs: u64) -> u64 {
    match jobs {
        1 => ALONE,
        _ => (BESIDE + CROWDED * jobs.saturating_sub(ROOM)).min(VISITS),
    }
}

/// A frame with so many contexts, but for the read-out: rounds as in a group, and what it takes until the mesh has room for the contexts.
/// That was found to grow with the fourth root of the points and to end at [`GROWN`].
///
/// | points | 200 | 500 | 1000 | 1000 | 1000 | 2000 | 3000 |
/// |---|---|---|---|---|---|---|---|
/// | contexts | 6 | 12 | 9 | 14 | 16 | 15 | 16 |
/// | clocks a point counted | 53.8 | 33.9 | 28.5 | 26.7 | 28.1 | 20.9 | 19.2 |
fn frame(points: usize, contexts: u32) -> u64 {
    let (points, many) = (points as u64, u64::from(contexts));
    // A hundred times the fourth root.
    let root = (points.min(GROWN) * 100_000_000).isqrt().isqrt();
    let crowd = if contexts == 1 { 0 } else { (500 + 120 * many) * root };
    points * round(many) / many + crowd + FIRST_TRIANGLE + COMMANDS
}

/// What the device does in one go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// So many jobs side by side.
    Group(usize),
    /// One job alone.
    Frame,
}

impl Part {
    fn jobs(self) -> usize {
        match self {
            Self::Group(jobs) => jobs,
            Self::Frame => 1,
        }
    }
}

/// How jobs are divided on a device.
#[derive(Clone, Copy)]
pub(super) struct Plan {
    /// Contexts that may work: at most so many jobs are side by side.
    contexts: u32,
    /// Points that it holds.
    capacity: usize,
}

impl Plan {
    /// For a device with this capacity, of which so many contexts may work, one at least.
    pub(super) fn new(contexts: u32, capacity: u32) -> Self {
        Self { contexts: contexts.max(1), capacity: capacity as usize }
    }

    /// As many jobs of this length as go side by side take no longer than one behind the other: for 8,192 points and 16 contexts up to 1,170
    /// points, of which 7 fit.
    pub(super) fn shares(&self, points: usize) -> bool {
        let all = vec![points; self.contexts as usize];
        let most = self.groups(&all).last();
        most.is_some_and(|(jobs, clocks)| clocks <= jobs as u64 * self.frame(points).0)
    }

    /// How many contexts do a frame of so many points in the fewest clocks.
    pub(super) fn frame_contexts(&self, points: usize) -> u32 {
        self.frame(points).1
    }

    /// Cuts a list of jobs, given by their lengths, the longest first, into parts that follow each other: of all cuts that fit, one with the
    /// fewest clocks. Each length is 1 or more, and no more than the capacity. O(jobs * contexts).
    pub(super) fn divide(&self, lengths: &[usize]) -> Vec<Part> {
        // For each job the fewest clocks from it to the last, and the part that it begins then.
        let mut best = vec![(0, Part::Frame); lengths.len() + 1];
        let mut frame = (0, 0);
        for (first, &points) in lengths.iter().enumerate().rev() {
            if frame.0 != points {
                frame = (points, self.frame(points).0);
            }
            let alone = (frame.1 + best[first + 1].0, Part::Frame);
            let groups = self.groups(&lengths[first..]);
            let groups = groups.map(|(jobs, clocks)| (clocks + best[first + jobs].0, Part::Group(jobs)));
            // Of equals the larger group.
            best[first] = groups.fold(alone, |best, next| if next.0 <= best.0 { next } else { best });
        }
        let first_parts = std::iter::successors(Some(0), |&first| Some(first + best[first].1.jobs()));
        first_parts.take_while(|&first| first < lengths.len()).map(|first| best[first].1).collect()
    }

    /// The groups that begin with the first of these jobs and fit, from one job on: how many jobs, and what they take but for the read-out.
    fn groups<'a>(&self, lengths: &'a [usize]) -> impl Iterator<Item = (usize, u64)> + use<'a> {
        let (capacity, longest) = (self.capacity, lengths.first().map_or(0, |&first| first));
        let (mut clocks, mut full) = (COMMANDS, 0);
        let steps = (1..).zip(&lengths[..lengths.len().min(self.contexts as usize)]).map(move |(jobs, &points)| {
            // A job that is over has repeated points, which are found at once.
            clocks += points as u64 * one_more(jobs as u64) + FIRST_TRIANGLE;
            full += usize::from(points == longest);
            // Each job has as many places as the longest, but for the last round.
            (jobs, clocks, jobs * longest.saturating_sub(1) + full)
        });
        steps.take_while(move |&(_, _, sent)| sent <= capacity).map(|(jobs, clocks, _)| (jobs, clocks))
    }

    /// What a frame takes but for the read-out, and with how many contexts.
    fn frame(&self, points: usize) -> (u64, u32) {
        (1..=self.contexts).map(|contexts| (frame(points, contexts), contexts)).min().unwrap_or((u64::MAX, 1))
    }
}
