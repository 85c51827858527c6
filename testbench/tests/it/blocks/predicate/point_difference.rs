//! Runs `PointDifference` in Rust and in Verilog beside plain integer arithmetic: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::visit_points::{bits_of, point};
use incircle_hdl::predicate::PointDifference;
use incircle_testkit::SplitMix64;

named_ports!([] PointDifference, [from, to], [x, y]);

const CYCLES: usize = 10_000;

#[test]
fn point_difference_never_wraps() {
    let mut numbers = SplitMix64::new(12);
    let ends = [0, 1, 0x7fff, 0x8000, 0xfffe, 0xffff];
    let mut stimuli: Vec<Vec<u64>> = vec![];
    for from in ends {
        for to in ends {
            stimuli.push(vec![from | to << 16, to | from << 16]);
        }
    }
    stimuli.extend((0..CYCLES).map(|_| vec![numbers.bits(32), numbers.bits(32)]));
    Stepper::new("point_difference", PointDifference::default(), 1).run(
        &["from", "to"],
        &["x", "y"],
        stimuli,
        |values| {
            let (from, to) = (point(values[0]), point(values[1]));
            [to.0 - from.0, to.1 - from.1].map(|part| Some(bits_of(part.into(), 18))).to_vec()
        },
    );
}
