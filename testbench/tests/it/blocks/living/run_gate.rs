//! Parts the words of runs from others, in Rust and in Verilog beside a statement of the rules: all three must agree.

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::living::RunGate;
use incircle_testkit::SplitMix64;

named_ports!(
    RunGate,
    [
        command.valid,
        command.data,
        response.ready,
        standing,
        is_active,
        core_command.ready,
        core_response.valid,
        core_response.data,
        core_response.both,
        core_response.last,
        run_command.ready,
        run_response.valid,
        run_response.data,
        run_response.both,
        run_response.last
    ],
    [
        command.ready,
        response.valid,
        response.data,
        response.both,
        response.last,
        begins,
        opcode,
        core_command.valid,
        core_command.data,
        core_response.ready,
        run_command.valid,
        run_command.data,
        run_response.ready
    ]
);

const ROUNDS: usize = 4_000;

#[test]
fn run_gate_gives_each_word_to_one_side() {
    let mut random = SplitMix64::new(72);
    let mut block = Stepper::new("living_run_gate", RunGate::default(), 1);
    let mut begun = 0;
    for _ in 0..ROUNDS {
        let [valid, ready, is_active, awaits, core_takes, run_takes] = [(); 6].map(|()| flip(&mut random));
        let opcode = [0, 3, 7, 8, 9, 10, 11, 12, 13, 14, 0x88][random.below(11) as usize];
        let word = opcode << 24 | random.bits(24);
        block.set("command_valid", valid);
        block.set("command_data", word);
        block.set("response_ready", ready);
        block.set("is_active", is_active);
        block.set("awaits_command", awaits);
        block.set("core_command_ready", core_takes);
        block.set("run_command_ready", run_takes);
        let beats = ["core", "run"].map(|side| {
            let beat = (flip(&mut random), random.bits(62), flip(&mut random), flip(&mut random));
            block.set(&format!("{side}_response_valid"), beat.0);
            block.set(&format!("{side}_response_data"), beat.1);
            block.set(&format!("{side}_response_both"), beat.2);
            block.set(&format!("{side}_response_last"), beat.3);
            beat
        });
        block.settle();
        let begins = valid && awaits && !is_active && [8, 9, 10, 11, 12, 13].contains(&opcode);
        begun += usize::from(begins);
        block.expect("begins", begins);
        block.expect("opcode", opcode);
        block.expect("core_command_valid", valid && !is_active && !begins);
        block.expect("run_command_valid", valid && is_active);
        block.expect("core_command_data", word);
        block.expect("run_command_data", word);
        block.expect("command_ready", if is_active { run_takes } else { core_takes });
        let [core, run] = beats;
        let given = if run.0 && !core.0 { run } else { core };
        block.expect("response_valid", core.0 || run.0);
        block.expect("response_data", given.1);
        block.expect("response_both", given.2);
        block.expect("response_last", given.3);
        block.expect("core_response_ready", ready);
        block.expect("run_response_ready", ready && !core.0);
    }
    assert!(begun > ROUNDS / 100, "{begun} runs");
}
