//! Tells in Rust and in Verilog what questions must know of the core: both must agree with the rule.

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::living::StandingView;
use incircle_testkit::SplitMix64;

named_ports!(StandingView, [awaits_command, clearing, deal, state, engine], [standing]);

#[test]
fn standing_view_knows_whether_there_is_a_mesh() {
    let mut random = SplitMix64::new(73);
    let mut block = Stepper::new("living_standing_view", StandingView::default(), 1);
    let mut meshes = 0;
    for _ in 0..2_000 {
        let [awaits, clears, stuck] = [(); 3].map(|()| flip(&mut random));
        let (tag, engine, contexts) = (random.bits(8), random.bits(8), random.bits(5));
        let jobs = 1 + random.below(3);
        let records = random.below(3) * random.below(1 << 14);
        block.set("awaits_command", awaits);
        block.set("clearing_clears", clears);
        block.set("clearing_tag", tag);
        block.set("deal_contexts", contexts);
        block.set("deal_jobs", jobs);
        block.set("state_records", records);
        block.set("state_stuck", stuck);
        block.set("engine", engine);
        block.settle();
        let has_mesh = records > 0 && jobs == 1 && !stuck;
        meshes += usize::from(has_mesh);
        block.expect("standing_awaits_command", awaits);
        block.expect("standing_clears", clears);
        block.expect("standing_tag", tag);
        block.expect("standing_engine", engine);
        block.expect("standing_contexts", contexts);
        block.expect("standing_has_mesh", has_mesh);
    }
    assert!(meshes > 100, "{meshes} meshes");
}
