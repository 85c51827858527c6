//! Runs `OnesSum` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::ethernet::OnesSum;
use incircle_testkit::SplitMix64;

named_ports!(OnesSum, [sets, start, takes, is_low, byte_data], [sum], clock);

#[test]
fn sums_are_those_of_whole_words_modulo_65535() {
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new("ethernet_ones_sum", OnesSum::default(), 1);
    let mut wraps = 0;
    for _ in 0..300 {
        let start = [0, 1, 0xfffc, random.below(1 << 16)][random.below(4) as usize];
        for (port, value) in [("sets", 1), ("start", start), ("takes", 1), ("is_low", 0), ("byte_data", 0x77)] {
            block.set(port, value);
        }
        block.settle();
        block.edge();
        block.set("sets", false);
        let mut total = start;
        for place in 0..random.below(60) {
            let byte = if random.below(2) == 0 { 0xff } else { random.below(256) };
            let takes = random.below(8) > 0;
            let is_low = place % 2 == 1;
            block.set("takes", takes);
            block.set("is_low", is_low);
            block.set("byte_data", byte);
            block.settle();
            block.edge();
            total += if takes { byte << if is_low { 0 } else { 8 } } else { 0 };
        }
        block.set("takes", false);
        block.settle();
        block.edge();
        block.settle();
        wraps += usize::from(total > 0xffff);
        block.expect("sum", if total > 0 && total.is_multiple_of(0xffff) { 0xffff } else { total % 0xffff });
    }
    assert!(wraps > 100, "{wraps} sums had a carry");
}

#[test]
fn wave_of_a_word_with_a_carry() {
    let stimuli =
        [(0, "sets", 1), (0, "start", 0xfffc), (1, "takes", 1), (2, "takes", 1), (2, "is_low", 1), (2, "byte_data", 9)];
    let lanes = [
        ("sets", "sets", 0, 1, When::Always),
        ("takes", "takes", 0, 1, When::Always),
        ("is_low", "is_low", 0, 1, When::If("takes")),
        ("byte_data", "byte_data", 0, 8, When::If("takes")),
        ("sum[5:0]", "sum", 0, 6, When::At(&[1, 2, 3, 4, 5])),
    ];
    draw("ethernet_ones_sum", OnesSum::default(), &stimuli, 6, &lanes).assert_drawn_in("ones_sum");
}
