//! The context: Rust, Verilog and stories of points agree clock by clock. A story is written as a whole before it is played: what
//! the surroundings do in each clock, and what the context must show.

mod block_ports;
mod context_stories;
mod stepper;

use context_stories::{Author, Row, EVENTS, INFINITE, PHASES, QUIET};
use incircle_hdl::engine::Context;
use stepper::bundles::turned;
use stepper::{named_ports, Stepper};

named_ports!(
    Context,
    [
        reset,
        infinite,
        clears,
        point_valid,
        point_id,
        point,
        done,
        token,
        turned,
        verdict,
        split,
        split_bundle,
        overflows,
        nothing_is_out,
        commit_ends,
        takes_fresh,
        solo_push,
        solo_bundle,
        solo_ends,
        locks_are_held
    ],
    [
        takes_point,
        is_idle,
        is_root,
        is_cavity,
        is_drain,
        is_commit,
        is_solo,
        root_visits,
        p,
        position,
        root_id,
        root,
        records,
        seeded,
        collinear,
        seeds,
        drained,
        walk_visit,
        duplicate,
        push,
        bundle,
        write
    ],
    clock
);

fn play(block: &mut Stepper<Context>, row: &Row, noise: &mut Author) {
    for port in QUIET {
        block.set(port, false);
    }
    let noisy = [
        ("point_id", noise.id().into()),
        ("point", noise.random.below(1 << 32).into()),
        ("token", noise.visit().token()),
        ("turned", turned([noise.id(); 3], [noise.id(); 3], 3, true, [true; 3])),
        ("verdict", noise.finding().verdict()),
        ("split_bundle", noise.bundle()),
        ("solo_bundle", noise.bundle()),
    ];
    for (port, value) in noisy.iter().chain(&row.inputs) {
        block.set(port, *value);
    }
    block.settle();
    for (port, expected) in &row.outputs {
        block.expect(port, *expected);
    }
    block.expect("push", row.push.is_some());
    if let Some(push) = row.push {
        block.expect_masked("bundle", push.mask, push.bundle & push.mask);
    }
    match row.write {
        Some(write) => block.expect("write", write),
        None => block.expect_masked("write", 1, 0u128),
    }
    block.edge();
}

#[test]
fn context_follows_every_story() {
    let mut block = Stepper::new("insertion_context", Context::default(), 1);
    let (mut author, mut noise) = (Author::new(), Author::new());
    block.set("infinite", INFINITE);
    block.set("reset", true);
    block.settle();
    block.edge();
    let mut seen = std::collections::BTreeMap::new();
    while block.clocks() < 12_000 {
        let is_broken = author.random.below(25) == 0;
        let rows = if is_broken { author.broken_story() } else { author.story() };
        for row in &rows {
            for (name, value) in row.outputs.iter().filter(|(name, _)| PHASES.contains(name) || EVENTS.contains(name)) {
                *seen.entry(*name).or_insert(0) += *value;
            }
            play(&mut block, row, &mut noise);
        }
    }
    // Every phase and event has been there often.
    assert!(seen.values().all(|times| *times >= 5), "{seen:?}");
}
