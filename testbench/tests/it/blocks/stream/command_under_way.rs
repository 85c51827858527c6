//! Runs `CommandUnderWay` in Rust and in Verilog beside plain code: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::stream_bits::set_bits;
use incircle_hdl::stream::CommandUnderWay;
use incircle_testkit::SplitMix64;

named_ports!([] CommandUnderWay, [reset, takes, word, offers_last, ends], [is_busy], clock);

#[test]
fn a_command_is_under_way_until_its_answer_has_ended_and_padding_is_none() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("command_under_way", CommandUnderWay::default(), 1);
    let clock = |block: &mut Stepper<CommandUnderWay>,
                 word: Option<u32>,
                 offers_last: bool,
                 ends: bool,
                 busy: Option<bool>| {
        set_bits(block, &[("reset", false), ("takes", word.is_some()), ("offers_last", offers_last), ("ends", ends)]);
        block.set("word", word.unwrap_or(9));
        block.settle();
        if let Some(busy) = busy {
            block.expect("is_busy", busy);
        }
        block.edge();
    };
    set_bits(&mut block, &[("reset", true)]);
    block.settle();
    block.edge();
    let mut is_busy = false;
    for _ in 0..500 {
        // Padding before a command, then its words, some of which are zero.
        if !is_busy {
            for _ in 0..random.below(4) {
                clock(&mut block, Some(0), false, false, Some(false));
            }
            clock(&mut block, Some(1 << 24), false, false, Some(false));
        }
        for _ in 0..random.below(5) {
            let word = [None, Some(0), Some(7)][random.below(3) as usize];
            clock(&mut block, word, false, false, Some(true));
        }
        // The last word of the answer waits; meanwhile padding or the next command is taken.
        let mut follows = false;
        for _ in 0..random.below(4) {
            let word = [None, Some(0), Some(2 << 24)][random.below(3) as usize];
            follows |= word.is_some_and(|word| word != 0);
            clock(&mut block, word, true, false, Some(true));
        }
        let word = [None, Some(0), Some(3 << 24)][random.below(3) as usize];
        follows |= word.is_some_and(|word| word != 0);
        clock(&mut block, word, true, true, Some(true));
        clock(&mut block, None, false, false, Some(follows));
        is_busy = follows;
    }
}
