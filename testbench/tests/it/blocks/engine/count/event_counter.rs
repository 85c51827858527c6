//! Runs `EventCounter` and `WideCounter` in Rust and in Verilog beside a table of 64-bit sums: all
//! three must agree in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::WideCounter;
use incircle_testkit::SplitMix64;

named_ports!(WideCounter<4>, [zero, count], [low, high], clock);

/// Words of four bits, so that both wrap within a test.
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
