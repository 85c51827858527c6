//! The event counters: Rust, Verilog and a table of 64-bit sums agree clock by clock.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{Counters, LatencyRange, WideCounter};
use incircle_protocol::{Counter, COUNTER_WORDS, LATENCY_BITS};

named_ports!(
    Counters,
    [
        reset,
        clears,
        inserting,
        waiting,
        reading,
        is_issuing,
        is_writing,
        is_committing,
        is_releasing,
        walk_visit,
        root_visit,
        test,
        solo_test,
        revisit,
        gives_up,
        retries,
        takes_token,
        overflows,
        flip,
        cavity_ends,
        cavity_triangles,
        seeds,
        commit_ends,
        since,
        solo_inserts,
        duplicate,
        solo_duplicate,
        refused,
        select
    ],
    [value, insertions, duplicates, now, latency_comes, latency],
    clock
);
named_ports!(LatencyRange, [zero, commit_ends, now, since], [latency_comes, latency, least, most], clock);
named_ports!(WideCounter<4>, [zero, count], [low, high], clock);

/// Events that add one to one counter.
const EVENTS: [(&str, Counter); 19] = [
    ("inserting", Counter::InsertCycles),
    ("waiting", Counter::WaitCycles),
    ("reading", Counter::ReadCycles),
    ("is_issuing", Counter::IssueCycles),
    ("is_writing", Counter::WriteCycles),
    ("is_committing", Counter::CommitCycles),
    ("walk_visit", Counter::WalkVisits),
    ("root_visit", Counter::RootVisits),
    ("revisit", Counter::Revisits),
    ("gives_up", Counter::Aborts),
    ("retries", Counter::RootRetries),
    ("takes_token", Counter::WaitingTokens),
    ("overflows", Counter::Overflows),
    ("flip", Counter::Flips),
    // Of two ports that add to one counter, the later one is low where the earlier is high.
    ("test", Counter::Tests),
    ("solo_test", Counter::Tests),
    ("duplicate", Counter::Duplicates),
    ("solo_duplicate", Counter::Duplicates),
    ("is_releasing", Counter::ReleaseCycles),
];

/// The clock count and the range of latencies.
#[derive(Clone, Copy, Default)]
struct LatencyReference {
    now: u64,
    /// The latency of the last edge's commit.
    came: Option<u64>,
    /// The one before, which has been compared.
    compared: Option<u64>,
    /// Least and most of those before.
    range: Option<(u64, u64)>,
}

impl LatencyReference {
    fn edge(&mut self, since: Option<u64>, forgets: bool) {
        if let Some(latency) = self.compared {
            let (least, most) = self.range.unwrap_or((latency, latency));
            self.range = Some((least.min(latency), most.max(latency)));
        }
        let turn = 1 << LATENCY_BITS;
        self.compared = self.came;
        self.came = since.map(|since| (self.now + turn - since) % turn);
        self.now = (self.now + 1) % turn;
        if forgets {
            (self.came, self.compared, self.range) = (None, None, None);
        }
    }
}

struct Rig {
    block: Stepper<Counters>,
    random: SplitMix64,
    sums: [u64; COUNTER_WORDS],
    /// The sums of a clock ago: what is counted.
    counted: [u64; COUNTER_WORDS],
    /// The words that were selected in the last clock and in the one before.
    chosen: [u64; 2],
    latencies: LatencyReference,
    commit_ends: bool,
    /// Clocks until the next commit may end.
    pause: u64,
}

impl Rig {
    /// Random events; what they add to each counter.
    fn set_events(&mut self) -> [u64; COUNTER_WORDS] {
        let mut added = [0; COUNTER_WORDS];
        let mut inserting = false;
        for (port, counter) in EVENTS {
            let happens = added[counter as usize] == 0 && self.random.below(2) == 1;
            self.block.set(port, happens);
            inserting |= port == "inserting" && happens;
            // The sweep after reset does not count.
            added[counter as usize] += u64::from(happens && (port != "is_releasing" || inserting));
        }
        // At most one kind of insertion ends in a clock, and commits end some clocks apart.
        let ends = match self.random.below(8) {
            1 if self.pause > 0 => 3,
            ends => ends,
        };
        self.pause = if ends == 1 { 2 + self.random.below(3) } else { self.pause.saturating_sub(1) };
        for (kind, port, points) in [(0, "seeds", 3), (1, "commit_ends", 1), (2, "solo_inserts", 1)] {
            self.block.set(port, ends == kind);
            if ends == kind {
                added[Counter::Insertions as usize] = points;
            }
        }
        self.commit_ends = ends == 1;
        let triangles = [0, 1, 126, self.random.below(127)][self.random.below(4) as usize];
        let cavity_ends = self.random.below(4) == 0;
        self.block.set("cavity_ends", cavity_ends);
        self.block.set("cavity_triangles", triangles);
        added[Counter::CavityTriangles as usize] = if cavity_ends { triangles } else { 0 };
        added
    }

    /// When the point was taken whose commit ends, if one does.
    fn set_since(&mut self) -> Option<u64> {
        let turn = 1 << LATENCY_BITS;
        let ago = 1 + [self.random.below(100), self.random.below(turn - 1)][self.random.below(2) as usize];
        let since = (self.latencies.now + turn - ago) % turn;
        self.block.set("since", since);
        self.commit_ends.then_some(since)
    }

