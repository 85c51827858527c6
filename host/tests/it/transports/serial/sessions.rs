//! Sessions of the serial protocol, one after another, in virtual time: late frames of an earlier session, sessions
//! that were left open, and rates that do not work.

use std::time::Duration;

use crate::common::board;
use crate::common::rig::{Fate, Rig};
use incircle::serial::SerialFault;
use incircle::transports::parts::{Params, SerialProtocol};
use incircle_protocol::{Command, FIRST_RATE, MAX_SILENCE_MS};

const HELLO: Command<&[u32]> = Command::Hello;
/// Header of a device's frame without a session: `NoSession`, 4,096 bytes free.
const NO_SESSION: [u8; 7] = [0, 0x87, 0, 0, 0, 16, 0];

fn rig() -> Rig {
    Rig::new(Params::with_rate(12_000_000), 4096)
}

/// A rig that stays at the first rate.
fn slow_rig(session: u8) -> Rig {
    Rig::new(Params { rates: vec![], session }, 4096)
}

#[test]
fn a_late_frame_of_a_session_is_nothing_to_the_next() {
    let mut rig = slow_rig(7);
    rig.ask(&HELLO).expect("a sound line");
    // The host says `Poll`, and sleeps while the `Ack` is on its way.
    let polls = rig.protocol.statistics().polls;
    assert!(rig.run(rig.now + Duration::from_secs(1), |protocol| protocol.statistics().polls > polls));
    rig.run(rig.now + Duration::from_micros(2500), |_| false);
    assert_eq!(rig.under_way(true), 1);
    // After this pause the session is opened anew for a command that does not need the device's memory.
    rig.now += Duration::from_millis(1700);
    rig.ask(&HELLO).expect("a sound line");
    assert_eq!(rig.board.session, 9);
}

#[test]
fn a_frame_without_a_session_is_nothing_to_a_greeting() {
    let mut rig = slow_rig(0);
    rig.protocol.ask(HELLO, rig.now).expect("a command");
    rig.protocol.receive(&board::frame(&NO_SESSION), rig.now);
    rig.finish().expect("a sound line");
}

#[test]
fn every_session_has_another_number() {
    for before in [0, 1, 41, 254, 255] {
        let mut rig = slow_rig(before);
        let mut last = before;
        for _ in 0..300 {
            rig.ask(&HELLO).expect("a sound line");
            assert_eq!(rig.board.session, last.checked_add(1).unwrap_or(1), "after {before}");
            last = rig.board.session;
            rig.protocol.close(rig.now);
            assert!(rig.run(rig.now + Duration::from_secs(1), |protocol| protocol.is_closed()));
        }
    }
}

/// The first acknowledgement is lost, and the device forgets the session before the host has seen that
/// the rate does not work.
#[test]
fn a_rate_that_does_not_work_is_left_also_where_silence_is_short() {
    let mut rig = rig();
    rig.board.greeting[5] = 400;
    rig.board.usable = 200_000;
    rig.faults = Box::new(|to_host, frame| if to_host && frame == 2 { Fate::Lost } else { Fate::Passes });
    let since = rig.now;
    rig.ask(&HELLO).expect("the first rate works");
    assert_eq!(rig.protocol.rate(), FIRST_RATE);
    assert!(rig.now - since < Duration::from_secs(5), "{:?}", rig.now - since);
}

#[test]
fn a_device_without_a_session_is_greeted_at_the_first_rate() {
    let mut rig = rig();
    rig.protocol.ask(HELLO, rig.now).expect("a command");
    assert!(rig.run(rig.now + Duration::from_secs(1), |protocol| protocol.rate() != FIRST_RATE));
    rig.protocol.receive(&board::frame(&NO_SESSION), rig.now);
    assert_eq!(rig.protocol.rate(), FIRST_RATE);
    rig.finish().expect("after the silence");
    assert_eq!(rig.protocol.rate(), 3_000_000);
}

#[test]
fn a_device_with_the_longest_silence_is_found_at_any_rate() {
    let mut rig = rig();
    rig.board.greeting[5] = MAX_SILENCE_MS;
    rig.ask(&HELLO).expect("a sound line");
    rig.protocol = SerialProtocol::new(Params { session: 77, ..Params::with_rate(3_000_000) });
    rig.ask(&HELLO).expect("after the silence");
    assert_eq!(rig.protocol.rate(), 3_000_000);
}

/// The longest time to a session: a device was left at a high rate, no rate works, and no acknowledgement comes.
#[test]
fn the_ladder_of_rates_is_done_in_the_time_for_a_greeting() {
    let mut rig = rig();
    rig.ask(&HELLO).expect("a sound line");
    rig.protocol = SerialProtocol::new(Params { session: 77, ..Params::with_rate(12_000_000) });
    rig.board.usable = 200_000;
    // The device sends `Hello`, `Opened` and `Ack` three times, and each `Ack` is lost.
    let first = rig.frames[1];
    rig.faults = Box::new(move |to_host, frame| {
        let is_lost = to_host && frame < first + 9 && (frame - first) % 3 == 2;
        if is_lost {
            Fate::Lost
        } else {
            Fate::Passes
        }
    });
    let since = rig.now;
    rig.ask(&HELLO).expect("the first rate works");
    let took = rig.now - since;
    assert!(took > Duration::from_secs(10) && took < Duration::from_secs(15), "{took:?}");
}

#[test]
fn a_command_may_follow_a_greeting_at_once() {
    let mut rig = rig();
    rig.protocol.greet(rig.now);
    rig.ask(&HELLO).expect("a sound line");
    rig.ask(&HELLO).expect("a sound line");
    let mut rig = self::rig();
    rig.protocol.greet(rig.now);
    rig.protocol.open(rig.now);
    assert!(rig.run(rig.now + Duration::from_secs(1), |protocol| protocol.is_open()));
}

#[test]
fn closing_abandons_the_command_under_way() {
    for microseconds in [0, 300, 3_000, 20_000, 100_000] {
        let mut rig = rig();
        rig.protocol.ask(HELLO, rig.now).expect("a command");
        rig.run(rig.now + Duration::from_micros(microseconds), |_| false);
        rig.protocol.close(rig.now);
        assert!(rig.run(rig.now + Duration::from_secs(1), |protocol| protocol.is_closed()));
        assert_eq!(rig.protocol.take_answer(), None, "{microseconds}");
        rig.ask(&HELLO).unwrap_or_else(|error| panic!("{microseconds}: {error}"));
    }
}

#[test]
fn the_core_must_say_what_the_greeting_said() {
    for (word, value) in [(2, 9), (3, 20), (4, 1000), (5, 1 << 8 | 3), (6, 64)] {
        let mut rig = rig();
        let found = std::mem::replace(&mut rig.board.greeting[6 + word], value);
        let error = rig.ask(&HELLO).expect_err("they differ");
        let fault = SerialFault::Contradiction { word, found, expected: value };
        assert_eq!(error.fault(), Some(&fault), "{error}");
    }
}
