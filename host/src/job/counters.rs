//! Counters of a device: its events, and how long its insertions took.

use incircle_protocol::{latency_of_bucket, Counter, COUNTER_WORDS, LATENCY_BUCKETS};

/// The event counters of a device after a job.
///
/// Look here to learn why a job was slow: long walks (`walk_visits`), contention between contexts (`aborts`,
/// `root_retries`, `revisits`), or a host that does not send points fast enough (`wait_cycles`). All counts are for one
/// job. Where there is no clock, as in the software model, cycle counts are 0, and so are counts of what contexts
/// do to each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counters {
    /// Clock cycles from the first point accepted to the last lock released.
    pub insert_cycles: u64,
    /// Clock cycles, among `insert_cycles`, in which the insertion engine waited for a point.
    pub wait_cycles: u64,
    /// Clock cycles of the read-out.
    pub read_cycles: u64,
    /// Number of points inserted.
    pub insertions: u32,
    /// Points that fell onto an earlier one; 0, since the host removes them first.
    pub duplicates: u32,
    /// Points refused; 0 after a job that ended well.
    pub refused: u32,
    /// Triangles visited by walks, the roots included.
    pub walk_visits: u32,
    /// Tests of records behind the boundary of a cavity for a conflict.
    pub tests: u32,
    /// Triangles removed by cavities.
    pub cavity_triangles: u32,
    /// Insertions whose boundary was longer than its list, and which became solo insertions.
    pub overflows: u32,
    /// Flips of solo insertions.
    pub flips: u32,
    /// Visits that lock the root of a cavity and evaluate it again.
    pub root_visits: u32,
    /// Visits made once more because a record was being written, a lock was held, or the context's own commit was not
    /// finished.
    pub revisits: u32,
    /// Attempts aborted because another context held a lock.
    pub aborts: u32,
    /// Roots that no longer conflicted with the point when they were locked.
    pub root_retries: u32,
    /// Times a context took the priority.
    pub priorities_taken: u32,
    /// Clock cycles in which a visit was issued, so that the read port of the triangle memory was busy.
    pub issue_cycles: u32,
    /// Clock cycles in which a record or a neighbour's id was written, so that the write port was busy.
    pub write_cycles: u32,
    /// Clock cycles in which a commit was at work.
    pub commit_cycles: u32,
    /// Clock cycles in which a lock was released.
    pub release_cycles: u32,
    /// Fewest clock cycles of an insertion, as [`Latencies`] defines them.
    pub latency_min: u32,
    /// Most clock cycles of an insertion, as [`Latencies`] defines them.
    pub latency_max: u32,
}

impl Counters {
    /// Decodes the payload of the answer to the command `Counters`.
    pub fn from_words(words: &[u32; COUNTER_WORDS]) -> Self {
        let narrow = |counter: Counter| words[counter as usize];
        let wide = |counter: Counter| {
            let low = counter as usize;
            u64::from(words[low]) | u64::from(words[low + 1]) << 32
        };
        Self {
            insert_cycles: wide(Counter::InsertCycles),
            wait_cycles: wide(Counter::WaitCycles),
            read_cycles: wide(Counter::ReadCycles),
            insertions: narrow(Counter::Insertions),
            duplicates: narrow(Counter::Duplicates),
            refused: narrow(Counter::Refused),
            walk_visits: narrow(Counter::WalkVisits),
            tests: narrow(Counter::Tests),
            cavity_triangles: narrow(Counter::CavityTriangles),
            overflows: narrow(Counter::Overflows),
            flips: narrow(Counter::Flips),
            root_visits: narrow(Counter::RootVisits),
            revisits: narrow(Counter::Revisits),
            aborts: narrow(Counter::Aborts),
            root_retries: narrow(Counter::RootRetries),
            priorities_taken: narrow(Counter::PrioritiesTaken),
            issue_cycles: narrow(Counter::IssueCycles),
            write_cycles: narrow(Counter::WriteCycles),
            commit_cycles: narrow(Counter::CommitCycles),
            release_cycles: narrow(Counter::ReleaseCycles),
            latency_min: narrow(Counter::LatencyMin),
            latency_max: narrow(Counter::LatencyMax),
        }
    }

    /// Every counter with its name, in the order of the protocol, as for a table.
    pub fn named(&self) -> [(&'static str, u64); 22] {
        [
            ("insert_cycles", self.insert_cycles),
            ("wait_cycles", self.wait_cycles),
            ("read_cycles", self.read_cycles),
            ("insertions", self.insertions.into()),
            ("duplicates", self.duplicates.into()),
            ("refused", self.refused.into()),
            ("walk_visits", self.walk_visits.into()),
            ("tests", self.tests.into()),
            ("cavity_triangles", self.cavity_triangles.into()),
            ("overflows", self.overflows.into()),
            ("flips", self.flips.into()),
            ("root_visits", self.root_visits.into()),
            ("revisits", self.revisits.into()),
            ("aborts", self.aborts.into()),
            ("root_retries", self.root_retries.into()),
            ("priorities_taken", self.priorities_taken.into()),
            ("issue_cycles", self.issue_cycles.into()),
            ("write_cycles", self.write_cycles.into()),
            ("commit_cycles", self.commit_cycles.into()),
            ("release_cycles", self.release_cycles.into()),
            ("latency_min", self.latency_min.into()),
            ("latency_max", self.latency_max.into()),
        ]
    }
}

/// Latencies of insertions, in clock cycles: each from the clock in which a context takes the point to the clock in
/// which its last record is written.
///
/// The first three points and solo insertions are left out.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Latencies {
    /// Insertions that were timed.
    pub insertions: u64,
    /// Fewest cycles of an insertion; exact.
    pub min: u32,
    /// Upper bound on the median: half of the insertions took no more cycles than this. The median itself is at
    /// most an eighth less.
    pub median: u32,
    /// Upper bound on the 99th percentile: 99 of 100 insertions took no more cycles than this. The percentile itself is
    /// at most an eighth less.
    pub p99: u32,
    /// Most cycles of an insertion; exact.
    pub max: u32,
    /// Histogram behind `median` and `p99`: for each bucket that is not empty, its fewest cycles and its insertions.
    /// There are eight buckets to an octave; the first one is for 0 to 17 cycles, and the last one has no upper end.
    pub histogram: Vec<[u32; 2]>,
}

