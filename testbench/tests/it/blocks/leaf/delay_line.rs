//! Runs `DelayLine` in Rust and in Verilog beside an independent reference: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Delay, Stepper};
use incircle_hdl::leaf::DelayLine;
use incircle_testkit::SplitMix64;

named_ports!([const D: usize] DelayLine<D>, [data_in], [data_out], clock);

const CYCLES: usize = 20_000;

fn delay_line<const D: usize>(name: &str, stages: usize) {
    let mut numbers = SplitMix64::new(5);
    let stimuli: Vec<_> = (0..CYCLES).map(|_| vec![numbers.bits(D as u32)]).collect();
    let mut delay = Delay::new(stages);
    Stepper::new(name, DelayLine::<D>::new(stages), 1)
        .run(&["data_in"], &["data_out"], stimuli, |values| vec![delay.pass(values[0].into())]);
}

#[test]
fn delay_line_of_the_fewest_stages() {
    delay_line::<8>("delay_line_3", DelayLine::<8>::MIN_STAGES);
}

#[test]
fn delay_line_of_nineteen_stages() {
    delay_line::<40>("delay_line_19", 19);
}
