//! Runs `Multiplier` in Rust and in Verilog beside an independent reference: all three must agree in every clock.

use crate::rig::memories::both_forms;
use crate::rig::stepper::{named_ports, Delay, Stepper};
use incircle_hdl::leaf::Multiplier;
use incircle_testkit::SplitMix64;

named_ports!([] Multiplier, [a, b], [product], clock);

const CYCLES: usize = 20_000;

fn signed(value: u64, bits: u32) -> i64 {
    ((value << (64 - bits)) as i64) >> (64 - bits)
}

#[test]
fn multiplier_multiplies_in_three_clocks() {
    let corners = [0, 1, 0x1_ffff, 0x2_0000, 0x2_0001, 0x3_ffff];
    let mut numbers = SplitMix64::new(1);
    let mut stimuli: Vec<_> = corners.iter().flat_map(|a| corners.iter().map(|b| vec![*a, *b])).collect();
    stimuli.extend((0..CYCLES).map(|_| vec![numbers.bits(18), numbers.bits(18)]));
    for name in both_forms("multiplier") {
        let mut delay = Delay::new(Multiplier::LATENCY);
        Stepper::new(&name, Multiplier::default(), 1).run(&["a", "b"], &["product"], stimuli.clone(), |values| {
            let product = signed(values[0], 18) * signed(values[1], 18);
            vec![delay.pass(u128::from(product as u64 & 0xf_ffff_ffff))]
        });
    }
}
