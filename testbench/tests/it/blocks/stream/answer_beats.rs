//! Runs `AnswerBeats` in Rust and in Verilog beside plain code: all three must agree in every clock.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::stream_bits::set_bits;
use incircle_hdl::stream::AnswerBeats;
use incircle_testkit::SplitMix64;

named_ports!([const W: usize] AnswerBeats<W>,
    [reset, pair_valid, pair_data, pair_last, is_full], [is_stalled, beat_valid, beat_data, beat_last, is_held], clock);

fn collects<const W: usize>(name: &'static str) {
    let mut random = SplitMix64::new(4);
    let mut block = Stepper::new(name, AnswerBeats::<W>::new(), 1);
    let (mut half, mut expected): (Option<u64>, VecDeque<(u128, bool)>) = Default::default();
    let mut passed = 0;
    for clock in 0..12_000 {
        let reset = clock == 0 || random.below(1000) == 0;
        let (valid, is_last) = (random.below([1, 3][clock / 400 % 2]) == 0, random.below(4) == 0);
        let is_full = random.below([1, 3][clock / 800 % 2]) != 0;
        let pair = random.next_u64();
        set_bits(
            &mut block,
            &[("reset", reset), ("pair_valid", valid), ("pair_last", is_last), ("is_full", is_full && clock > 0)],
        );
        block.set("pair_data", pair);
        block.settle();
        let offered = expected.front().copied();
        let is_stalled = offered.is_some() && is_full;
        if clock > 0 {
            block.expect("beat_valid", offered.is_some());
            block.expect("is_stalled", is_stalled);
            block.expect("is_held", offered.is_some() || half.is_some());
            if let Some((beat, is_last)) = offered {
                block.expect("beat_data", beat);
                block.expect("beat_last", is_last);
            }
        }
        block.edge();
        if !is_stalled {
            passed += usize::from(expected.pop_front().is_some());
        }
        if valid && !is_stalled {
            let low = half.take();
            let beat = low.map_or(u128::from(pair), |low| u128::from(low) | u128::from(pair) << 64);
            if is_last || W == 64 || low.is_some() {
                expected.push_back((beat, is_last));
            } else {
                half = Some(pair);
            }
        }
        if reset {
            (half, expected) = Default::default();
        }
    }
    assert!(passed > 2000, "{passed} beats");
}

#[test]
fn pairs_become_beats() {
    collects::<64>("stream_answer_beats_64");
    collects::<128>("stream_answer_beats_128");
}
