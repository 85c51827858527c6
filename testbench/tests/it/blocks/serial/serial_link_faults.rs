//! Runs the whole serial link on lines that lose, change and break bytes, and at other rates: it must
//! do what the protocol's page says.

use crate::rig::serial_host::{cobs, crc32, host_frame, Listener};
use crate::rig::serial_rig::{answer_of, opened, payload, Pins, CLOCKS_PER_BIT, SESSION};
use incircle_blocks::QUICK_LINK;
use incircle_protocol::{rate_step, DeviceFrame, HostFrame, MAX_STEP, STATUS_BAD_RATE, STATUS_DROPPED, STATUS_OPEN};
use incircle_testkit::SplitMix64;

#[test]
fn frames_that_are_not_sound_leave_no_trace() {
    let mut rig = opened(2);
    let mut random = SplitMix64::new(11);
    let good = payload(&[7 << 24, 8 << 24]);
    for run in 0..30 {
        let mut frame = host_frame(SESSION, HostFrame::Data as u8, 0, &payload(&[9 << 24, 1, 2, 3]));
        match run % 6 {
            0 => {
                let place = random.below(frame.len() as u64) as usize;
                frame[place] ^= 1 << random.below(8);
            }
            1 => frame.truncate(random.below(frame.len() as u64) as usize),
            2 => frame = host_frame(SESSION, HostFrame::Data as u8, 0, &[1; 5]),
            3 => frame = host_frame(SESSION, HostFrame::Data as u8, 0, &[1; 1028]),
            4 => frame = host_frame(SESSION, [0, 7, 8, 0x85][run / 6 % 4], 0, &[]),
            _ => frame = host_frame(0, HostFrame::Open as u8, 0, &[]),
        }
        let mut line = cobs(&frame);
        if run % 6 == 1 && run > 10 {
            // The end of the frame is lost too, and a zero ends it.
            line.truncate(line.len() - 1);
            line.push(0);
        }
        if line.len() > 2 {
            rig.talker.say(&line);
            rig.nothing_comes(10 * 1200 * 9 / 5);
            assert_eq!(rig.pins.get("error"), 1, "run {run}");
        }
        rig.say(SESSION, HostFrame::Poll, 0, &[]);
        let ack = rig.hear(DeviceFrame::Ack);
        let status = if line.len() > 2 { STATUS_OPEN | STATUS_DROPPED } else { STATUS_OPEN };
        assert_eq!((ack.expected, ack.status, ack.words()), (0, status, vec![0]), "run {run}");
        assert_eq!(u32::from(ack.free), QUICK_LINK.fifo_bytes);
    }
    assert!(rig.core.taken.is_empty(), "{:x?}", rig.core.taken);
    rig.say(SESSION, HostFrame::Data, 0, &good);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.expected, ack.status & STATUS_DROPPED, ack.words()), (1, 0, vec![crc32(&good)]));
    assert_eq!(rig.answer(0), [7 << 24, 0]);
    assert_eq!(rig.answer(1), [8 << 24, 0]);
    assert_eq!(rig.core.taken, [7 << 24, 8 << 24]);
}

#[test]
fn the_rate_changes_and_falls_back() {
    let mut rig = opened(7);
    // A step out of range changes nothing.
    for step in [0, MAX_STEP + 1, u32::MAX] {
        rig.say(SESSION, HostFrame::Rate, 0, &step.to_le_bytes());
        assert_eq!(rig.hear(DeviceFrame::Ack).status, STATUS_OPEN | STATUS_BAD_RATE);
    }
    for (clocks_per_bit, off) in [(8.0, 1.0), (8.0, 0.98), (8.3, 1.02), (21.7, 0.98), (40.0, 1.02), (8.0, 1.02)] {
        let step = ((1 << 24) as f64 / clocks_per_bit).round() as u32;
        rig.say(SESSION, HostFrame::Rate, 0, &step.to_le_bytes());
        assert_eq!(rig.hear(DeviceFrame::Ack).status, STATUS_OPEN);
        // The last stop bit is still on the line.
        rig.wait(60);
        rig.talker.clocks_per_bit = clocks_per_bit * off;
        rig.listener = Listener::new(clocks_per_bit * off);
        rig.say(SESSION, HostFrame::Poll, 0, &[]);
        assert_eq!(rig.hear(DeviceFrame::Ack).status, STATUS_OPEN);
    }
    assert_eq!(rate_step(QUICK_LINK.clock_hz / 8, QUICK_LINK.clock_hz), Some(MAX_STEP));
    rig.data(0, &[0x7700_0064]);
    rig.hear(DeviceFrame::Ack);
    assert_eq!(rig.answer(0), answer_of(0x7700_0064));
    // The end of the session brings back the first rate, behind the session's last frame.
    rig.say(SESSION, HostFrame::Close, 0, &[]);
    rig.hear(DeviceFrame::Closed);
    rig.wait(60);
    rig.talker.clocks_per_bit = CLOCKS_PER_BIT;
    rig.listener = Listener::new(CLOCKS_PER_BIT);
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    rig.hear(DeviceFrame::NoSession);
}

