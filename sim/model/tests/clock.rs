//! The model clock by clock against the model by commands: same answers, same records, all locks released.

mod common;

use common::Random;
use incircle_model::{ClockModel, CommandModel, Inputs};
use incircle_protocol::{command_word, Config, Counter, Opcode, COUNTER_WORDS, SMALL, TINY};

/// Runs a command stream through the core; a side is stalled in one of `stall` clocks (0: never).
fn run(core: &mut ClockModel, commands: &[u32], answers: usize, random: &mut Random, stall: u32) -> Vec<u32> {
    let mut taken = Vec::new();
    let mut rest = commands;
    let mut clocks = 0;
    while taken.len() < answers || !rest.is_empty() {
        let outputs = core.outputs();
        let idle = stall != 0 && random.below(stall) == 0;
        let full = stall != 0 && random.below(stall) == 0;
        let inputs = Inputs {
            reset: false,
            command_valid: !rest.is_empty() && !idle,
            command_data: rest.first().copied().unwrap_or(0xdead_beef),
            response_ready: !full,
        };
        if inputs.command_valid && outputs.command_ready {
            rest = &rest[1..];
        }
        if inputs.response_ready && outputs.response_valid {
            taken.push(outputs.response_data);
        }
        core.clock(inputs);
        clocks += 1;
        assert!(clocks < 3_000_000, "stuck: {}", core.describe());
    }
    taken
}

fn job(points: &[u32], records: u32) -> Vec<u32> {
    let mut words = vec![command_word(Opcode::Clear), command_word(Opcode::Insert), points.len() as u32];
    words.extend(points);
    words.extend([command_word(Opcode::Read), 0, records, command_word(Opcode::Counters)]);
    words
}

fn compare(config: Config, random: &mut Random, core: &mut ClockModel, stall: u32) -> u32 {
    let mut model = CommandModel::new(16, config.points, config.ring).unwrap();
    let side = [3, 4, 5, 8, 40, 1 << 16][random.below(6) as usize];
    let count = 1 + random.below(config.points.min(300) + config.points.min(300) / 4);
    let points: Vec<u32> = (0..count).map(|_| random.below(side) | random.below(side) << 16).collect();
    model.send(&job(&points, 0));
    let records = model.mesh().records().len() as u32;
    let commands = job(&points, records);
    model.send(&commands);
    let mut expected = vec![0; 100_000];
    let skipped = model.receive(&mut expected[..2 + 7 + 2 + 2 + COUNTER_WORDS]);
    assert_eq!(skipped, 2 + 7 + 2 + 2 + COUNTER_WORDS);
    let length = model.receive(&mut expected);
    expected.truncate(length);
    let mut answers = run(core, &commands, length, random, stall);
    let counters = length - COUNTER_WORDS;
    for cycles in [Counter::InsertCycles, Counter::WaitCycles, Counter::ReadCycles] {
        answers[counters + cycles as usize] = 0;
    }
    assert_eq!(answers, expected, "points {points:x?}");
    model.mesh().counts().overflows
}

#[test]
fn answers_as_the_model_by_commands() {
    let mut random = Random(3);
    let mut alone = 0;
    for (config, jobs) in
        [(TINY, 800), (Config { ring: 3, ..SMALL }, 60), (Config { ring: 9, ..SMALL }, 60), (SMALL, 60)]
    {
        let mut core = ClockModel::new(config).unwrap();
        for job in 0..jobs {
            alone += compare(config, &mut random, &mut core, [0, 2, 5][job % 3]);
        }
    }
    assert!(alone > 3000, "{alone} insertions alone");
}
