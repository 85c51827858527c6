//! Runs `NextPoint` in Rust and in Verilog beside the rule by which points are dealt: all three must agree.

use crate::rig::stepper::bundles::Deal;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::NextPoint;
use incircle_protocol::MAX_CONTEXTS;

named_ports!(NextPoint, [deal, pointer, passed], [first, first_dealt, following]);

#[test]
fn next_point_deals_every_vertex_to_one_context() {
    let mut block = Stepper::new("next_point", NextPoint::default(), 1);
    for deal in (1..=u64::from(MAX_CONTEXTS)).flat_map(Deal::both) {
        let contexts = deal.contexts;
        block.set("deal", deal.bits());
        let mut takers = vec![0; 400];
        for turn in 0..contexts {
            block.set("turn", turn);
            block.set("third", 3 * turn + 2);
            block.set("passed_context", turn);
            let vertices: Vec<u64> = deal.dealt(turn).take_while(|vertex| *vertex < 450).collect();
            for (place, pair) in vertices.windows(2).filter(|pair| pair[0] < 400).enumerate() {
                block.set("passed_id", pair[0]);
                let is_seed = deal.is_batch && place == 0;
                block.set("passed_is_seed", is_seed);
                // For other contexts the value is arbitrary.
                block.set("passed_dealt", if is_seed { pair[1] } else { pair[1] % 128 });
                block.settle();
                if place == 0 {
                    block.expect("first", vertices[0] | u64::from(deal.is_batch) << 15);
                }
                if is_seed {
                    block.expect("first_dealt", pair[1]);
                }
                block.expect("following_is_dealt", pair[0] >= 16);
                block.expect("following_id", pair[1]);
                block.expect("first_record", if deal.is_batch { 4 * turn } else { 0 });
                takers[pair[0] as usize] += 1;
            }
        }
        // The first two points of a triple are taken with its third.
        let triples = if deal.is_batch { contexts as usize } else { 1 };
        let waits = |id: usize| id < 3 * triples && id % 3 != 2;
        assert!((0..400).all(|id| takers[id] == usize::from(!waits(id))), "{deal:?}: {takers:?}");
        block.set("passed_is_seed", false);
        for id in (1 << 14) - 40..1 << 14 {
            block.set("passed_id", id as u64);
            block.settle();
            block.expect("following_is_dealt", true);
            block.expect("following_id", id as u64 + contexts);
        }
    }
}