#[test]
fn silence_and_a_break_end_the_session_and_the_rate() {
    let silence = (QUICK_LINK.silence_ms * QUICK_LINK.clock_hz / 1000) as usize;
    for breaks in [false, true] {
        let mut rig = opened(8);
        let step = (1u32 << 24) / 16;
        rig.say(SESSION, HostFrame::Rate, 0, &step.to_le_bytes());
        rig.hear(DeviceFrame::Ack);
        rig.wait(100);
        (rig.talker.clocks_per_bit, rig.listener) = (16.0, Listener::new(16.0));
        // Polls keep the session open for longer than the silence.
        for _ in 0..4 {
            rig.wait(silence / 3);
            rig.say(SESSION, HostFrame::Poll, 0, &[]);
            assert_eq!(rig.hear(DeviceFrame::Ack).status, STATUS_OPEN);
        }
        rig.data(0, &[0x0100_0000 | 4000]);
        rig.hear(DeviceFrame::Ack);
        if breaks {
            rig.talker.hold(false, 85);
            rig.wait(990);
            assert_eq!(rig.pins.get("core_reset"), 0);
            rig.wait(600);
        } else {
            rig.wait(silence + 200);
        }
        (rig.talker.clocks_per_bit, rig.listener) = (CLOCKS_PER_BIT, Listener::new(CLOCKS_PER_BIT));
        rig.wait(3000);
        rig.listener = Listener::new(CLOCKS_PER_BIT);
        assert_eq!(rig.pins.get("core_reset"), 1);
        rig.say(SESSION, HostFrame::Poll, 0, &[]);
        rig.hear(DeviceFrame::NoSession);
        rig.open();
    }
}

/// Sends a `Rate` whose end falls around the clock in which silence ends the session. The frame is heard in the
/// session, or finds no session, or is lost with the session as on a bad line.
#[test]
fn a_frame_at_the_very_end_of_a_session_is_taken_whole_or_not_at_all() {
    let step = ((1u32 << 24) / 16).to_le_bytes();
    // Returns the reply to a `Rate` that begins so many clocks after the last frame, and the
    // reply to a `Poll` after it.
    let replies = |wait: usize| {
        let mut rig = opened(13);
        rig.wait(wait);
        rig.say(SESSION, HostFrame::Rate, 0, &step);
        let first = rig.hear_within(9000).map(|frame| frame.kind);
        rig.wait(60);
        // The device is at the first rate, or at the one that was asked for.
        let clocks_per_bit = if first == Some(DeviceFrame::Ack as u8) { 16.0 } else { CLOCKS_PER_BIT };
        (rig.talker.clocks_per_bit, rig.listener) = (clocks_per_bit, Listener::new(clocks_per_bit));
        rig.say(SESSION, HostFrame::Poll, 0, &[]);
        (first, rig.hear_within(9000).map(|frame| frame.kind))
    };
    let [ack, no_session] = [DeviceFrame::Ack, DeviceFrame::NoSession].map(|kind| Some(kind as u8));
    let silence = (QUICK_LINK.silence_ms * QUICK_LINK.clock_hz / 1000) as usize;
    let (mut low, mut high) = (silence - 3000, silence + 1000);
    assert_eq!((replies(low), replies(high)), ((ack, ack), (no_session, no_session)));
    while high - low > 1 {
        let middle = (low + high) / 2;
        *(if replies(middle).0 == ack { &mut low } else { &mut high }) = middle;
    }
    let around: Vec<_> = (low - 2..low + 8).map(replies).collect();
    println!("around the last clock: {around:?}");
    for (clock, found) in around.into_iter().enumerate() {
        let is_sound = if clock <= 2 {
            found == (ack, ack)
        } else {
            [(no_session, no_session), (None, no_session)].contains(&found)
        };
        assert!(is_sound, "clock {clock}: {found:?}");
        assert!(clock < 5 || found.0 == no_session, "clock {clock}: lost long after the end");
    }
}

#[test]
fn noise_costs_frames_and_changes_no_word() {
    let mut rig = opened(10);
    let mut random = SplitMix64::new(12);
    let (mut expected, mut taken, mut lost) = (0u8, Vec::new(), 0);
    for run in 0..250u32 {
        let words: Vec<u32> = (0..1 + random.below(5)).map(|_| random.below(256) as u32 * 0x0101_0000).collect();
        let mut line = cobs(&host_frame(SESSION, HostFrame::Data as u8, expected, &payload(&words)));
        let is_hit = random.below(3) == 0;
        if is_hit {
            let place = random.below(line.len() as u64) as usize;
            match random.below(4) {
                0 => line[place] ^= 1 << random.below(8),
                1 => drop(line.remove(place)),
                2 => line.insert(place, random.below(256) as u8),
                _ => line.swap(place, 0),
            }
        }
        rig.talker.say(&line);
        // A zero and a poll bring the two sides together, whatever has become of the frame.
        rig.talker.say(&[0]);
        rig.say(SESSION, HostFrame::Poll, 0, &[]);
        let mut state = None;
        while let Some(frame) = rig.hear_within(8000) {
            if frame.kind == DeviceFrame::Ack as u8 || frame.kind == DeviceFrame::Nak as u8 {
                state = Some(frame);
            }
        }
        let state = state.expect("an answer to the poll");
        if state.expected != expected {
            assert_eq!(state.expected, expected.wrapping_add(1));
            taken.extend(words);
            expected = state.expected;
        } else {
            assert!(is_hit, "run {run}: a sound frame was not taken");
            lost += 1;
        }
        assert_eq!(state.words(), [crc32(&payload(&taken))]);
    }
    assert_eq!(rig.core.taken, taken);
    assert!(lost > 30, "{lost} frames lost");
}
