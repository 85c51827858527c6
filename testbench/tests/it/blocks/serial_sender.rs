//! Frames towards the host: which, their parts, their headers. Rust, Verilog and plain code agree.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Stepper};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::export::QUICK_LINK;
use incircle_hdl::serial::{FrameBytes, FrameChoice, FrameHeader, FramePart, FrameSender, Greeting};
use incircle_protocol::{CORE_VERSION, SMALL};

named_ports!(FramePart, [at, word_byte_is_last], [is_last], clock);
named_ports!(
    FrameChoice,
    [is_idle, reply_is_due, reply_kind, answer_is_due, answer_is_last, holds, cuts], [starts, starts_reply, starts_answer, kind, contents],
    clock
);
named_ports!(
    FrameSender,
    [reset, starts, contents, cuts, byte_data, sum_is_busy, word_byte_valid, word_byte_is_last, data_ready, ended], [at, loads, loads_word, data_valid, data, ends, is_cut, answer_ended, is_idle],
    clock
);
named_ports!(
    FrameHeader,
    [reset, starts, open, answers, receipt, is_refused, is_busy, drops, kind, index], [byte_data, digest_taken],
    clock
);
named_ports!(
    FrameBytes,
    [part, index, ends_answer, header, greeting, word, answer, payload_state, answer_state, sum_state], [byte_data],
    clock
);
named_ports!(Greeting, [index], [byte_data], clock);

