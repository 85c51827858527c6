//! Runs `FrameSender` in Rust and in Verilog beside plain code: all three must agree.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::FrameSender;
use incircle_testkit::SplitMix64;

named_ports!(
    FrameSender,
    [reset, starts, contents, cuts, byte_data, sum_is_busy, word_byte_valid, word_byte_is_last, data_ready, ended],
    [at, loads, loads_word, data_valid, data, ends, is_cut, answer_ended, is_idle],
    clock
);

#[test]
fn sender_asks_for_the_bytes_of_a_frame_in_order() {
    let mut random = SplitMix64::new(7);
    let mut block = Stepper::new("serial_frame_sender", FrameSender::default(), 1);
    for port in ["starts", "cuts", "sum_is_busy", "word_byte_valid", "word_byte_is_last", "data_ready", "ended"] {
        block.set(port, false);
    }
    for port in ["has_greeting", "has_digest", "has_answer", "ends_answer"] {
        block.set(port, false);
    }
    block.set("byte_data", 0u8);
    block.set("reset", true);
    block.settle();
    block.edge();
    block.set("reset", false);
    for run in 0..120 {
        // Shapes of frames in turn: greeting, digest, answer, last part of an answer, and a frame without any of them.
        let shape = run % 5;
        let words = if shape == 2 || shape == 3 { 1 + random.below(30) as usize } else { 0 };
        let mut expected: Vec<(u64, u64)> = (0..7).map(|index| (0, index)).collect();
        expected.extend((0..52).filter(|_| shape == 0).map(|index| (1, index)));
        expected.extend((0..4).filter(|_| shape == 1).map(|index| (2, index)));
        expected.extend((0..3).filter(|_| words > 0).map(|index| (3, index)));
        expected.extend((0..words).map(|_| (4, 0)));
        expected.extend((0..4).filter(|_| shape == 3).map(|index| (2, index)));
        expected.extend((0..4).map(|index| (5, index)));
        let cut_at = (words > 0 && run % 3 == 0).then(|| random.below(expected.len() as u64) as usize);
        block.expect("is_idle", true);
        block.set("starts", true);
        block.settle();
        block.edge();
        block.set("starts", false);
        for (port, bit) in [
            ("has_greeting", shape == 0),
            ("has_digest", shape == 1),
            ("has_answer", words > 0),
            ("ends_answer", shape == 3),
        ] {
            block.set(port, bit);
        }
        let (mut taken, mut words_left) = (0, words);
        // The byte of a place comes two clocks later, and is a number made from the place.
        let mut pipe: VecDeque<u64> = VecDeque::from([0, 0]);
        let mut busy = 0u64;
        let (mut is_cut, mut has_come) = (false, false);
        loop {
            let cuts = cut_at == Some(taken) && !is_cut && random.below(8) == 0;
            let ready = random.below([1, 6][run % 2]) == 0;
            // A word that is there stays, as the packer's words do.
            has_come |= words > 0 && random.below(3) > 0;
            let has_word = words_left > 0 && has_come;
            for (port, bit) in [
                ("cuts", cuts),
                ("data_ready", ready),
                ("sum_is_busy", busy > 0),
                ("word_byte_valid", has_word),
                ("word_byte_is_last", words_left == 1),
            ] {
                block.set(port, bit);
            }
            block.set("byte_data", pipe[0]);
            block.settle();
            let (part, index) = (block.get("part") as u64, block.get("index") as u64);
            let place = if part == 4 { 0x80 + words_left as u64 } else { part << 4 ^ index };
            if block.is("loads") {
                busy = 9;
            }
            if block.is("loads_word") {
                assert!(block.is("loads") && part == 4);
                words_left -= 1;
            }
            if block.is("data_valid") && ready && !cuts && !is_cut {
                let (part, index) = expected[taken];
                let place = if part == 4 {
                    0x80 + (words - (taken - expected.iter().position(|place| place.0 == 4).expect("words"))) as u64
                } else {
                    part << 4 ^ index
                };
                block.expect("data", place & 0xff);
                taken += 1;
            }
            assert!(!is_cut || !block.is("data_valid"), "a frame offers a byte after it was cut");
            if block.is("ends") {
                assert_eq!((taken == expected.len(), block.is("is_cut")), (!is_cut, is_cut));
                break;
            }
            block.edge();
            pipe.pop_front();
            pipe.push_back(place & 0xff);
            busy = busy.saturating_sub(1);
            is_cut |= cuts;
        }
        block.set("cuts", false);
        for _ in 0..random.below(4) {
            block.settle();
            block.expect("ends", true);
            block.expect("answer_ended", false);
            block.edge();
        }
        block.set("ended", true);
        block.settle();
        block.expect("answer_ended", shape == 3 && !is_cut);
        block.edge();
        block.set("ended", false);
        block.settle();
    }
}
