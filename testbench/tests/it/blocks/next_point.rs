//! Which vertex a context takes next: Rust, Verilog and the rule by which points are dealt agree.

use crate::rig::stepper::bundles::Deal;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{NextPoint, PlanTable};
use incircle_protocol::{LARGE, MAX_CONTEXTS};

named_ports!(
    NextPoint,
    [deal, turn, third, taker, taken, took_seed, taken_dealt],
    [first, first_dealt, taken_is_dealt, after_taken, first_record]
);
named_ports!(
    PlanTable,
    [deal, turn, third, is_planned, taker, taken, took_seed, taken_dealt, takes, owner, planned],
    [due, first_dealt, taken_is_dealt, after_taken, first_record],
    clock
);

#[test]
fn next_point_deals_every_vertex_to_one_context() {
    let mut block = Stepper::new("next_point", NextPoint::default(), 1);
    for deal in (1..=u64::from(MAX_CONTEXTS)).flat_map(Deal::both) {
        let contexts = deal.contexts;
        block.set("deal", deal.bits());
        let mut owners = vec![0; 400];
        for turn in 0..contexts {
            block.set("turn", turn);
            block.set("third", 3 * turn + 2);
            block.set("taker", turn);
            let vertices: Vec<u64> = deal.dealt(turn).take_while(|vertex| *vertex < 450).collect();
            for (place, pair) in vertices.windows(2).filter(|pair| pair[0] < 400).enumerate() {
                block.set("taken", pair[0]);
                let is_seed = deal.is_batch && place == 0;
                block.set("took_seed", is_seed);
                // Of others it is anything.
                block.set("taken_dealt", if is_seed { pair[1] } else { pair[1] % 128 });
                block.settle();
                if place == 0 {
                    block.expect("first", vertices[0] | u64::from(deal.is_batch) << 15);
                }
                if is_seed {
                    block.expect("first_dealt", pair[1]);
                }
                block.expect("taken_is_dealt", pair[0] >= 16);
                block.expect("after_taken", pair[1]);
                block.expect("first_record", if deal.is_batch { 4 * turn } else { 0 });
                owners[pair[0] as usize] += 1;
            }
        }
        // The first two of a triple are taken with its third.
        let triples = if deal.is_batch { contexts as usize } else { 1 };
        let waits = |id: usize| id < 3 * triples && id % 3 != 2;
        assert!((0..400).all(|id| owners[id] == usize::from(!waits(id))), "{deal:?}: {owners:?}");
        block.set("took_seed", false);
        for id in (1 << 14) - 40..1 << 14 {
            block.set("taken", id as u64);
            block.settle();
            block.expect("taken_is_dealt", true);
            block.expect("after_taken", id as u64 + contexts);
        }
    }
}

/// One job after the other in one table, of which nothing is cleared.
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
            block.set("takes", false);
            block.settle();
            block.expect("due", next | u64::from(is_seed) << 15);
            // Some context takes its vertex while the pointer stands at another one, or at itself.
            let owner = random.below(deal.contexts);
            let takes = step >= deal.contexts && random.below(2) == 0;
            if takes {
                let (taken, first_dealt) = (rests[owner as usize].next().expect("one"), 3 * deal.contexts + owner);
                let is_seed = deal.is_batch && taken == 3 * owner + 2;
                let after = *rests[owner as usize].peek().expect("points have no end");
                for (port, value) in [("taker", owner), ("taken", taken), ("taken_dealt", first_dealt)] {
                    block.set(port, value);
                }
                block.set("took_seed", is_seed);
                block.settle();
                block.expect("taken_is_dealt", taken >= 16);
                block.expect("after_taken", after);
                block.set("planned", after);
            }
            block.set("owner", owner);
            block.set("takes", takes);
            block.settle();
            block.edge();
        }
    }
}
