//! Runs `PlanTable` in Rust and in Verilog beside the rule by which points are dealt: all three must agree.

use crate::rig::stepper::bundles::Deal;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::PlanTable;
use incircle_protocol::LARGE;
use incircle_testkit::SplitMix64;

named_ports!(PlanTable, [deal, pointer, is_planned, passed, write], [due, first_dealt, following], clock);

/// Runs one job after another in one table, which is never cleared.
#[test]
fn plan_table_knows_what_each_context_takes_next() {
    let mut random = SplitMix64::new(82);
    let mut block = Stepper::new("plan_table", PlanTable::new(LARGE), 1);
    for deal in [24, 1, 16, 2, 3, 24].into_iter().flat_map(Deal::both) {
        block.set("deal", deal.bits());
        let mut rests: Vec<_> = (0..deal.contexts).map(|context| deal.dealt(context).peekable()).collect();
        for step in 0..40 * deal.contexts {
            let turn = step % deal.contexts;
            let next = *rests[turn as usize].peek().expect("points have no end");
            let is_seed = deal.is_batch && next == 3 * turn + 2;
            block.set("turn", turn);
            block.set("third", 3 * turn + 2);
            block.set("is_planned", step >= deal.contexts);
            block.set("write_valid", false);
            block.settle();
            block.expect("due", next | u64::from(is_seed) << 15);
            // A context takes its vertex while the pointer stands at another context, or at this one.
            let context = random.below(deal.contexts);
            let takes = step >= deal.contexts && random.below(2) == 0;
            if takes {
                let (taken, first_dealt) = (rests[context as usize].next().expect("one"), 3 * deal.contexts + context);
                let is_seed = deal.is_batch && taken == 3 * context + 2;
                let after = *rests[context as usize].peek().expect("points have no end");
                for (port, value) in [("passed_context", context), ("passed_id", taken), ("passed_dealt", first_dealt)]
                {
                    block.set(port, value);
                }
                block.set("passed_is_seed", is_seed);
                block.settle();
                block.expect("following_is_dealt", taken >= 16);
                block.expect("following_id", after);
                block.set("write_id", after);
            }
            block.set("write_context", context);
            block.set("write_valid", takes);
            block.settle();
            block.edge();
        }
    }
}
