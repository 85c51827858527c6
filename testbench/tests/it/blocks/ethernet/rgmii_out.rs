//! Runs `RgmiiOut` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::ethernet::RgmiiOut;
use incircle_testkit::SplitMix64;

named_ports!(RgmiiOut, [clock, data_valid, data], [clock_pin, control, pins]);

#[test]
fn bytes_go_out_in_halves_at_both_edges() {
    let mut random = SplitMix64::new(2);
    let mut block = Stepper::new("ethernet_rgmii_out", RgmiiOut::default(), 1);
    // The bytes of the last two clocks, the older one first.
    let mut given: Vec<(u64, bool)> = Vec::new();
    block.set("clock", false);
    for _ in 0..500 {
        let (byte, valid) = (random.below(256), random.below(4) > 0);
        block.set("data", byte);
        block.set("data_valid", valid);
        block.settle();
        for level in [true, false] {
            block.set("clock", level);
            block.settle();
            block.expect("clock_pin", u128::from(level));
            if let Some((shown, was_valid)) = given.last() {
                block.expect("pins", if level { shown & 15 } else { shown >> 4 });
                block.expect("control", u128::from(*was_valid));
            }
        }
        given.push((byte, valid));
    }
}

#[test]
fn wave_of_two_bytes() {
    let mut block = Stepper::new("ethernet_rgmii_out", RgmiiOut::default(), 1);
    block.set("clock", false);
    let mut wave = Wave::default();
    // Bytes 35 and 52, whose halves are 3 and 2, and 4 and 3.
    for (clock, byte) in [0u8, 0, 0, 35, 52, 0, 0, 0].into_iter().enumerate() {
        let valid = byte > 0;
        block.set("data", byte);
        block.set("data_valid", valid);
        block.settle();
        for level in [true, false] {
            block.set("clock", level);
            block.settle();
            if clock >= 2 {
                let is_valid = block.is("control");
                wave.take(&[
                    ("data_valid", Cell::Bit(valid)),
                    ("data", if valid { Cell::Number(byte.into()) } else { Cell::Open }),
                    ("clock_pin", Cell::Bit(block.is("clock_pin"))),
                    ("control", Cell::Bit(is_valid)),
                    ("pins", if is_valid { Cell::Number(block.get("pins")) } else { Cell::Open }),
                ]);
            }
        }
    }
    wave.assert_drawn_in("rgmii_out");
}
