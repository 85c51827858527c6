//! Runs `StarId` in Rust and in Verilog beside plain lists: all three must agree in every clock.

use crate::rig::stepper::bundles::Edge;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::StarId;
use incircle_testkit::SplitMix64;

named_ports!(
    StarId,
    [head, first, current_is_last, inner_id, inner_is_used_up, fresh],
    [ahead, id, is_inner, is_fresh]
);

#[test]
fn star_id_takes_an_id_that_nobody_has() {
    let mut random = SplitMix64::new(20);
    let mut block = Stepper::new("star_id", StarId::default(), 1);
    for _ in 0..4_000 {
        let [head, first] = [(); 2].map(|()| Edge {
            first_vertex: random.below(1 << 15),
            outside_record: random.below(1 << 15),
            slot: random.below(3),
            cavity_record: random.below(1 << 15),
            after: random.below(64),
        });
        let [closes, has_gone, used_up] = [(); 3].map(|()| random.below(2) == 1);
        let (inner, fresh) = (random.below(1 << 15), random.below(1 << 15));
        for (port, edge) in [("head_entry", head), ("first", first)] {
            block.set(port, edge.entry());
        }
        block.set("head_shares", has_gone);
        block.set("current_is_last", closes);
        block.set("inner_id", inner);
        block.set("inner_is_used_up", used_up);
        block.set("fresh", fresh);
        let (ahead, id) = match (closes, has_gone, used_up) {
            (true, _, _) => (first, first.cavity_record),
            (false, false, _) => (head, head.cavity_record),
            (false, true, false) => (head, inner),
            (false, true, true) => (head, fresh),
        };
        block.settle();
        block.expect("ahead", ahead.entry());
        block.expect("id", id);
        block.expect("is_inner", !closes && has_gone && !used_up);
        block.expect("is_fresh", !closes && has_gone && used_up);
    }
}
