//! Runs `WordPlace` in Rust and in Verilog beside commands whose words are counted: all three must agree.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::cluster::WordPlace;
use incircle_protocol::{command_word, Opcode, PADDING};
use incircle_testkit::SplitMix64;

named_ports!(WordPlace, [reset, word, passes], [begins, is_padding, is_clear], clock);

/// The words of a random command.
pub fn command(random: &mut SplitMix64) -> Vec<u32> {
    let low = random.next_u64() as u32 & 0x00ff_ffff;
    match random.below(8) {
        0 => vec![PADDING],
        1 => vec![command_word(Opcode::Clear) | low],
        2 => vec![(random.below(247) as u32 + 8) << 24 | low],
        3 => vec![command_word(Opcode::Read) | low, random.next_u64() as u32, random.next_u64() as u32],
        4 => vec![command_word(Opcode::Triangles), 0, 0x0200_0000],
        5 => vec![command_word(Opcode::Counters)],
        _ => {
            // Points may look like commands, and like padding.
            let points = random.below(5);
            let point = |random: &mut SplitMix64| [0, 0x0200_0000, random.next_u64() as u32][random.below(3) as usize];
            let points: Vec<u32> = (0..points).map(|_| point(random)).collect();
            [command_word(Opcode::Insert) | low, points.len() as u32].into_iter().chain(points).collect()
        }
    }
}

#[test]
fn word_place_finds_the_commands() {
    let mut random = SplitMix64::new(43);
    let mut block = Stepper::new("word_place", WordPlace::default(), 1);
    block.set("reset", true);
    block.settle();
    block.edge();
    block.set("reset", false);
    for _ in 0..3000 {
        let words = command(&mut random);
        let is_cut = random.below(100) == 0;
        for (place, &word) in words.iter().enumerate() {
            let mut passes = false;
            while !passes {
                passes = random.below(3) > 0;
                block.set("word", word);
                block.set("passes", passes);
                block.settle();
                let begins = place == 0;
                block.expect("begins", begins);
                block.expect("is_padding", begins && word == 0);
                block.expect("is_clear", begins && word >> 24 == 2);
                block.edge();
            }
            if is_cut && place == 1 {
                block.set("reset", true);
                block.settle();
                block.edge();
                block.set("reset", false);
                break;
            }
        }
    }
}
