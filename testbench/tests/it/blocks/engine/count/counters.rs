//! Runs `Counters` in Rust and in Verilog beside a table of 64-bit sums: all three must agree in every clock.

use super::latency_range::LatencyReference;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::Counters;
use incircle_protocol::{Counter, COUNTER_WORDS, LATENCY_BITS};
use incircle_testkit::SplitMix64;

named_ports!(
    Counters,
    [reset, clears, inserting, waiting, reading, events, refused, select],
    [value, insertions, duplicates, now, latency_comes, latency],
    clock
);

/// Events that add one to one counter.
const EVENTS: [(&str, Counter); 18] = [
    ("inserting", Counter::InsertCycles),
    ("waiting", Counter::WaitCycles),
    ("reading", Counter::ReadCycles),
    ("is_issuing", Counter::IssueCycles),
    ("is_writing", Counter::WriteCycles),
    ("is_committing", Counter::CommitCycles),
    ("walk_visit", Counter::WalkVisits),
    ("root_visit", Counter::RootVisits),
    ("revisit", Counter::Revisits),
    ("aborts", Counter::Aborts),
    ("root_changed", Counter::RootRetries),
    ("takes_priority", Counter::PrioritiesTaken),
    ("overflows", Counter::Overflows),
    ("flip", Counter::Flips),
    // Of two ports that add to one counter, the later one is low while the earlier one is high.
    ("test", Counter::Tests),
    ("duplicate", Counter::Duplicates),
    ("solo_duplicate", Counter::Duplicates),
    ("is_releasing", Counter::ReleaseCycles),
];

/// The counters beside sums of 64 bits.
struct Rig {
    block: Stepper<Counters>,
    random: SplitMix64,
    sums: [u64; COUNTER_WORDS],
    /// Sums of a clock ago, which the block has counted.
    counted: [u64; COUNTER_WORDS],
    /// Words selected in the last clock and in the one before.
    chosen: [u64; 2],
    latencies: LatencyReference,
    commit_ends: bool,
    /// Clocks until the next commit may end.
    pause: u64,
}

impl Rig {
    /// Sets random events, and returns what they add to each counter.
    fn set_events(&mut self) -> [u64; COUNTER_WORDS] {
        let mut added = [0; COUNTER_WORDS];
        let mut inserting = false;
        for (port, counter) in EVENTS {
            let happens = added[counter as usize] == 0 && self.random.below(2) == 1;
            self.block.set(port, happens);
            inserting |= port == "inserting" && happens;
            // A release during the sweep after reset does not count.
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

    /// Returns the clock in which the point of an ending commit was taken, if a commit ends.
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
        // Zeros come seldom enough that every counter leaves its lowest byte.
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
