//! Runs `LatePoints` in Rust and in Verilog beside a statement of the rules: all three must agree.

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::living::LatePoints;
use incircle_testkit::SplitMix64;

named_ports!(LatePoints, [reset, clears, has_changed, contexts, arrival, taken], [holds, dealt], clock);

#[test]
fn late_points_go_to_the_contexts_in_turn() {
    let mut random = SplitMix64::new(83);
    let mut block = Stepper::new("living_late_points", LatePoints::default(), 1);
    let (mut held, mut turn, mut dealt): (Option<[u64; 3]>, u64, usize) = (None, 0, 0);
    let mut contexts = 1;
    for clock in 0..6_000 {
        let (reset, clears) = (clock < 4, random.once_in(100));
        if reset || clears {
            contexts = 1 + random.below(24);
        }
        let [has_changed, takes] = [!random.once_in(4), flip(&mut random) && held.is_some()];
        let comes = held.is_none() && flip(&mut random);
        let (id, point) = (random.bits(15), random.bits(32));
        for (port, value) in [
            ("reset", reset),
            ("clears", clears),
            ("has_changed", has_changed),
            ("arrival_came", comes),
            ("taken", takes),
        ] {
            block.set(port, value);
        }
        block.set("contexts", contexts);
        block.set("arrival_id", id);
        block.set("arrival_point", point);
        block.settle();
        if clock >= 4 {
            block.expect("holds", held.is_some());
            block.expect("dealt_valid", held.is_some());
            if let Some([context, id, point]) = held {
                block.expect("dealt_context", context);
                block.expect("dealt_item_vertex", id);
                block.expect("dealt_item_place", point);
            }
        }
        block.edge();
        dealt += usize::from(takes);
        held = held.filter(|_| !takes);
        if comes && has_changed {
            held = Some([turn, id, point]);
            turn = (turn + 1) % contexts;
        }
        if reset || clears {
            (held, turn) = (None, 0);
        }
    }
    assert!(dealt > 500, "{dealt} points");
}
