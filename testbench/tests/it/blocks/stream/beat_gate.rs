//! Runs `BeatGate` in Rust and in Verilog beside plain code: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::stream_bits::set_bits;
use incircle_hdl::stream::BeatGate;
use incircle_testkit::SplitMix64;

named_ports!([const K: usize] BeatGate<K>, [reset, s_axis_tvalid, s_axis_tkeep, is_full], [push, events], clock);

#[test]
fn only_whole_beats_are_pushed() {
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new("stream_beat_gate", BeatGate::<8>::default(), 1);
    let mut events = [false; 3];
    let mut times_dropped = 0;
    for clock in 0..4000 {
        let reset = clock == 0 || random.below(200) == 0;
        let (valid, is_full) = (random.below(3) != 0, random.below(3) == 0);
        let keep = if random.below(4) == 0 { random.below(256) } else { 255 };
        set_bits(&mut block, &[("reset", reset), ("s_axis_tvalid", valid), ("is_full", is_full)]);
        block.set("s_axis_tkeep", keep);
        block.settle();
        block.expect("push", valid && keep == 255);
        if clock > 0 {
            for (port, event) in ["took", "waited", "dropped"].into_iter().zip(events) {
                block.expect(port, event);
            }
        }
        block.edge();
        events = [valid && !is_full, valid && is_full, valid && !is_full && keep != 255].map(|event| event && !reset);
        times_dropped += usize::from(events[2]);
    }
    assert!(times_dropped > 100);
}
