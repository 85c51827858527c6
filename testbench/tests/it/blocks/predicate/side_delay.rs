//! Runs `SideDelay` in Rust and in Verilog beside a list: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Delay, Stepper};
use crate::rig::visit_points::shown;
use incircle_hdl::predicate::SideDelay;
use incircle_testkit::SplitMix64;

named_ports!([] SideDelay, [e0, e1, e2, flags], [sides], clock);

const CYCLES: usize = 2_000;

#[test]
fn side_delay_keeps_the_low_words() {
    let mut random = SplitMix64::new(17);
    let values = |random: &mut SplitMix64| [36, 36, 36, 9].map(|bits| random.bits(bits)).to_vec();
    let stimuli: Vec<Vec<u64>> = (0..CYCLES).map(|_| values(&mut random)).collect();
    let latency = 6;
    let mut delay = Delay::new(latency);
    let weights = ["sides_weights_w0", "sides_weights_w1", "sides_weights_w2"];
    let block = Stepper::new("side_delay", SideDelay::new(latency), 1);
    block.run(&["e0", "e1", "e2", "flags"], &weights, stimuli, |values| {
        shown(delay.pass([0, 1, 2].map(|k| u128::from(values[k]) & 0xffff_ffff).to_vec()), weights.len())
    });
}

#[test]
fn side_delay_passes_the_signs() {
    let mut random = SplitMix64::new(18);
    let stimuli: Vec<Vec<u64>> = (0..CYCLES).map(|_| vec![random.bits(9)]).collect();
    Stepper::new("side_delay", SideDelay::new(6), 1).run(&["flags"], &["sides_flags"], stimuli, |values| {
        shown(Some(values[..1].iter().map(|&flags| flags.into()).collect()), 1)
    });
}
