//! Runs `WordNarrower` in Rust and in Verilog beside plain code: all three must agree.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::serial::WordNarrower;
use incircle_testkit::SplitMix64;

named_ports!(WordNarrower, [reset, pair_valid, pair, both, word_ready], [pair_ready, word_valid, word], clock);

#[test]
fn narrower_gives_every_word_once() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("serial_word_narrower", WordNarrower::default(), 1);
    let mut words: VecDeque<u32> = VecDeque::new();
    let (mut pair, mut pairs) = (None, 0);
    for clock in 0..8000 {
        let reset = clock == 0 || random.below(500) == 0;
        if pair.is_none() && random.below([1, 3][clock / 1000 % 2]) == 0 {
            pair = Some((random.next_u64() as u32, random.next_u64() as u32, random.below(2) == 0));
        }
        let (low, high, both) = pair.unwrap_or((1, 2, random.below(2) == 0));
        let ready = random.below([1, 3][clock / 2000 % 2]) == 0;
        for (port, bit) in [("reset", reset), ("pair_valid", pair.is_some()), ("both", both), ("word_ready", ready)] {
            block.set(port, bit);
        }
        block.set("pair", u64::from(low) | u64::from(high) << 32);
        block.settle();
        let is_empty = words.is_empty();
        if clock > 0 {
            block.expect("word_valid", !is_empty);
            block.expect("pair_ready", is_empty);
            if let Some(word) = words.front() {
                block.expect("word", *word);
            }
        }
        block.edge();
        if ready {
            words.pop_front();
        }
        if let Some((low, high, both)) = pair.take_if(|_| is_empty) {
            words.push_back(low);
            words.extend(both.then_some(high));
            pairs += u32::from(both);
        }
        if reset {
            words.clear();
        }
    }
    assert!(pairs > 500, "{pairs} pairs");
}

#[test]
fn narrower_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("serial_word_narrower", WordNarrower::default(), 1);
    block.set("reset", true);
    block.settle();
    block.edge();
    block.set("reset", false);
    let mut wave = Wave::default();
    let mut pairs = VecDeque::from([(5u64 | 6 << 32, true), (7, false)]);
    for clock in 0..8 {
        let (pair, both) = pairs.front().copied().unwrap_or_default();
        let (valid, ready) = (!pairs.is_empty(), clock != 1);
        block.set("pair", pair);
        for (port, bit) in [("pair_valid", valid), ("both", both), ("word_ready", ready)] {
            block.set(port, bit);
        }
        block.settle();
        let (is_taken, is_offered) = (block.is("pair_ready"), block.is("word_valid"));
        wave.take(&[
            ("pair_valid", Cell::Bit(valid)),
            ("both", Cell::Bit(both)),
            ("pair_ready", Cell::Bit(is_taken)),
            ("word", if is_offered { Cell::Number(block.get("word")) } else { Cell::Open }),
            ("word_valid", Cell::Bit(is_offered)),
            ("word_ready", Cell::Bit(ready)),
        ]);
        block.edge();
        if is_taken {
            pairs.pop_front();
        }
    }
    wave.assert_drawn_in("word_narrower");
}
