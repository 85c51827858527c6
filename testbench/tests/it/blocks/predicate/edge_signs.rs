//! Runs `EdgeSigns` in Rust and in Verilog beside plain integer arithmetic: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Delay, Stepper};
use crate::rig::visit_points::{bits_of, edge_flags, shown, signed, EDGE_FLAGS};
use incircle_hdl::predicate::EdgeSigns;
use incircle_testkit::SplitMix64;

named_ports!([] EdgeSigns, [e0, e1, e2], [flags], clock);

const CYCLES: usize = 10_000;

#[test]
fn edge_signs_compare_signed() {
    let mut numbers = SplitMix64::new(15);
    let limit = 1_i64 << 32;
    let corners = [0, 1, -1, limit - 1, -limit];
    let stimuli: Vec<Vec<u64>> = (0..CYCLES)
        .map(|_| {
            let mut value = || match numbers.below(3) {
                0 => corners[numbers.below(5) as usize],
                1 => numbers.bits(2) as i64 - 2,
                _ => numbers.bits(33) as i64 - limit,
            };
            (0..3).map(|_| bits_of(value().into(), 36) as u64).collect()
        })
        .collect();
    let latency = 2;
    let mut delay = Delay::new(latency);
    Stepper::new("edge_signs", EdgeSigns::new(latency), 1).run(&["e0", "e1", "e2"], &EDGE_FLAGS, stimuli, |values| {
        let e = [0, 1, 2].map(|k| signed(values[k], 36));
        shown(delay.pass(edge_flags(e)), EDGE_FLAGS.len())
    });
}