    fn expect(&mut self) {
        let refused = [0, 0xffff_ffff, self.random.below(1 << 32)][self.random.below(3) as usize];
        self.counted[Counter::Refused as usize] = refused;
        let (least, most) = self.latencies.range.unwrap_or_default();
        self.counted[Counter::LatencyMin as usize] = least;
        self.counted[Counter::LatencyMax as usize] = most;
        self.block.set("refused", refused);
        let select = self.random.below(COUNTER_WORDS as u64);
        self.block.set("select", select);
        self.block.settle();
        if self.block.clocks() > 0 {
            self.block.expect("now", self.latencies.now);
        }
        // A clear takes two clocks.
        if self.block.clocks() > 1 {
            self.block.expect("insertions", self.counted[Counter::Insertions as usize]);
            self.block.expect("duplicates", self.counted[Counter::Duplicates as usize]);
            self.block.expect("latency_comes", self.latencies.came.is_some());
        }
        if self.block.clocks() > 3 {
            self.block.expect("value", self.chosen[1]);
        }
        self.chosen = [self.counted[select as usize], self.chosen[0]];
        if let Some(latency) = self.latencies.came {
            self.block.expect("latency", latency);
        }
    }
}

#[test]
fn counters_count_their_events() {
    let block = Stepper::new("counters", Counters::default(), 1);
    let latencies = LatencyReference::default();
    let sums = [0; COUNTER_WORDS];
    let random = SplitMix64::new(3);
    let mut rig = Rig { block, random, sums, counted: sums, chosen: [0; 2], latencies, commit_ends: false, pause: 0 };
    let (mut highest, mut commits, mut forgets) = (0, 0, false);
    for clock in 0..10_000 {
        // Long enough between zeros that every counter leaves its lowest byte.
        let zeros = clock == 0 || rig.random.below(1500) == 0;
        let by_reset = clock == 0 || rig.random.below(2) == 0;
        if forgets {
            // The core has no point to insert right after a clear.
            rig.pause = rig.pause.max(1);
        }
        rig.block.set("reset", zeros && by_reset);
        rig.block.set("clears", zeros && !by_reset);
        let added = rig.set_events();
        let since = rig.set_since();
        rig.expect();
        rig.block.edge();
        rig.latencies.edge(since, forgets);
        forgets = zeros;
        rig.counted = rig.sums;
        if zeros && by_reset {
            rig.latencies.now = 0;
        }
        for (sum, added) in rig.sums.iter_mut().zip(added) {
            *sum = if zeros { 0 } else { *sum + added };
        }
        highest = highest.max(rig.sums[Counter::CavityTriangles as usize]);
        commits += usize::from(rig.commit_ends);
    }
    assert!(highest > 1 << 10 && commits > 300, "{highest} {commits}");
}

/// At the ends of the clock count, which the event counters do not reach in a test.
#[test]
fn latency_range_lives_with_a_clock_that_wraps() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("latency_range", LatencyRange::default(), 1);
    let turn = 1u64 << LATENCY_BITS;
    let mut reference = LatencyReference::default();
    let mut pause = 0;
    for clock in 0..8000 {
        let zero = clock == 0 || random.below(60) == 0;
        let commit_ends = pause == 0 && random.below(3) == 0;
        pause = if commit_ends { 2 + random.below(2) } else { pause.saturating_sub(1) };
        reference.now = [0, 1, turn / 2, turn - 1, random.below(turn)][random.below(5) as usize];
        // A point is never taken and finished in one clock.
        let latency = 1 + [random.below(40), turn - 2, random.below(turn - 1)][random.below(3) as usize];
        let since = (reference.now + turn - latency) % turn;
        block.set("zero", zero);
        block.set("commit_ends", commit_ends);
        block.set("now", reference.now);
        block.set("since", since);
        block.settle();
        if clock > 0 {
            let (least, most) = reference.range.unwrap_or_default();
            block.expect("least", least);
            block.expect("most", most);
            block.expect("latency_comes", reference.came.is_some());
        }
        if let Some(latency) = reference.came {
            block.expect("latency", latency);
        }
        block.edge();
        reference.edge(commit_ends.then_some(since), zero);
    }
}

/// With words of four bits, so that both wrap.
#[test]
fn the_high_word_follows_a_clock_after_the_low_one() {
    let mut random = SplitMix64::new(4);
    let mut block = Stepper::new("wide_counter_4", WideCounter::default(), 1);
    let (mut sum, mut sum_before, mut noted, mut wraps) = (0u64, 0, false, 0);
    for clock in 0..8000 {
        let zero = clock == 0 || random.below(1000) == 0;
        let count = random.below(8) != 0;
        block.set("zero", zero);
        block.set("count", count);
        block.settle();
        if clock > 0 {
            block.expect("low", sum & 15);
            block.expect("high", sum_before >> 4 & 15);
        }
        block.edge();
        wraps += u32::from(noted && sum & 0xff == 0xff);
        (sum_before, sum) = if zero { (0, 0) } else { (sum, sum + u64::from(noted)) };
        noted = count;
    }
    assert!(wraps > 3, "{wraps}");
}
