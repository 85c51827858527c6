//! Runs `RgmiiIn` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
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

#[test]
fn wave_of_two_bytes_and_an_error() {
    let mut block = Stepper::new("ethernet_rgmii_in", RgmiiIn::new(0), 1);
    block.set("clock", false);
    let mut wave = Wave::default();
    // Bytes 35 and 52, whose halves are 3 and 2, and 4 and 3, then an error without a byte.
    let bytes = [(0, false, false), (35, true, false), (52, true, false), (0, false, true), (0, false, false)];
    let idle = [(0, false, false); 3];
    for (clock, (byte, valid, error)) in idle.iter().chain(&bytes).chain(&idle).enumerate() {
        for (level, half, control) in [(true, byte & 15, *valid), (false, byte >> 4, valid != error)] {
            block.set("pins", u32::from(half as u8));
            block.set("control", control);
            block.settle();
            block.set("clock", level);
            block.settle();
            if clock >= 2 {
                let is_valid = block.is("data_valid");
                wave.take(&[
                    ("clock", Cell::Bit(level)),
                    ("control", Cell::Bit(control)),
                    ("pins", Cell::Number(half as u128)),
                    ("data_valid", Cell::Bit(is_valid)),
                    ("data", if is_valid { Cell::Number(block.get("data")) } else { Cell::Open }),
                    ("data_error", Cell::Bit(block.is("data_error"))),
                ]);
            }
        }
    }
    wave.assert_drawn_in("rgmii_in");
}
