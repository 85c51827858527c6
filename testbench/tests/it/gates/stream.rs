//! Passes a core behind a stream link through the gate, and keeps the size of the link in an Artix-7
//! and on an ECP5 in bounds.

use incircle_hdl::export;
use incircle_hdl::top::STREAM_TOP_NAME;
use incircle_protocol::{BEAT_BITS, SMALL, TINY};
use incircle_testbench::gate::{self, ArtixCells, Cells};

#[test]
fn devices_with_a_stream_link_pass_lint_and_synthesis() {
    for (config, beat_bits, with_probe) in [(TINY, 64, true), (SMALL, 64, false), (SMALL, 128, false)] {
        let passed = gate::pass(&export::stream_top(config, beat_bits, with_probe).unwrap(), STREAM_TOP_NAME);
        assert!(passed.is_ok(), "{} at {beat_bits} bits: {}", config.name, passed.unwrap_err());
    }
}

#[test]
fn a_device_with_runs_passes_lint_and_synthesis() {
    let passed = gate::pass(&export::stream_top_with_runs(SMALL, 64, false).unwrap(), STREAM_TOP_NAME);
    assert!(passed.is_ok(), "{}", passed.unwrap_err());
}

/// Cells of the links by Yosys 0.23. Logic that a constant swept away, or that a change doubles, is more than 5 % off.
const ECP5: [Cells; 2] = [
    Cells { lut4: 815, carry: 149, distributed_ram: 0, flip_flops: 987, multipliers: 0, block_ram: 4 },
    Cells { lut4: 864, carry: 149, distributed_ram: 0, flip_flops: 1244, multipliers: 0, block_ram: 8 },
];
const ARTIX: [ArtixCells; 2] = [
    ArtixCells { luts: 533, carry: 80, flip_flops: 973, block_ram: 4 },
    ArtixCells { luts: 612, carry: 80, flip_flops: 1230, block_ram: 8 },
];

#[test]
fn the_link_alone_is_small() {
    let links = BEAT_BITS.map(|beat_bits| {
        let verilog = export::stream_link(SMALL, beat_bits, "stream_link").unwrap();
        (gate::cell_count(&verilog, "stream_link").unwrap(), gate::artix_cell_count(&verilog, "stream_link").unwrap())
    });
    for ((ecp5, artix), beat_bits) in links.iter().zip(BEAT_BITS) {
        println!("stream link of {beat_bits} bits: {ecp5:?} on ECP5, {artix:?} in an Artix-7");
    }
    for (place, (ecp5, artix)) in links.into_iter().enumerate() {
        for near in [ecp5.check_near(&ECP5[place]), artix.check_near(&ARTIX[place])] {
            assert!(near.is_ok(), "{} bits: {}", BEAT_BITS[place], near.unwrap_err());
        }
    }
}
