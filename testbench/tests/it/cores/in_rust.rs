//! Runs the core's Rust behaviour beside its model. The memories here refuse accesses that are undefined in
//! silicon, for which Verilator has an order: a record read and written at one edge comes out poisoned, and a lock
//! set and cleared at one edge panics.

use incircle_hdl::top::Core;
use incircle_model::{ClockModel, Inputs, Record, Write};
use incircle_protocol::TINY;
use incircle_testbench::lockstep::{Job, Stalls};
use incircle_testkit::SplitMix64;
use rust_hdl_core::prelude::*;

/// Passes that the core may take to settle, far more than its depth.
const SETTLING_PASSES: usize = 200;

fn settle(core: &mut Core) {
    assert!(simulate(core, SETTLING_PASSES), "the core does not settle");
}

/// The core's write to its triangle memory: columns and data.
fn written(core: &Core) -> Write {
    let write = core.write.val();
    Write {
        valid: write.valid,
        id: write.id.to_u32(),
        vertices: write.vertices,
        links: [write.link0, write.link1, write.link2],
        record: Record {
            v: [write.v0, write.v1, write.v2].map(|column| column.to_u32()),
            n: [write.n0, write.n1, write.n2].map(|column| column.to_u32()),
        },
    }
}

#[test]
fn two_jobs_and_a_batch_clock_by_clock() {
    let mut core = Core::new(TINY).unwrap();
    core.connect_all();
    let mut model = ClockModel::new(TINY).unwrap();
    let points =
        [0x0000_0000, 0x0000_0009, 0x0009_0000, 0x0003_0003, 0x0009_0009, 0x0005_0001, 0x0003_0003, 0x0001_0008];
    let mut commands = Job::of(&points, 8, 0, TINY).commands;
    commands.extend(Job::of(&points[..5], 2, 1, TINY).commands);
    // Two jobs of three points, and one more point for each.
    let batch = [0, 9, 0x0009_0000, 0, 0x0005_0005, 0x0000_0005, 0x0003_0003, 0x0001_0003];
    commands.extend(Job::batch_of(&batch, 8, 0, TINY).commands);
    let mut rest = commands.as_slice();
    let (mut random, mut writes) = (SplitMix64::new(1), 0);
    for clock in 0..5500 {
        let reset = clock == 0;
        let inputs = Inputs { reset, ..Stalls { idle: 20, back_pressure: 20 }.inputs(rest, random.next_u64()) };
        core.clock.next = false.into();
        core.reset.next = inputs.reset;
        core.command.valid.next = inputs.command_valid;
        core.command.data.next = u64::from(inputs.command_data).into();
        core.response.ready.next = inputs.response_ready;
        settle(&mut core);
        let expected = model.outputs();
        if !reset {
            let found = (core.command.ready.val(), core.response.valid.val(), core.response.data.val().to_u64());
            let said = (expected.command_ready, expected.response_valid, expected.response_data);
            assert_eq!(found, said, "clock {clock}: {}", model.describe());
            let found = (core.response.both.val(), core.response.last.val());
            let said = (expected.response_both, expected.response_last);
            assert_eq!(found, said, "clock {clock}: {}", model.describe());
            assert_eq!(written(&core), expected.write, "clock {clock}: {}", model.describe());
            writes += usize::from(expected.write.valid);
        }
        if !reset && inputs.command_valid && expected.command_ready {
            rest = &rest[1..];
        }
        core.clock.next = true.into();
        settle(&mut core);
        model.clock(inputs);
    }
    assert!(rest.is_empty(), "{} words are left", rest.len());
    assert!(writes > 20, "only {writes} writes");
}
