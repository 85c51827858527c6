//! Runs `AsyncFifo` in Rust and in Verilog beside plain code: all three must agree at every edge of either clock, at
//! ratios of 1:4 to 4:1 with phases that drift.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::stream_rig::{rise, Clocks, PERIODS};
use incircle_hdl::stream::AsyncFifo;
use incircle_testkit::SplitMix64;

named_ports!([const P: usize, const D: usize] AsyncFifo<P, D>,
    [write_clock, write_reset, push, push_data, read_clock, read_reset, pop],
    [is_full, is_fetched, valid, data, is_empty]);

const WRITE_AND_READ: [&str; 2] = ["write_clock", "read_clock"];

/// Pace of one side of the FIFO, which goes on in one clock out of this many. The two numbers take turns.
struct Pace([u64; 2]);

impl Pace {
    fn goes(&self, time: usize, random: &mut SplitMix64) -> bool {
        random.below(self.0[time / 1500 % 2]) == 0
    }
}

/// Runs the FIFO between a writer and a reader, which take turns at being the slower one.
fn buffers<const P: usize, const D: usize>(name: &'static str) {
    let depth = AsyncFifo::<P, D>::DEPTH;
    let (mut passed, mut times_full, mut times_empty) = (0, 0, 0);
    for (seed, periods) in PERIODS.into_iter().enumerate() {
        let mut random = SplitMix64::new(seed as u64);
        let mut clocks = Clocks::new(periods, seed as u64);
        let mut block = Stepper::new(name, AsyncFifo::<P, D>::new(), seed as u32);
        let (writer, reader) = (Pace([1, 4]), Pace([4, 1]));
        // Entries, each with the number of the reader's edges since it was taken.
        let mut entries: VecDeque<(u64, usize)> = VecDeque::new();
        let mut resets_left = 24;
        for time in 0..6000 {
            if time == 3700 {
                resets_left = 40;
            }
            let resets = resets_left > 0;
            resets_left -= usize::from(resets);
            let rises = clocks.next();
            let push = !resets && writer.goes(time, &mut random);
            let entry = random.below(1 << D);
            let known = time > 20;
            block.set("write_reset", resets);
            block.set("read_reset", resets);
            block.set("push", push);
            block.set("push_data", entry);
            block.set("pop", false);
            block.settle();
            let is_full = known && block.is("is_full");
            let valid = known && block.is("valid");
            if known && !resets {
                assert!(entries.len() <= depth + 2);
                assert!(!valid || !entries.is_empty(), "an entry came that nobody pushed");
                let is_late = entries.front().is_some_and(|(_, edges)| *edges > 6);
                assert!(valid || !is_late, "{name} at {periods:?}: no entry after six edges");
                if block.is("is_empty") {
                    assert!(!valid);
                }
                if block.is("is_fetched") {
                    assert!(entries.len() <= 2, "fetched, and {} are held", entries.len());
                }
            }
            let pop = valid && !resets && reader.goes(time, &mut random);
            if let (true, Some((first, _))) = (valid, entries.front()) {
                block.expect("data", *first);
            }
            block.set("pop", pop);
            block.settle();
            if known {
                // No output of a side follows the side's inputs within the clock.
                block.expect("valid", valid);
                block.expect("is_full", is_full);
            }
            times_full += usize::from(is_full && push);
            times_empty += usize::from(known && !valid);
            rise(&mut block, [(WRITE_AND_READ[0], rises[0]), (WRITE_AND_READ[1], rises[1])]);
            if rises[1] {
                if pop {
                    entries.pop_front();
                    passed += 1;
                    // The read port may have to fetch the next entry.
                    if let Some((_, edges)) = entries.front_mut() {
                        *edges = (*edges).min(3);
                    }
                }
                entries.iter_mut().for_each(|(_, edges)| *edges += 1);
            }
            if rises[0] && push && !is_full {
                entries.push_back((entry, 0));
            }
            if resets {
                entries.clear();
            }
        }
    }
    assert!(passed > 3000 && times_full > 300 && times_empty > 300, "{passed} passed, {times_full}, {times_empty}");
}

#[test]
fn the_fifo_keeps_order_and_loses_nothing() {
    buffers::<4, 8>("stream_fifo_8x8");
}

#[test]
fn the_smallest_fifo_too() {
    buffers::<3, 2>("stream_fifo_4x2");
}

#[test]
fn an_entry_passes_at_every_clock_of_the_slower_side() {
    for (periods, seed) in [([8000, 8000], 1), ([8000, 9000], 2), ([9000, 8000], 3), ([8000, 30_000], 4)] {
        let mut clocks = Clocks::new(periods, seed);
        let mut block = Stepper::new("stream_fifo_8x8", AsyncFifo::<4, 8>::new(), 1);
        let slower = usize::from(periods[1] > periods[0]);
        let (mut edges, mut passed) = (0u64, 0u64);
        for time in 0..4000 {
            let rises = clocks.next();
            let resets = time < 40;
            for (port, value) in [("write_reset", resets), ("read_reset", resets), ("push", true), ("pop", false)] {
                block.set(port, value);
            }
            block.set("push_data", time as u64 & 0xff);
            block.settle();
            let pop = !resets && block.is("valid");
            block.set("pop", pop);
            block.settle();
            rise(&mut block, [(WRITE_AND_READ[0], rises[0]), (WRITE_AND_READ[1], rises[1])]);
            edges += u64::from(time >= 100 && rises[slower]);
            passed += u64::from(time >= 100 && rises[1] && pop);
        }
        assert!(passed + 3 >= edges, "{passed} entries in {edges} clocks at {periods:?}");
    }
}
