//! Runs `MovedVertex` in Rust and in Verilog beside a list of the items of the contexts: all three must agree.

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::MovedVertex;
use incircle_protocol::{Config, TINY};
use incircle_testkit::SplitMix64;

named_ports!(
    MovedVertex,
    [deletes, moving, start, early, ends_in_place],
    [early_finds, finds, moves, stays, arrival],
    clock
);

/// The item of a context: its vertex, its new place, and whether it returns or stays.
#[derive(Clone, Copy, Debug)]
struct Item {
    vertex: u64,
    target: u64,
    returns: bool,
    stays: bool,
}

#[test]
fn visits_of_moves_are_told_apart_by_their_items() {
    let mut random = SplitMix64::new(94);
    let mut block = Stepper::new("moved_vertex", MovedVertex::new(Config { contexts: 8, ..TINY }), 1);
    let mut items: [Option<Item>; 8] = [None; 8];
    // What the visit of the clock before was: one of a deletion, one of a move, and its item.
    let mut last: Option<(bool, bool, Item)> = None;
    let mut seen = [0; 4];
    for _ in 0..6_000 {
        // A run of deletions, of moves, or another one.
        let [deletes, runs] = [[true, false], [false, true], [false, false]][random.below(3) as usize];
        let context = random.below(8) as usize;
        let known = items[context].filter(|_| !random.once_in(8));
        block.set("deletes", deletes);
        block.set("moving_runs", runs);
        block.set("early_done", known.is_some());
        block.set("early_visit_context", context as u64);
        let taker = random.below(8) as usize;
        let item = Item {
            vertex: random.bits(15),
            target: random.bits(32),
            returns: flip(&mut random),
            stays: flip(&mut random),
        };
        let takes = random.once_in(3);
        block.set("start_takes", takes);
        block.set("start_context", taker as u64);
        block.set("start_id", item.vertex);
        block.set("moving_target", item.target);
        block.set("moving_returns", item.returns);
        block.set("moving_stays", item.stays);
        let ends = flip(&mut random);
        block.set("ends_in_place", ends);
        block.settle();
        block.expect("arrival_came", ends);
        if let Some((finds, moves, item)) = last {
            block.expect("finds", finds);
            block.expect("moves", moves);
            block.expect("stays", item.stays);
            block.expect("arrival_id", item.vertex);
            block.expect("arrival_point", item.target);
            seen[usize::from(finds) + 2 * usize::from(moves)] += 1;
        }
        last = known.map(|item| (deletes || runs && !item.returns, runs && !item.returns, item));
        if let Some((finds, ..)) = last {
            block.expect("early_finds", finds);
        }
        block.edge();
        if takes {
            items[taker] = Some(item);
        }
    }
    assert!(seen[0] > 1_000 && seen[1] > 1_000 && seen[3] > 500, "{seen:?}");
}
