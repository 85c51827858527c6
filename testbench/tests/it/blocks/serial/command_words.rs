//! Runs `CommandWords` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::serial::CommandWords;
use incircle_testkit::SplitMix64;

named_ports!(CommandWords, [reset, byte_valid, byte_data, word_ready], [takes, word_valid, word], clock);

#[test]
fn command_words_are_put_together_low_byte_first() {
    let mut random = SplitMix64::new(3);
    let mut block = Stepper::new("serial_command_words", CommandWords::default(), 1);
    let mut bytes: Vec<u8> = Vec::new();
    let mut words = 0;
    for clock in 0..8000 {
        let reset = clock == 0 || random.below(700) == 0;
        let (valid, ready) = (random.below([1, 4][clock / 400 % 2]) == 0, random.below([1, 9][clock / 800 % 2]) == 0);
        let byte = random.below(256) as u8;
        block.set("byte_data", byte);
        for (port, bit) in [("reset", reset), ("byte_valid", valid), ("word_ready", ready)] {
            block.set(port, bit);
        }
        block.settle();
        let is_full = bytes.len() == 4;
        if clock > 0 {
            block.expect("word_valid", is_full);
            block.expect("takes", valid && !is_full);
            if is_full {
                block.expect("word", u32::from_le_bytes(bytes[..].try_into().expect("four bytes")));
            }
        }
        block.edge();
        if is_full && ready {
            bytes.clear();
            words += 1;
        }
        if valid && !is_full {
            bytes.push(byte);
        }
        if reset {
            bytes.clear();
        }
    }
    assert!(words > 200, "{words} words");
}

#[test]
fn command_words_show_the_wave_of_their_header() {
    let mut block = Stepper::new("serial_command_words", CommandWords::default(), 1);
    let mut wave = Wave::default();
    let mut bytes = [5u8, 0, 0, 0, 7, 0].into_iter().peekable();
    for clock in 0..14 {
        let valid = clock > 0;
        block.set("reset", clock == 0);
        block.set("byte_valid", valid);
        block.set("byte_data", *bytes.peek().unwrap_or(&0));
        block.set("word_ready", clock >= 7);
        block.settle();
        let (takes, gives) = (valid && block.is("takes"), clock > 0 && block.is("word_valid"));
        wave.take(&[
            ("byte_valid", Cell::Bit(valid)),
            ("byte_data", bytes.peek().map_or(Cell::Open, |byte| Cell::Number((*byte).into()))),
            ("takes", Cell::Bit(takes)),
            ("word_valid", Cell::Bit(gives)),
            ("word_ready", Cell::Bit(clock >= 7)),
            ("word", if gives { Cell::Number(block.get("word")) } else { Cell::Open }),
        ]);
        block.edge();
        if takes {
            bytes.next();
        }
        if bytes.peek().is_none() {
            break;
        }
    }
    wave.assert_drawn_in("command_words");
}
