//! Runs `BitClock` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::BitClock;
use incircle_protocol::MAX_STEP;
use incircle_testkit::SplitMix64;

named_ports!(BitClock, [step, starts], [ticks], clock);

const TURN: u64 = 1 << 24;

fn ticks(name: &'static str, block: BitClock, first: u64) {
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new(name, block, 1);
    for run in 0..40 {
        let step = match run {
            0 => u64::from(MAX_STEP),
            1 => TURN / 5000,
            _ => 1 + random.below(u64::from(MAX_STEP)),
        };
        block.set("step", step);
        for clock in 0..1500 {
            block.set("starts", clock == 0);
            block.settle();
            // The addition that shows is that of the clock before; the first one follows `starts`.
            if clock >= 1 {
                let turns = |additions: u64| (first + additions * step) / TURN;
                block.expect("ticks", clock >= 2 && turns(clock - 1) > turns(clock - 2));
            }
            block.edge();
        }
    }
}

#[test]
fn bits_tick_at_their_ends() {
    ticks("serial_bit_ends", BitClock::at_ends(), 0);
}

#[test]
fn bits_tick_in_their_middles() {
    ticks("serial_bit_middles", BitClock::in_middles(), TURN / 2);
}