impl Latencies {
    /// Latencies from the answers of a device; `None` if it timed nothing, as the software model, which has no clock.
    pub(crate) fn of(counters: &Counters, buckets: &[u32; LATENCY_BUCKETS]) -> Option<Self> {
        let insertions: u64 = buckets.iter().copied().map(u64::from).sum();
        let (min, max) = (counters.latency_min, counters.latency_max);
        // A bucket knows its range only. Its upper end errs on the safe side, within the extremes, which are exact.
        let percentile = |percent: u64| {
            let mut sum = 0;
            let reached = buckets.iter().position(|&count| {
                sum += u64::from(count);
                100 * sum >= percent * insertions
            });
            let end = reached.filter(|bucket| bucket + 1 < LATENCY_BUCKETS);
            end.map_or(max, |bucket| latency_of_bucket(bucket + 1) - 1).min(max).max(min)
        };
        let start = |bucket: usize| if bucket == 0 { 0 } else { latency_of_bucket(bucket) };
        let filled = buckets.iter().enumerate().filter(|(_, &count)| count > 0);
        (insertions > 0).then(|| Self {
            insertions,
            min,
            median: percentile(50),
            p99: percentile(99),
            max,
            histogram: filled.map(|(bucket, &count)| [start(bucket), count]).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_protocol::latency_bucket;

    #[test]
    fn counters_come_from_their_words() {
        let mut words = [0; COUNTER_WORDS];
        for (index, word) in words.iter_mut().enumerate() {
            *word = index as u32 + 1;
        }
        let counters = Counters::from_words(&words);
        assert_eq!(counters.insert_cycles, 1 | 2 << 32);
        assert_eq!(counters.read_cycles, 5 | 6 << 32);
        assert_eq!(counters.insertions, 7);
        assert_eq!(counters.flips, 14);
        assert_eq!(counters.latency_max, 25);
    }

    #[test]
    fn every_counter_has_its_name_once() {
        let mut words = [0; COUNTER_WORDS];
        for (index, word) in words.iter_mut().enumerate() {
            *word = index as u32;
        }
        let named = Counters::from_words(&words).named();
        // Each word holds its own number, so the low word of a counter says which word it was read from.
        let low = named.map(|(_, value)| value as u32);
        assert_eq!(low.to_vec(), [0, 2, 4].into_iter().chain(6..25).collect::<Vec<u32>>());
        // `Debug` is derived, so it shows the real names of the fields.
        let shown = format!("{:?}", Counters::from_words(&words));
        for (name, value) in named {
            assert!(shown.contains(&format!(" {name}: {value}")), "{name}: {shown}");
        }
    }

    #[test]
    fn latencies_come_from_buckets() {
        let mut counters = Counters { latency_min: 90, latency_max: 1000, ..Counters::default() };
        let of = |counters: &Counters, samples: &[u32]| {
            let mut buckets = [0; LATENCY_BUCKETS];
            samples.iter().for_each(|&clocks| buckets[latency_bucket(clocks)] += 1);
            Latencies::of(counters, &buckets)
        };
        assert_eq!(of(&counters, &[]), None);
        let found = of(&counters, &[90, 100, 130, 131, 1000]).expect("five samples");
        assert_eq!((found.insertions, found.min, found.max), (5, 90, 1000));
        // The bucket of 130 ends at 143, that of 1000 at 1023.
        assert_eq!((found.median, found.p99), (143, 1000));
        assert_eq!(found.histogram, [[88, 1], [96, 1], [128, 2], [960, 1]]);
        let mut samples = vec![100; 99];
        samples.push(1000);
        let found = of(&counters, &samples).expect("a hundred samples");
        assert_eq!((found.median, found.p99), (103, 103));
        counters.latency_max = 95;
        assert_eq!(of(&counters, &samples).expect("a hundred samples").median, 95);
        // The first and the last bucket.
        counters = Counters { latency_min: 3, latency_max: 4_000_000, ..Counters::default() };
        let found = of(&counters, &[3, 4_000_000]).expect("two samples");
        assert_eq!((found.median, found.p99), (17, 4_000_000));
        assert_eq!(found.histogram, [[0, 1], [latency_of_bucket(LATENCY_BUCKETS - 1), 1]]);
        // A hostile device may claim a minimum above the maximum, and full buckets.
        counters = Counters { latency_min: u32::MAX, latency_max: 0, ..Counters::default() };
        assert!(Latencies::of(&counters, &[u32::MAX; LATENCY_BUCKETS]).is_some());
    }

    #[test]
    fn percentiles_are_at_most_an_eighth_too_long() {
        for clocks in (18..900_000).step_by(7) {
            let mut buckets = [0; LATENCY_BUCKETS];
            buckets[latency_bucket(clocks)] = 1;
            let counters = Counters { latency_max: u32::MAX, ..Counters::default() };
            let median = Latencies::of(&counters, &buckets).expect("a sample").median;
            assert!(median >= clocks && 8 * (median - clocks) <= clocks, "{clocks} is told as {median}");
        }
    }
}
