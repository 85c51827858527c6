//! Runs `RecordWords` in Rust and in Verilog beside a statement of the rule: all three must agree over random inputs.

use crate::rig::stepper::bundles::flip;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::RecordWords;
use incircle_protocol::{Layout, CORE_COORD_BITS, MAX_POINTS};
use incircle_testkit::SplitMix64;

named_ports!(RecordWords, [record], [word0, word1, word2]);

const ROUNDS: usize = 4000;

#[test]
fn record_words_are_those_of_the_protocol() {
    let mut random = SplitMix64::new(24);
    let mut block = Stepper::new("record_words", RecordWords::default(), 1);
    let layout = Layout::of(CORE_COORD_BITS, MAX_POINTS);
    for _ in 0..ROUNDS {
        let columns = [(); 6].map(|()| [0, 0x7fff, random.below(1 << 15)][random.below(3) as usize] as u32);
        let [v0, v1, v2, n @ ..] = columns;
        let lock = flip(&mut random);
        for (port, value) in ["v0", "v1", "v2", "n0", "n1", "n2"].into_iter().zip(columns) {
            block.set(port, value);
        }
        block.set("was_set", lock);
        block.settle();
        let words = layout.record_to_words([v0, v1, v2], n, lock);
        for (port, word) in ["word0", "word1", "word2"].into_iter().zip(words) {
            block.expect(port, word);
        }
    }
}
