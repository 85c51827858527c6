//! Runs `FlagDelay` in Rust and in Verilog beside an independent reference: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Delay, Stepper};
use incircle_hdl::leaf::FlagDelay;
use incircle_testkit::SplitMix64;

named_ports!([] FlagDelay, [flag_in], [flag_out], clock);

const CYCLES: usize = 20_000;

#[test]
fn flag_delay_of_one_two_and_nine_stages() {
    for (name, stages) in [("flag_delay_1", 1), ("flag_delay_2", 2), ("flag_delay_9", 9)] {
        let mut numbers = SplitMix64::new(6);
        let stimuli: Vec<_> = (0..CYCLES).map(|_| vec![numbers.bits(1)]).collect();
        let mut delay = Delay::new(stages);
        Stepper::new(name, FlagDelay::new(stages), 1)
            .run(&["flag_in"], &["flag_out"], stimuli, |values| vec![delay.pass(values[0].into())]);
    }
}
