//! Runs `FrameMatch` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::ethernet_frames::{arp, echo, udp, Party, ALL, BROADCAST, DEVICE};
use crate::rig::head_bytes::OURS;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::ethernet::FrameMatch;
use incircle_testkit::SplitMix64;

named_ports!(FrameMatch, [begins, head_valid, head], [kinds], clock);

/// The kinds that a frame may have whose first bytes are these: UDP, echo request, ARP request, to all.
fn kinds(bytes: &[u8]) -> [bool; 4] {
    // A field that has not come yet, or not whole, may still be right.
    let has = |place: usize, field: &[u8]| {
        field.iter().enumerate().all(|(index, wanted)| bytes.get(place + index).is_none_or(|byte| byte == wanted))
    };
    let is_own = has(0, &DEVICE.mac) && has(30, &DEVICE.address);
    let is_for_us = has(0, &DEVICE.mac) || has(0, &ALL);
    let is_from_one = bytes.get(6).is_none_or(|byte| byte % 2 == 0);
    let is_to_us = [DEVICE.address, BROADCAST, [255; 4]].iter().any(|address| has(30, address));
    // The reserved bit, "more fragments" and the offset must be 0.
    let is_plain = has(12, &[8, 0, 0x45])
        && bytes.get(20).is_none_or(|flags| [0x00, 0x40].contains(flags))
        && has(21, &[0])
        && is_from_one;
    let is_udp = is_plain && has(23, &[17]) && has(36, &DEVICE.port.to_be_bytes()) && is_to_us && is_for_us;
    let is_echo = is_plain && has(23, &[1]) && has(34, &[8, 0]) && is_own;
    let asks = has(12, &[8, 6, 0, 1, 8, 0, 6, 4, 0, 1]) && has(38, &DEVICE.address);
    [is_udp, is_echo, asks && is_for_us && is_from_one, !is_own]
}

/// A frame of any kind; one in two has a byte of its headers changed.
fn frame(random: &mut SplitMix64) -> Vec<u8> {
    let host = Party::random(random);
    let mac = [DEVICE.mac, ALL][random.below(2) as usize];
    let address = [DEVICE.address, BROADCAST, [255; 4]][random.below(3) as usize];
    let mut frame = match random.below(4) {
        0 => arp(host, mac, DEVICE.address),
        1 => echo(host, (DEVICE.mac, DEVICE.address), &[7; 9]),
        _ => udp(host, (mac, address, DEVICE.port), &[9; 9], true),
    };
    if random.below(2) == 0 {
        let place = random.below(42) as usize;
        frame[place] = match random.below(4) {
            0 => random.below(256) as u8,
            1 => 0xff,
            _ => frame[place] ^ 1 << random.below(8),
        };
    }
    // "Do not fragment" may have any value.
    if random.below(3) == 0 {
        frame[20] ^= 0x40;
    }
    frame
}

#[test]
fn a_kind_stays_true_until_a_byte_contradicts_it() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("ethernet_frame_match", FrameMatch::default(), 1);
    let mut counts = [[0; 2]; 4];
    for _ in 0..1500 {
        let frame = frame(&mut random);
        block.set("begins", true);
        block.set("head_valid", false);
        block.settle();
        block.edge();
        block.set("begins", false);
        let mut come = 0;
        while come < frame.len() {
            // A clock in which no byte comes may show any byte.
            let comes = random.below(5) > 0;
            let data = if comes { frame[come] } else { random.below(256) as u8 };
            let place = if comes { come } else { random.below(64) as usize };
            block.set("head_valid", comes);
            block.set("head", OURS.head(place, data, &mut random));
            block.settle();
            let expected = kinds(&frame[..come]);
            block.expect("kinds", expected.iter().rev().fold(0u32, |bits, bit| bits << 1 | u32::from(*bit)));
            block.edge();
            come += usize::from(comes);
        }
        for (count, kind) in counts.iter_mut().zip(kinds(&frame)) {
            count[usize::from(kind)] += 1;
        }
    }
    assert!(counts.iter().flatten().all(|count| *count > 100), "{counts:?}");
}

#[test]
fn wave_of_a_frame_to_all_that_is_no_echo() {
    let mut random = SplitMix64::new(1);
    // The last byte of a destination that is all ones, the type of IPv4, UDP, and a foreign port.
    let bytes = [(5, 0xff), (12, 8), (13, 0), (23, 17), (36, 9)];
    let mut stimuli = vec![(0, "begins", 1)];
    for (clock, (place, byte)) in bytes.into_iter().enumerate() {
        stimuli.extend([(clock + 1, "head_valid", 1), (clock + 1, "head", OURS.head(place, byte, &mut random))]);
    }
    let behind = When::At(&[1, 2, 3, 4, 5, 6, 7]);
    let lanes = [
        ("begins", "begins", 0, 1, When::Always),
        ("head_valid", "head_valid", 0, 1, When::Always),
        ("is_to_all", "kinds_is_to_all", 0, 1, behind),
        ("is_arp", "kinds_is_arp", 0, 1, behind),
        ("is_echo", "kinds_is_echo", 0, 1, behind),
        ("is_udp", "kinds_is_udp", 0, 1, behind),
    ];
    draw("ethernet_frame_match", FrameMatch::default(), &stimuli, 8, &lanes).assert_drawn_in("frame_match");
}
