//! Runs `RgmiiIn` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::ethernet::RgmiiIn;
use incircle_testkit::SplitMix64;

named_ports!(RgmiiIn, [clock, control, pins], [data_valid, data_error, data]);

#[test]
fn bytes_come_in_halves_at_both_edges() {
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new("ethernet_rgmii_in", RgmiiIn::new(0), 1);
    // The byte whose second half has come, and the byte that the block shows from the next rising edge on.
    let (mut complete, mut shown): (Option<(u64, bool, bool)>, _) = (None, None);
    block.set("clock", false);
    for _ in 0..500 {
        let byte = random.below(256);
        let (valid, error) = (random.below(4) > 0, random.below(6) == 0);
        for (level, half, control) in [(true, byte & 15, valid), (false, byte >> 4, valid != error)] {
            block.set("pins", half);
            block.set("control", control);
            block.settle();
            block.set("clock", level);
            block.settle();
            // What changes behind an edge is no part of the byte.
            block.set("pins", random.below(16));
            block.set("control", random.below(2) == 0);
            block.settle();
            if level {
                shown = complete.take();
            } else {
                complete = Some((byte, valid, error));
            }
            if let Some((byte, valid, error)) = shown {
                block.expect("data", byte);
                block.expect("data_valid", u128::from(valid));
                block.expect("data_error", u128::from(error));
            }
        }
    }
}