#[test]
fn choice_sends_replies_before_answers() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("serial_frame_choice", FrameChoice::default(), 1);
    let mut kind = None;
    let mut counts = [0; 2];
    for _ in 0..6000 {
        let reply_kind = [0x81, 0x82, 0x83, 0x84, 0x87, 0x88][random.below(6) as usize];
        let mut bit = |times| random.below(times) == 0;
        let (is_idle, reply, answer, last) = (bit(2), bit(3), bit(2), bit(2));
        let (holds, cuts) = (bit(3), bit(3));
        block.set("reply_kind", reply_kind as u32);
        for (port, bit) in [
            ("is_idle", is_idle),
            ("reply_is_due", reply),
            ("answer_is_due", answer),
            ("answer_is_last", last),
            ("holds", holds),
            ("cuts", cuts),
        ] {
            block.set(port, bit);
        }
        block.settle();
        let may = is_idle && !holds;
        let (starts_reply, starts_answer) = (may && reply, may && answer && !reply && !cuts);
        block.expect("starts_reply", starts_reply);
        block.expect("starts_answer", starts_answer);
        block.expect("starts", starts_reply || starts_answer);
        if let Some(kind) = kind {
            block.expect("kind", kind);
            block.expect("has_greeting", kind == 0x81);
            block.expect("has_digest", kind == 0x83 || kind == 0x84);
            block.expect("has_answer", kind == 0x85 || kind == 0x86);
            block.expect("ends_answer", kind == 0x86);
        }
        block.edge();
        counts[0] += usize::from(starts_reply);
        counts[1] += usize::from(starts_answer);
        if starts_reply {
            kind = Some(reply_kind as u64);
        }
        if starts_answer {
            kind = Some(if last { 0x86 } else { 0x85 });
        }
    }
    assert!(counts.iter().all(|count| *count > 200), "{counts:?}");
}

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
        // Greeting, digest, answer, last of an answer, and none of them.
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
        // The byte of a place comes two clocks later, as a number of the place.
        let mut pipe: VecDeque<u64> = VecDeque::from([0, 0]);
        let mut busy = 0u64;
        let mut is_cut = false;
        loop {
            let cuts = cut_at == Some(taken) && !is_cut && random.below(8) == 0;
            let ready = random.below([1, 6][run % 2]) == 0;
            let has_word = words_left > 0 && (words_left < words || random.below(3) > 0);
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
            assert!(!is_cut || !block.is("data_valid"), "a frame that was cut offers a byte");
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

#[test]
fn header_says_what_was_true_when_the_frame_began() {
    let mut random = SplitMix64::new(8);
    let mut block = Stepper::new("serial_frame_header", FrameHeader::default(), 1);
    let (mut header, mut digest, mut has_dropped) = ([0u8; 7], 0, false);
    for clock in 0..6000 {
        let [session, expected, answers, kind] = [0; 4].map(|_: u8| random.below(256) as u8);
        let (free, state) = (random.below(1 << 16) as u16, random.below(1 << 32) as u32);
        let [is_open, is_refused, is_busy] = [0; 3].map(|_: u8| random.below(2) == 0);
        let (starts, drops) = (clock == 1 || clock > 1 && random.below(9) == 0, random.below(12) == 0);
        let index = random.below(7) as usize;
        let reset = clock == 0;
        for (port, value) in [
            ("open_number", session.into()),
            ("expected", expected.into()),
            ("answers", answers.into()),
            ("kind", kind.into()),
            ("free", free.into()),
            ("digest", state),
            ("is_open", is_open.into()),
            ("is_refused", is_refused.into()),
            ("is_busy", is_busy.into()),
            ("starts", starts.into()),
            ("drops", drops.into()),
            ("reset", reset.into()),
            ("index", index as u32),
        ] {
            block.set(port, value);
        }
        block.settle();
        if clock > 1 {
            header[1] = kind;
            block.expect("byte_data", header[index]);
            block.expect("digest_taken", digest);
        }
        block.edge();
        if starts {
            let [low, high] = free.to_le_bytes();
            let status = [is_open, is_refused, has_dropped, is_busy]
                .iter()
                .rev()
                .fold(0, |status, bit| status << 1 | u8::from(*bit));
            (header, digest) = ([session, kind, expected, answers, low, high, status], state);
            has_dropped = false;
        }
        has_dropped = (has_dropped || drops) && !reset;
    }
}

#[test]
fn bytes_of_a_frame_come_from_their_parts() {
    let mut random = SplitMix64::new(9);
    let mut block = Stepper::new("serial_frame_bytes", FrameBytes::default(), 1);
    let mut expected = None;
    for _ in 0..4000 {
        let (part, index) = (random.below(6) as u32, random.below(4) as usize);
        let ends = random.below(2) == 0;
        let [header, greeting, word, answers, answer_part] = [0; 5].map(|_: u8| random.below(256) as u8);
        let [payload, answer, sum] = [0; 3].map(|_: u8| random.below(1 << 32) as u32);
        for (port, value) in [
            ("part", part),
            ("index", index as u32),
            ("ends_answer", ends.into()),
            ("header", header.into()),
            ("greeting", greeting.into()),
            ("word", word.into()),
            ("answer_number", answers.into()),
            ("answer_part", answer_part.into()),
            ("payload_state", payload),
            ("answer_state", answer),
            ("sum_state", sum),
        ] {
            block.set(port, value);
        }
        block.settle();
        if let Some(byte) = expected {
            block.expect("byte_data", byte);
        }
        block.edge();
        let first_word = u32::from(answer_part) * 256;
        expected = Some(match part {
            0 => header,
            1 => greeting,
            2 => (!if ends { answer } else { payload }).to_le_bytes()[index],
            3 if index < 3 => [answers, first_word as u8, (first_word >> 8) as u8][index],
            3 => answer_part,
            4 => word,
            _ => (!sum).to_le_bytes()[index],
        });
    }
}

#[test]
fn greeting_is_that_of_the_page() {
    let mut block = Stepper::new("serial_greeting", Greeting::new(SMALL, QUICK_LINK), 1);
    let words = [
        0x696e_436c,
        0x0001_0000,
        QUICK_LINK.clock_hz,
        QUICK_LINK.fifo_bytes,
        QUICK_LINK.clock_hz / 8,
        QUICK_LINK.silence_ms,
        0x696e_4369,
        0x0001_0002,
        CORE_VERSION,
        16,
        SMALL.points,
        SMALL.contexts,
        SMALL.ring,
    ];
    for index in 0..52 {
        block.set("index", index as u32);
        block.settle();
        block.edge();
        block.settle();
        block.expect("byte_data", words[index / 4].to_le_bytes()[index % 4]);
    }
}

#[test]
fn parts_of_a_frame_end_where_the_page_says() {
    let mut block = Stepper::new("serial_frame_part", FramePart::default(), 1);
    let lengths = [7, 52, 4, 3, 0, 4];
    for (part, length) in lengths.into_iter().enumerate() {
        for index in 0..52 {
            for word_byte_is_last in [false, true] {
                block.set("part", part as u32);
                block.set("index", index as u32);
                block.set("word_byte_is_last", word_byte_is_last);
                block.settle();
                block.edge();
                block.settle();
                block.expect("is_last", if part == 4 { word_byte_is_last } else { index + 1 == length });
            }
        }
    }
}
