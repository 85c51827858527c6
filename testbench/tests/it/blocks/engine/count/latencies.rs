//! Runs `Latencies` in Rust and in Verilog beside a table of counts: all three must agree in every clock. The bucket
//! of a latency is the protocol's.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::Latencies;
use incircle_protocol::{latency_bucket, LATENCY_BITS, LATENCY_BUCKETS};
use incircle_testkit::SplitMix64;

named_ports!(Latencies, [reset, clears, comes, latency, select], [sweeps, value], clock);

/// The histogram as a list of counts, and the latencies that are still to be counted.
struct Reference {
    counts: Vec<u32>,
    /// The bucket that is sought (for two clocks), that is read, and that is counted at the next edge.
    due: [Option<usize>; 4],
    /// Clocks that are left of the sweep.
    sweep: usize,
}

impl Reference {
    fn new() -> Self {
        Self { counts: vec![0; LATENCY_BUCKETS], due: [None; 4], sweep: LATENCY_BUCKETS }
    }

    fn edge(&mut self, latency: Option<u32>, starts_sweep: bool) {
        if let Some(bucket) = self.due[3] {
            self.counts[bucket] += 1;
        }
        self.due = [latency.map(latency_bucket), self.due[0], self.due[1], self.due[2]];
        self.sweep = self.sweep.saturating_sub(1);
        if starts_sweep {
            *self = Self::new();
        }
    }
}

#[test]
fn latencies_are_counted_by_bucket() {
    let mut random = SplitMix64::new(41);
    let mut block = Stepper::new("latencies", Latencies::default(), 1);
    let mut reference = Reference::new();
    let (mut sweeps, mut highest, mut pause, mut chosen) = (0, 0, 0, None);
    for clock in 0..20_000 {
        let reset = clock == 0 || random.below(2000) == 0;
        let clears = random.below(1500) == 0;
        // Bursts of a few latencies, so that the same bucket is counted again as soon as possible; none during a sweep.
        let comes = reference.sweep == 0 && !clears && pause == 0 && clock / 64 % 2 == 0 && random.below(3) != 0;
        pause = if comes { 2u64 } else { pause.saturating_sub(1) };
        let latency = [20, 21, 22, random.below(1 << LATENCY_BITS) as u32][random.below(4) as usize];
        let select = [random.below(4), random.below(128)][random.below(2) as usize];
        block.set("reset", reset);
        block.set("clears", clears);
        block.set("comes", comes);
        block.set("latency", latency);
        block.set("select", select);
        block.settle();
        if clock > 0 {
            block.expect("sweeps", reference.sweep > 0);
        }
        if let Some(count) = chosen {
            block.expect("value", count);
            highest = highest.max(count);
        }
        let is_read = clock > 0 && reference.sweep == 0 && reference.due[2].is_none();
        chosen = is_read.then(|| reference.counts[select as usize]);
        block.edge();
        sweeps += usize::from(reset || clears);
        reference.edge(comes.then_some(latency), reset || clears);
    }
    assert!(sweeps > 10 && highest > 100, "{sweeps} {highest}");
}

/// A sweep must clear every bucket, whatever stood in it.
#[test]
fn latencies_are_all_swept() {
    let mut block = Stepper::new("latencies", Latencies::default(), 7);
    for clock in 0..2 * LATENCY_BUCKETS + 2 {
        block.set("reset", clock == 0);
        block.set("clears", false);
        block.set("comes", false);
        block.set("latency", 0u32);
        block.set("select", (clock.max(LATENCY_BUCKETS + 1) - LATENCY_BUCKETS - 1).min(LATENCY_BUCKETS - 1) as u64);
        block.settle();
        if clock > 0 {
            block.expect("sweeps", clock <= LATENCY_BUCKETS);
        }
        if clock > LATENCY_BUCKETS + 1 {
            block.expect("value", 0u32);
        }
        block.edge();
    }
}

/// Draws the end of a sweep, and two insertions of 22 clocks.
#[test]
fn latencies_show_the_wave_of_their_header() {
    let mut block = Stepper::new("latencies", Latencies::default(), 1);
    let mut wave = Wave::default();
    let first = LATENCY_BUCKETS - 2;
    for clock in 0..first + 16 {
        let comes = [first + 4, first + 7].contains(&clock);
        block.set("reset", clock == 0);
        block.set("clears", false);
        block.set("comes", comes);
        block.set("latency", 22u32);
        block.set("select", latency_bucket(22) as u64);
        block.settle();
        if clock >= first {
            let sweeps = block.is("sweeps");
            // The value is open where the memory was swept or read for a count in the clock before.
            let is_open = clock <= first + 3 || [first + 8, first + 11].contains(&clock);
            let value = if is_open { Cell::Open } else { Cell::Number(block.get("value")) };
            wave.take(&[
                ("sweeps", Cell::Bit(sweeps)),
                ("comes", Cell::Bit(comes)),
                ("latency", if comes { Cell::Number(22) } else { Cell::Open }),
                ("value", value),
            ]);
        }
        block.edge();
    }
    wave.assert_drawn_in("latencies");
}
