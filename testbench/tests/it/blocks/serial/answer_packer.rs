//! Runs `AnswerPacker` in Rust and in Verilog beside plain code: all three must agree.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::AnswerPacker;
use incircle_testkit::SplitMix64;

named_ports!(
    AnswerPacker,
    [reset, word_valid, word_data, starts, takes, ended],
    [word_ready, is_due, is_last, answer, byte_valid, byte_data, byte_is_last, awaits],
    clock
);

/// Sends the parts of answers as frames would, and compares every byte.
#[test]
fn packer_cuts_answers_into_parts() {
    let mut random = SplitMix64::new(5);
    let mut block = Stepper::new("serial_answer_packer", AnswerPacker::default(), 1);
    let lengths = [0, 1, 253, 254, 255, 256, 510, 511, 3, 1030];
    let mut pending: VecDeque<u32> = VecDeque::new();
    let (mut offered, mut number, mut clock) = (None, 0u64, 0);
    // Sets the inputs of one clock, before its edge.
    let mut step =
        |block: &mut Stepper<AnswerPacker>, inputs: [bool; 4], random: &mut SplitMix64, more: Option<Vec<u32>>| {
            pending.extend(more.into_iter().flatten());
            for (port, bit) in ["reset", "starts", "takes", "ended"].into_iter().zip(inputs) {
                block.set(port, bit);
            }
            if offered.is_none() && random.below([1, 5][clock / 3000 % 2]) == 0 {
                offered = pending.pop_front();
            }
            clock += 1;
            block.set("word_valid", offered.is_some());
            block.set("word_data", offered.unwrap_or(0xffff_ffff));
            block.settle();
            if !inputs[0] && block.is("word_ready") {
                offered = None;
            }
            if inputs[0] {
                offered = None;
                pending.clear();
            }
        };
    step(&mut block, [true, false, false, false], &mut random, None);
    block.edge();
    for run in 0..40 {
        let length = lengths[run % lengths.len()];
        let mut words = vec![random.below(1 << 32) as u32, length];
        words.extend((0..length).map(|_| random.below(1 << 32) as u32));
        let mut more = Some(words.clone());
        let is_dropped = run % 13 == 12;
        let mut sent: Vec<u8> = Vec::new();
        let mut part = 0u64;
        'answer: loop {
            // Waits until a part is due.
            loop {
                step(&mut block, [false; 4], &mut random, more.take());
                let is_due = block.is("is_due");
                block.edge();
                if is_due {
                    break;
                }
            }
            for _ in 0..random.below(5) {
                step(&mut block, [false; 4], &mut random, None);
                assert!(block.is("is_due"));
                block.edge();
            }
            let left = words.len() - sent.len() / 4;
            step(&mut block, [false, true, false, false], &mut random, None);
            block.expect("is_last", left <= 256);
            block.expect("number", number % 256);
            block.expect("part", part % 256);
            block.edge();
            part += 1;
            for byte in 0..4 * left.min(256) {
                if is_dropped && sent.len() == 40.min(4 * words.len() - 1) {
                    step(&mut block, [true, false, false, false], &mut random, None);
                    block.edge();
                    number = 0;
                    break 'answer;
                }
                let mut waits = random.below([1, 4][run % 2]);
                loop {
                    // `takes` follows the byte within the clock.
                    step(&mut block, [false; 4], &mut random, None);
                    let takes = block.is("byte_valid") && waits == 0;
                    waits = waits.saturating_sub(1);
                    if takes {
                        block.set("takes", true);
                        block.settle();
                        sent.push(block.get("byte_data") as u8);
                        block.expect("byte_is_last", byte + 1 == 4 * left.min(256));
                    }
                    block.edge();
                    if takes {
                        break;
                    }
                }
            }
            if left <= 256 {
                break;
            }
        }
        if is_dropped {
            continue;
        }
        let expected: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        assert!(sent == expected, "an answer of {length} words");
        for _ in 0..3 + random.below(9) {
            step(&mut block, [false; 4], &mut random, None);
            assert!(!block.is("byte_valid") && !block.is("is_due") && !block.is("awaits"));
            block.edge();
        }
        step(&mut block, [false, false, false, true], &mut random, None);
        block.edge();
        number += 1;
        step(&mut block, [false; 4], &mut random, None);
        assert!(block.is("awaits"));
        block.expect("number", number % 256);
        block.edge();
    }
}
