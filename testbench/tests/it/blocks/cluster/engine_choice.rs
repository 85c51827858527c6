//! Runs `EngineChoice` in Rust and in Verilog beside a search: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::cluster::EngineChoice;
use incircle_testkit::SplitMix64;

named_ports!(EngineChoice, [reset, current, free, stuck], [target, has_target], clock);

/// The first engine behind `current` in a circle that is free, and not stuck unless all are.
fn choice(current: u32, free: u32, stuck: u32) -> Option<u32> {
    let order = [1, 2, 3, 4].map(|step| (current + step) % 4);
    order.into_iter().find(|engine| free >> engine & 1 == 1 && (stuck == 15 || stuck >> engine & 1 == 0))
}

#[test]
fn engine_choice_goes_round() {
    let mut random = SplitMix64::new(42);
    let mut block = Stepper::new("engine_choice", EngineChoice::default(), 1);
    let all = (0..4).flat_map(|current| (0..16).flat_map(move |free| (0..16).map(move |stuck| (current, free, stuck))));
    let mut cases: Vec<(u32, u32, u32)> = all.collect();
    random.shuffle(&mut cases);
    let mut before: Option<(bool, u32, u32, u32)> = None;
    for (current, free, stuck) in cases {
        let reset = random.below(8) == 0;
        block.set("reset", reset);
        block.set("current", current);
        block.set("free", free);
        block.set("stuck", stuck);
        block.settle();
        if let Some((reset, current, free, stuck)) = before {
            let expected = choice(current, free, stuck).filter(|_| !reset);
            block.expect("has_target", expected.is_some());
            if let Some(engine) = expected {
                block.expect("target", engine);
            }
        }
        block.edge();
        before = Some((reset, current, free, stuck));
    }
}
