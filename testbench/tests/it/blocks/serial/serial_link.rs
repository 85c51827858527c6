//! Runs the whole serial link, with pins on one side and a stand-in for the core on the other: Rust and Verilog must
//! agree and keep the rules of the protocol's page.

use crate::rig::serial_host::crc32;
use crate::rig::serial_rig::{answer_of, opened, payload, Pins, Rig, Verilog, SESSION};
use crate::rig::stepper::Stepper;
use incircle_blocks::QUICK_LINK;
use incircle_hdl::serial::SerialLink;
use incircle_protocol::{DeviceFrame, HostFrame, LINK_MAGIC, MAX_STEP, SMALL, STATUS_BUSY, STATUS_OPEN};

fn greets_and_answers(pins: impl Pins) {
    let mut rig = Rig::new(pins);
    rig.say(0, HostFrame::Hello, 0, &[]);
    let hello = rig.hear(DeviceFrame::Hello);
    assert_eq!((hello.session, hello.status), (0, 0));
    let words = hello.words();
    assert_eq!(words.len(), 13);
    let link = QUICK_LINK;
    assert_eq!(
        words[..6],
        [LINK_MAGIC, 0x0001_0000, link.clock_hz, link.fifo_bytes, link.clock_hz / 8, link.silence_ms]
    );
    assert_eq!(
        (words[6], words[10], words[11], words[12]),
        (0x696e_4369, SMALL.points, 1 << 8 | SMALL.contexts, 2 << 16 | SMALL.ring)
    );
    rig.open();
    rig.data(0, &[0x0100_0003]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.session, ack.expected, ack.answers), (SESSION, 1, 0));
    assert_eq!(ack.words(), [crc32(&0x0100_0003u32.to_le_bytes())]);
    assert_eq!(rig.answer(0), answer_of(0x0100_0003));
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.expected, ack.answers, ack.status), (1, 1, STATUS_OPEN));
    rig.say(SESSION, HostFrame::Close, 0, &[]);
    let closed = rig.hear(DeviceFrame::Closed);
    assert_eq!((closed.session, closed.status), (0, 0));
}

#[test]
fn link_greets_and_answers_in_both_forms() {
    let link = SerialLink::new(SMALL, QUICK_LINK).map_err(|error| format!("{error:?}")).expect("a sound configuration");
    greets_and_answers(Stepper::new("serial_link", link, 1));
}

#[test]
fn link_greets_and_answers() {
    greets_and_answers(Verilog::new(3));
}

#[test]
fn without_a_session_nothing_but_a_greeting_is_to_be_had() {
    let mut rig = Rig::new(Verilog::new(1));
    for kind in [HostFrame::Poll, HostFrame::Close] {
        rig.say(SESSION, kind, 0, &[]);
        let frame = rig.hear(DeviceFrame::NoSession);
        assert_eq!((frame.session, frame.status, frame.body.len()), (0, 0, 0));
    }
    rig.say(SESSION, HostFrame::Rate, 0, &MAX_STEP.to_le_bytes());
    rig.hear(DeviceFrame::NoSession);
    rig.data(0, &[1, 2, 3]);
    rig.hear(DeviceFrame::NoSession);
    // None of these frames may have reached the core.
    rig.open();
    rig.wait(2000);
    assert!(rig.core.taken.is_empty(), "{:x?}", rig.core.taken);
    // During a session, frames of another session are dropped.
    for kind in [HostFrame::Poll, HostFrame::Close] {
        rig.say(SESSION ^ 1, kind, 0, &[]);
    }
    rig.say(SESSION ^ 1, HostFrame::Data, 0, &[0; 8]);
    rig.nothing_comes(5000);
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.expected, ack.status, ack.words()), (0, STATUS_OPEN, vec![0]));
}

#[test]
fn a_gap_gives_one_nak_and_repeats_give_acks() {
    let mut rig = opened(3);
    rig.data(1, &[1 << 24]);
    assert_eq!(rig.hear(DeviceFrame::Nak).expected, 0);
    rig.data(2, &[1 << 24]);
    rig.data(3, &[1 << 24]);
    rig.nothing_comes(9000);
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    assert_eq!(rig.hear(DeviceFrame::Nak).expected, 0);
    rig.data(0, &[5 << 24]);
    assert_eq!(rig.hear(DeviceFrame::Ack).expected, 1);
    assert_eq!(rig.answer(0), [5 << 24, 0]);
    rig.data(0, &[6 << 24]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.expected, ack.words()), (1, vec![crc32(&payload(&[5 << 24]))]));
    rig.nothing_comes(5000);
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    rig.hear(DeviceFrame::Ack);
    assert_eq!(rig.core.taken, [5 << 24]);
    // All 256 numbers of frames are used, and the numbers wrap.
    for number in 1..=300u32 {
        rig.data(number as u8, &[number << 24 >> 8]);
        let ack = rig.hear_within(40_000).expect("an Ack or the end of an answer");
        assert!(ack.kind == DeviceFrame::Ack as u8, "{ack:x?}");
        assert_eq!(ack.expected, (number + 1) as u8);
        assert_eq!(rig.answer(number as u8)[0], number << 24 >> 8);
    }
}

