//! Runs `CommandGate` in Rust and in Verilog beside a statement of the rule: all three must agree over random inputs.

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::CommandGate;
use incircle_testkit::SplitMix64;

named_ports!(
    CommandGate,
    [command.valid, command.data, state, sweeps, none_is_left, came, engine],
    [command.ready, taken, awaits_point]
);

const ROUNDS: usize = 4000;

#[test]
fn command_gate_waits_for_the_point_before_and_the_first_triangle() {
    let mut random = SplitMix64::new(23);
    let mut block = Stepper::new("command_gate", CommandGate::default(), 1);
    for _ in 0..ROUNDS {
        let meaning = random.below(4);
        let [valid, sweeps, none_is_left, came, start_is_open, stuck] = [(); 6].map(|()| flip(&mut random));
        for (port, value) in [
            ("command_valid", valid),
            ("sweeps", sweeps),
            ("none_is_left", none_is_left),
            ("came", came),
            ("start_is_open", start_is_open),
            ("stuck", stuck),
        ] {
            block.set(port, value);
        }
        let word = if flip(&mut random) { random.below(1 << 32) } else { 0 };
        block.set("command_data", word);
        // States of the gate in their order: a command, two arguments, points, two without words.
        block.set("state", [0, 1 + random.below(2), 3, 4 + random.below(2)][meaning as usize]);
        let is_undecided = start_is_open && !stuck;
        let ready = match meaning {
            0 => !sweeps,
            1 => true,
            2 => !(none_is_left || came || is_undecided),
            _ => false,
        };
        block.settle();
        block.expect("command_ready", ready);
        block.expect("taken_word", word);
        block.expect("is_command", valid && ready && meaning == 0 && word != 0);
        block.expect("is_point", valid && ready && meaning == 2);
        block.expect("awaits_point", meaning == 2 && !none_is_left);
    }
}
