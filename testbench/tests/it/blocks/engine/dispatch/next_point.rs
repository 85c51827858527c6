//! Runs `NextPoint` in Rust and in Verilog beside the rule by which points are dealt: all three must agree.

use crate::rig::stepper::bundles::Deal;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::NextPoint;
use incircle_protocol::MAX_CONTEXTS;

named_ports!(NextPoint, [deal, pointer, passed], [first, first_dealt, following]);

#[test]
fn next_point_deals_every_vertex_to_one_context() {
    const MOST: u64 = 16 * 24 + 100;
    let mut block = Stepper::new("next_point", NextPoint::default(), 1);
    for deal in (1..=u64::from(MAX_CONTEXTS)).flat_map(Deal::all) {
        let Deal { contexts, jobs, .. } = deal;
        block.set("deal", deal.bits());
        let mut takers = vec![0; MOST as usize];
        for turn in 0..contexts {
            let (team, is_first) = (turn % jobs, turn < jobs);
            for (port, value) in [("turn", turn), ("pointer_team", team), ("third", 3 * turn + 2)] {
                block.set(port, value);
            }
            block.set("pointer_is_first", is_first);
            block.set("passed_context", turn);
            block.set("passed_team", team);
            block.set("passed_is_first", is_first);
            let vertices: Vec<u64> = deal.dealt(turn).take_while(|vertex| *vertex < MOST + 50).collect();
            for (place, pair) in vertices.windows(2).filter(|pair| pair[0] < MOST).enumerate() {
                block.set("passed_id", pair[0]);
                let is_seed = is_first && place == 0;
                block.set("passed_is_seed", is_seed);
                block.set("passed_is_dealt", pair[0] >= 16 * jobs);
                // For other contexts the value is arbitrary.
                block.set("passed_dealt", if is_seed { pair[1] } else { pair[1] % 128 });
                block.settle();
                if place == 0 {
                    block.expect("first", vertices[0] | u64::from(is_first) << 15);
                }
                if is_seed {
                    block.expect("first_dealt", pair[1]);
                }
                block.expect("following_id", pair[1]);
                block.expect("first_record", 4 * team);
                takers[pair[0] as usize] += 1;
            }
        }
        // The first two points of a triple are taken with its third.
        let waits = |id: usize| id < 3 * jobs as usize && id % 3 != 2;
        assert!((0..MOST as usize).all(|id| takers[id] == usize::from(!waits(id))), "{deal:?}: {takers:?}");
        block.set("passed_is_seed", false);
        block.set("passed_is_dealt", true);
        for id in (1 << 14) - 40..1 << 14 {
            block.set("passed_id", id as u64);
            block.settle();
            block.expect("following_id", id as u64 + contexts);
        }
    }
}