#[test]
fn credit_is_what_the_fifo_has_and_no_more_is_taken() {
    let mut rig = opened(4);
    // The core takes next to nothing, so the FIFO fills.
    rig.core.pace = 1 << 40;
    let words = [0x1100_0000u32; 256];
    let mut number = 0;
    let mut left = QUICK_LINK.fifo_bytes;
    loop {
        rig.data(number, &words);
        let frame = rig.hear_within(200_000).expect("a receipt");
        // One word may stand outside the FIFO.
        let free = u32::from(frame.free);
        assert!((left.saturating_sub(1024)..=left.saturating_sub(1024) + 4).contains(&free) || frame.kind == 0x84);
        if frame.kind == DeviceFrame::Nak as u8 {
            assert_eq!((frame.expected, free < 1024), (number, true));
            break;
        }
        assert_eq!((frame.kind, frame.expected), (DeviceFrame::Ack as u8, number + 1));
        (number, left) = (number + 1, free);
    }
    assert_eq!(number, 2);
    // The link takes as much as there is room for, and the answers come when the core goes on.
    rig.data(number, &words[..left as usize / 4]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.expected, ack.free), (number + 1, 0));
    rig.core.pace = 1;
    for answer in 0..512 + left / 4 {
        assert_eq!(rig.answer(answer as u8), [0x1100_0000, 0]);
    }
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((u32::from(ack.free), ack.status), (QUICK_LINK.fifo_bytes, STATUS_OPEN));
}

#[test]
fn long_answers_come_in_parts_and_receipts_go_between_them() {
    let mut rig = opened(5);
    let command = 0x2200_0000 | 700;
    rig.data(0, &[command]);
    assert_eq!(rig.hear(DeviceFrame::Ack).status, STATUS_OPEN);
    let mut bytes = Vec::new();
    for (kind, index, words) in [(DeviceFrame::Answer, 0u16, 256), (DeviceFrame::Answer, 256, 256)] {
        rig.say(SESSION, HostFrame::Poll, 0, &[]);
        let part = rig.hear(kind);
        assert_eq!((part.body[0], part.body.len(), part.status), (0, 3 + 4 * words, STATUS_OPEN | STATUS_BUSY));
        assert_eq!(part.body[1..3], index.to_le_bytes());
        bytes.extend(&part.body[3..]);
        let ack = rig.hear(DeviceFrame::Ack);
        assert_eq!((ack.answers, ack.status), (0, STATUS_OPEN | STATUS_BUSY));
    }
    let part = rig.hear(DeviceFrame::AnswerEnd);
    let (words, digest) = part.body[3..].split_last_chunk::<4>().expect("a digest");
    bytes.extend(words);
    assert_eq!(bytes, payload(&answer_of(command)));
    assert_eq!(u32::from_le_bytes(*digest), crc32(&bytes));
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.answers, ack.status), (1, STATUS_OPEN));
}

#[test]
fn an_opening_cuts_an_answer_and_resets_the_core() {
    let mut rig = opened(6);
    for length in [300u32, 3, 1000] {
        rig.data(0, &[0x3300_0000 | length, 0x4400_0000, 0x5500_0000]);
        rig.hear(DeviceFrame::Ack);
        rig.wait(1500);
        let resets = rig.core.resets;
        rig.talker.say(&[0]);
        rig.say(SESSION ^ 7, HostFrame::Open, 0, &[]);
        // A frame that was under way is cut, unless it was whole before.
        let mut frame = rig.hear_within(300_000).expect("a frame");
        while frame.kind != DeviceFrame::Opened as u8 {
            assert_eq!(frame.session, SESSION, "{frame:x?}");
            frame = rig.hear_within(300_000).expect("a frame");
        }
        assert_eq!((frame.session, frame.expected, frame.answers, frame.status), (SESSION ^ 7, 0, 0, STATUS_OPEN));
        assert_eq!(u32::from(frame.free), QUICK_LINK.fifo_bytes);
        assert!(rig.core.resets > resets, "the core was not reset");
        rig.nothing_comes(3000);
        assert!(rig.core.taken.is_empty(), "{:x?}", rig.core.taken);
        rig.open();
        rig.data(0, &[0x6600_0002]);
        assert_eq!(rig.hear(DeviceFrame::Ack).words(), [crc32(&payload(&[0x6600_0002]))]);
        assert_eq!(rig.answer(0), answer_of(0x6600_0002));
        rig.open();
    }
}

#[test]
fn replies_come_in_their_order_and_an_ack_stands_for_many() {
    let mut rig = opened(9);
    rig.data(0, &[0x0100_0000 | 400]);
    rig.hear(DeviceFrame::Ack);
    rig.wait(600);
    // Several commands are sent while a part of the answer is on the line.
    for number in 1..5 {
        rig.data(number, &[0x0200_0000]);
    }
    rig.say(SESSION, HostFrame::Hello, 0, &[]);
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    rig.hear(DeviceFrame::Answer);
    rig.hear(DeviceFrame::Hello);
    assert_eq!(rig.hear(DeviceFrame::Ack).expected, 5);
    rig.hear(DeviceFrame::AnswerEnd);
    for answer in 1..5 {
        assert_eq!(rig.answer(answer), [0x0200_0000, 0]);
    }
    rig.nothing_comes(3000);
    // The reply to a close goes before everything that was due to the session, which is forgotten.
    rig.data(5, &[0x0300_0000 | 250]);
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    rig.say(SESSION, HostFrame::Close, 0, &[]);
    let mut frame = rig.hear_within(300_000).expect("a frame");
    while frame.kind != DeviceFrame::Closed as u8 {
        frame = rig.hear_within(300_000).expect("a frame");
    }
    assert_eq!(frame.session, 0);
    rig.nothing_comes(30_000);
}
