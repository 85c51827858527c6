//! Runs `PlanTable` in Rust and in Verilog beside the rule by which points are dealt: all three must agree.

use crate::rig::stepper::bundles::Deal;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::PlanTable;
use incircle_protocol::LARGE;
use incircle_testkit::SplitMix64;

named_ports!(PlanTable, [deal, pointer, is_planned, passed, write], [shown, following], clock);

/// Runs one job after another in one table, which is never cleared.
#[test]
fn plan_table_knows_what_each_context_takes_next() {
    let mut random = SplitMix64::new(82);
    let mut block = Stepper::new("plan_table", PlanTable::new(LARGE), 1);
    for deal in [24, 1, 16, 2, 3, 24].into_iter().flat_map(Deal::all) {
        let Deal { contexts, jobs, .. } = deal;
        block.set("deal", deal.bits());
        let mut rests: Vec<_> = (0..contexts).map(|context| deal.dealt(context).peekable()).collect();
        let flags = |context: u64, vertex: u64| {
            let is_first = context < jobs;
            (is_first, is_first && vertex == 3 * context + 2, vertex >= 16 * jobs)
        };
        for step in 0..40 * contexts {
            let turn = step % contexts;
            let next = *rests[turn as usize].peek().expect("points have no end");
            let (is_first, is_seed, is_dealt) = flags(turn, next);
            for (port, value) in [("turn", turn), ("pointer_team", turn % jobs), ("third", 3 * turn + 2)] {
                block.set(port, value);
            }
            block.set("pointer_is_first", is_first);
            block.set("is_planned", step >= contexts);
            block.set("write_valid", false);
            block.settle();
            block.expect("shown_context", turn);
            block.expect("shown_team", turn % jobs);
            block.expect("shown_id", next);
            for (port, value) in
                [("shown_is_first", is_first), ("shown_is_seed", is_seed), ("shown_is_dealt", is_dealt)]
            {
                block.expect(port, value);
            }
            if is_seed {
                block.expect("shown_dealt", 3 * jobs + turn);
            }
            // A context takes its vertex while the pointer stands at another context, or at this one.
            let context = random.below(contexts);
            let takes = step >= contexts && random.below(2) == 0;
            if takes {
                let (taken, first_dealt) = (rests[context as usize].next().expect("one"), (3 * jobs + context) % 128);
                let (is_first, is_seed, is_dealt) = flags(context, taken);
                let after = *rests[context as usize].peek().expect("points have no end");
                for (port, value) in [
                    ("passed_context", context),
                    ("passed_team", context % jobs),
                    ("passed_id", taken),
                    ("passed_dealt", first_dealt),
                ] {
                    block.set(port, value);
                }
                block.set("passed_is_first", is_first);
                block.set("passed_is_seed", is_seed);
                block.set("passed_is_dealt", is_dealt);
                block.settle();
                block.expect("following_id", after);
                block.expect("first_record", 4 * (context % jobs));
                block.set("write_id", after);
            }
            block.set("write_context", context);
            block.set("write_valid", takes);
            block.settle();
            block.edge();
        }
    }
}
