//! Which jobs go side by side, and which have the memory alone: whatever takes the device the fewest clocks.
//!
//! A context alone waits for its own visits most of the time, so jobs side by side cost little more than one, until the
//! read port of the triangle memory is busy ([`rounds`]). In a frame contexts share the work, but stand in each other's
//! way while the mesh is small ([`Plan::frame_with`]). Jobs side by side are held to the longest of them, and to the
//! capacity by it: so few large jobs fit, and few together are slower than a frame each. Both formulas are fitted to
//! the model by clock, uniform points, and hold within an eighth there (`plan/tests.rs`). For other sets and devices
//! they are a guess: the clocks depend on it, the meshes do not.

#[cfg(test)]
mod tests;

/// Hundredths of a clock in a clock: the unit of what follows.
const CLOCK: u64 = 100;
/// An insertion by a context that nobody is in the way of.
const ALONE: u64 = 155 * CLOCK;
/// What one more job side by side adds to a round while the read port has room: waiting for a visit of another.
const BESIDE: u64 = 230;
/// As many jobs side by side leave room on the read port; each job beyond adds so much more than the one before it, up
/// to the visits of an insertion, which no neighbour hides.
const ROOM: u64 = 8;
const CROWDED: u64 = 120;
const VISITS: u64 = 13 * CLOCK;
/// What a frame with several contexts takes longer because its mesh has no room for them at first: this often the
/// fourth root of its points, of [`GROWN`] at most, times that of the third power of its contexts.
const CROWD: u64 = 300;
const GROWN: u64 = 1024;
/// What the commands of a group or a frame take besides, with headers and pauses; and each first triangle.
const COMMANDS: u64 = 250 * CLOCK;
const FIRST_TRIANGLE: u64 = 42 * CLOCK;

/// A round of a group, a point of each job: with one job, with two, and so on.
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

/// What the last of so many jobs adds to a round.
fn one_more(jobs: u64) -> u64 {
    match jobs {
        1 => ALONE,
        _ => (BESIDE + CROWDED * jobs.saturating_sub(ROOM)).min(VISITS),
    }
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
pub(super) struct Plan {
    /// A round with one job side by side, up to as many as there are contexts that may work.
    rounds: Vec<u64>,
    /// Points that it holds.
    capacity: usize,
}

impl Plan {
    /// For a device with this capacity, of which so many contexts may work, one at least.
    pub(super) fn new(contexts: u32, capacity: u32) -> Self {
        Self { rounds: rounds(contexts.max(1)), capacity: capacity as usize }
    }

    /// As many jobs of this length as go side by side take no longer than one behind the other: for 8,192 points and 16
    /// contexts up to 1,170 points, of which 7 fit.
    pub(super) fn shares(&self, points: usize) -> bool {
        let most = self.rounds.len().min(self.capacity / points.max(1));
        let rounds = most.checked_sub(1).and_then(|place| self.rounds.get(place));
        let group = rounds.map(|round| COMMANDS + most as u64 * FIRST_TRIANGLE + points as u64 * round);
        group.is_some_and(|clocks| clocks <= most as u64 * self.frame(points).0)
    }

    /// How many contexts do a frame of so many points in the fewest clocks.
    pub(super) fn frame_contexts(&self, points: usize) -> u32 {
        self.frame(points).1
    }

    /// Cuts a list of jobs, given by their lengths, the longest first, into parts that follow each other: of all cuts
    /// that fit, one with the fewest clocks. Each length is 1 or more, and no more than the capacity. O(jobs *
    /// contexts).
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

    /// The groups that begin with the first of these jobs and fit, from one job on: how many jobs, and what they take
    /// but for the read-out.
    fn groups<'a>(&self, lengths: &'a [usize]) -> impl Iterator<Item = (usize, u64)> + use<'a> {
        let (capacity, longest) = (self.capacity, lengths.first().map_or(0, |&first| first));
        let (mut clocks, mut full) = (COMMANDS, 0);
        let steps = (1..).zip(&lengths[..lengths.len().min(self.rounds.len())]).map(move |(jobs, &points)| {
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
        let clocks = |contexts| (self.frame_with(points, contexts), contexts);
        (1..=self.rounds.len() as u32).map(clocks).min().unwrap_or((u64::MAX, 1))
    }

    /// What a frame with so many contexts takes but for the read-out: it shares out rounds, and waits for room.
    ///
    /// | points | 200 | 300 | 500 | 1,000 | 1,000 | 1,000 | 2,000 | 3,000 |
    /// |---|---|---|---|---|---|---|---|---|
    /// | contexts | 6 | 4 | 12 | 9 | 14 | 16 | 15 | 16 |
    /// | clocks a point counted | 53.8 | 51.3 | 33.9 | 28.5 | 26.7 | 28.1 | 20.9 | 19.2 |
    /// | by this formula | 49.4 | 52.2 | 34.3 | 28.2 | 27.2 | 28.0 | 21.2 | 19.1 |
    fn frame_with(&self, points: usize, contexts: u32) -> u64 {
        let (points, many) = (points as u64, u64::from(contexts));
        let round = self.rounds[contexts as usize - 1];
        // A hundred times the fourth root, so a hundred times the clocks.
        let root = (points.min(GROWN) * many.pow(3) * CLOCK.pow(4)).isqrt().isqrt();
        let crowd = if contexts == 1 { 0 } else { CROWD * root };
        points * round / many + crowd + FIRST_TRIANGLE + COMMANDS
    }
}
