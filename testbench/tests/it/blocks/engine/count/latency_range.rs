//! Runs `LatencyRange` in Rust and in Verilog beside a table of 64-bit sums: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::LatencyRange;
use incircle_protocol::LATENCY_BITS;
use incircle_testkit::SplitMix64;

named_ports!(LatencyRange, [zero, commit_ends, now, since], [latency_comes, latency, least, most], clock);

/// The clock count and the range of latencies.
#[derive(Clone, Copy, Default)]
pub struct LatencyReference {
    pub now: u64,
    /// Latency of the commit at the last edge.
    pub came: Option<u64>,
    /// The latency before that one, which has been compared.
    pub compared: Option<u64>,
    /// Least and largest of the latencies before these.
    pub range: Option<(u64, u64)>,
}

impl LatencyReference {
    pub fn edge(&mut self, since: Option<u64>, forgets: bool) {
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

/// Runs the block near the end of its clock count, which the event counters do not reach in a test.
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
