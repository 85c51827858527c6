//! `CommandGate`: Rust, Verilog and a statement of the rule agree over random inputs.

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::link::CommandGate;

named_ports!(
    CommandGate,
    [is_command, is_argument, is_points, sweeps, none_is_left, came, engine],
    [ready, takes_command, takes_point, awaits_point]
);

const ROUNDS: usize = 4000;

#[test]
fn command_gate_waits_for_the_point_before_and_the_first_triangle() {
    let mut random = SplitMix64::new(23);
    let mut block = Stepper::new("command_gate", CommandGate::default(), 1);
    for _ in 0..ROUNDS {
        let meaning = random.below(4);
        let [sweeps, none_is_left, came, start_is_open, stuck] = [(); 5].map(|()| flip(&mut random));
        for (port, value) in [
            ("is_command", meaning == 0),
            ("is_argument", meaning == 1),
            ("is_points", meaning == 2),
            ("sweeps", sweeps),
            ("none_is_left", none_is_left),
            ("came", came),
            ("start_is_open", start_is_open),
            ("stuck", stuck),
        ] {
            block.set(port, value);
        }
        let is_undecided = start_is_open && !stuck;
        let ready = match meaning {
            0 => !sweeps,
            1 => true,
            2 => !(none_is_left || came || is_undecided),
            _ => false,
        };
        block.settle();
        block.expect("ready", ready);
        block.expect("takes_command", ready && meaning == 0);
        block.expect("takes_point", ready && meaning == 2);
        block.expect("awaits_point", meaning == 2 && !none_is_left);
    }
}
