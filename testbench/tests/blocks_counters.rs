//! The event counters: Rust, Verilog and a table of 64-bit sums agree clock by clock.

mod block_ports;
mod stepper;

use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{Counters, WideCounter};
use incircle_protocol::{Counter, COUNTER_WORDS};
use stepper::{named_ports, Stepper};

named_ports!(
    Counters,
    [
        reset,
        clears,
        inserting,
        waiting,
        reading,
        seeds,
        commit_ends,
        solo_ends,
        duplicate,
        walk_visit,
        test,
        drained,
        flip,
        cavity_triangles,
        refused,
        select
    ],
    [value, insertions, duplicates],
    clock
);
named_ports!(WideCounter<4>, [zero, count], [low, high], clock);

/// Events that add one to one counter.
const EVENTS: [(&str, Counter); 8] = [
    ("inserting", Counter::InsertCycles),
    ("waiting", Counter::WaitCycles),
    ("reading", Counter::ReadCycles),
    ("duplicate", Counter::Duplicates),
    ("walk_visit", Counter::WalkVisits),
    ("test", Counter::Tests),
    ("drained", Counter::Overflows),
    ("flip", Counter::Flips),
];

#[test]
fn counters_count_their_events() {
    let mut random = SplitMix64::new(3);
    let mut block = Stepper::new("counters", Counters::default(), 1);
    let mut sums = [0u64; COUNTER_WORDS];
    let mut highest = 0;
    for clock in 0..8000 {
        // Long enough between zeros that every counter leaves its lowest byte.
        let zeros = clock == 0 || random.below(1500) == 0;
        let by_reset = clock == 0 || random.below(2) == 0;
        block.set("reset", zeros && by_reset);
        block.set("clears", zeros && !by_reset);
        let mut added = [0u64; COUNTER_WORDS];
        for (port, counter) in EVENTS {
            let happens = random.below(2) == 1;
            block.set(port, happens);
            added[counter as usize] = happens.into();
        }
        // At most one kind of insertion ends in a clock.
        let ends = random.below(8);
        for (kind, port, points) in [(0, "seeds", 3), (1, "commit_ends", 1), (2, "solo_ends", 1)] {
            block.set(port, ends == kind);
            if ends == kind {
                added[Counter::Insertions as usize] = points;
            }
        }
        let triangles = [0, 1, 126, random.below(127)][random.below(4) as usize];
        block.set("cavity_triangles", triangles);
        if ends == 1 {
            added[Counter::CavityTriangles as usize] = triangles;
        }
        let refused = [0, 0xffff_ffff, random.below(1 << 32)][random.below(3) as usize];
        sums[Counter::Refused as usize] = refused;
        block.set("refused", refused);
        let select = random.below(COUNTER_WORDS as u64);
        block.set("select", select);
        block.settle();
        if clock > 0 {
            block.expect("value", sums[select as usize]);
            block.expect("insertions", sums[Counter::Insertions as usize]);
            block.expect("duplicates", sums[Counter::Duplicates as usize]);
        }
        block.edge();
        for (sum, added) in sums.iter_mut().zip(added) {
            *sum = if zeros { 0 } else { *sum + added };
        }
        highest = highest.max(sums[Counter::CavityTriangles as usize]);
    }
    assert!(highest > 1 << 10, "{highest}");
}

/// With words of four bits, so that both wrap.
#[test]
fn the_high_word_follows_a_clock_after_the_low_one() {
    let mut random = SplitMix64::new(4);
    let mut block = Stepper::new("wide_counter_4", WideCounter::default(), 1);
    let (mut sum, mut sum_before, mut wraps) = (0u64, 0, 0);
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
        wraps += u32::from(count && sum & 0xff == 0xff);
        (sum_before, sum) = if zero { (0, 0) } else { (sum, sum + u64::from(count)) };
    }
    assert!(wraps > 3, "{wraps}");
}
