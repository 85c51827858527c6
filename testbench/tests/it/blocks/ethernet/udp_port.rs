//! Runs `UdpPort` at the pins of a PHY, with frames that plain code makes: what the port gives and sends must be what
//! plain code finds in those frames. The Verilog runs beside the Rust form for some frames, and alone for many.

mod rig;

use crate::rig::ethernet_frames::{
    arp, echo, internet_sum, reaction, sealed, udp, Party, Reaction, ALL, BROADCAST, DEVICE,
};
use crate::rig::stepper::{Cell, Stepper, Wave};
use crate::rig::stream_rig::{rise, Pins, Verilog};
use incircle_hdl::ethernet::UdpPort;
use incircle_testkit::SplitMix64;
use rig::{Rig, PERIODS};

/// Appends a sum that makes a frame sound, without padding.
fn summed(frame: &[u8]) -> Vec<u8> {
    [frame, &crate::rig::ethernet_frames::frame_sum(frame)].concat()
}

/// Changes bytes of a frame before its check sum is made; the check sum of its IPv4 header is made anew.
fn changed(mut frame: Vec<u8>, changes: &[(usize, u8)]) -> Vec<u8> {
    for (place, byte) in changes {
        frame[*place] = *byte;
    }
    frame[24..26].fill(0);
    let sum = internet_sum(&frame[14..34]);
    frame[24..26].copy_from_slice(&sum.to_be_bytes());
    sealed(frame)
}

/// Frames by name, each with whether the port must react.
fn cases(random: &mut SplitMix64) -> Vec<(&'static str, Vec<u8>, bool)> {
    let host = Party::random(random);
    let us = (DEVICE.mac, DEVICE.address, DEVICE.port);
    let to_us = (DEVICE.mac, DEVICE.address);
    let payload: Vec<u8> = (0..1473).map(|_| random.below(256) as u8).collect();
    let plain = |length: usize| udp(host, us, &payload[..length], true);
    let ping = |length: usize| echo(host, to_us, &payload[..length]);
    let flip = |mut frame: Vec<u8>, place: usize| {
        frame[place] ^= 0x10;
        frame
    };
    let vlan = |frame: Vec<u8>| [&frame[..12], &[0x81, 0, 0, 5], &frame[12..]].concat();
    let options = {
        let mut frame = plain(40);
        frame.splice(34..34, [1, 1, 1, 0]);
        changed(frame, &[(14, 0x46), (17, 72)])
    };
    vec![
        ("a datagram", sealed(plain(100)), true),
        ("an empty datagram, padded", sealed(plain(0)), true),
        ("a datagram of a byte, padded", sealed(plain(1)), true),
        ("a datagram that needs no padding", sealed(plain(18)), true),
        ("the longest datagram", sealed(plain(1472)), true),
        ("one byte too many", sealed(plain(1473)), false),
        ("a datagram without check sum", sealed(udp(host, us, &payload[..33], false)), true),
        ("a wrong check sum of UDP", sealed(flip(plain(33), 60)), false),
        ("another port", sealed(udp(host, (us.0, us.1, 9), &payload[..33], true)), false),
        ("another address", sealed(udp(host, (us.0, [10, 0, 7, 3], us.2), &payload[..33], true)), false),
        ("another station", sealed(udp(host, ([2; 6], us.1, us.2), &payload[..33], true)), false),
        ("a group of stations", sealed(udp(host, ([1, 0, 94, 0, 0, 1], us.1, us.2), &payload[..33], true)), false),
        ("broadcast to the network", sealed(udp(host, (ALL, BROADCAST, us.2), &payload[..33], true)), true),
        ("broadcast to all", sealed(udp(host, (ALL, [255; 4], us.2), &payload[..33], true)), true),
        ("a wrong check sum of the frame", flip(sealed(plain(33)), 77), false),
        ("a wrong check sum of the header", sealed(flip(plain(33), 25)), false),
        ("a first fragment", changed(plain(33), &[(20, 0x20)]), false),
        ("a later fragment", changed(plain(33), &[(20, 0), (21, 3)]), false),
        ("without the bit against fragments", changed(plain(33), &[(20, 0)]), true),
        ("options", options, false),
        ("IPv6", changed(plain(33), &[(14, 0x65)]), false),
        ("TCP", changed(plain(33), &[(23, 6)]), false),
        ("a frame with a VLAN", sealed(vlan(plain(33))), false),
        ("a length beyond the frame", changed(plain(33), &[(17, 64)]), false),
        ("a length below UDP", changed(plain(33), &[(17, 27)]), false),
        ("lengths that differ", changed(plain(33), &[(17, 60)]), false),
        ("a truncated frame", sealed(plain(100)[..90].to_vec()), false),
        ("a frame without padding", summed(&plain(0)), false),
        ("a frame that is cut", sealed(plain(100))[..80].to_vec(), false),
        ("a sender that is a group", sealed(udp(Party { mac: [3; 6], ..host }, us, &payload[..33], true)), false),
        ("an oversized frame", summed(&[plain(1472), vec![0]].concat()), false),
        ("a jumbo frame", summed(&[plain(1472), vec![0; 3000]].concat()), false),
        ("ping", sealed(ping(56)), true),
        ("the shortest ping", sealed(ping(0)), true),
        ("the longest ping", sealed(ping(1472)), true),
        ("ping to all", sealed(echo(host, (ALL, BROADCAST), &payload[..56])), false),
        ("an answer to a ping", changed(ping(56), &[(34, 0)]), false),
        ("arp", sealed(arp(host, ALL, DEVICE.address)), true),
        ("arp to us alone", sealed(arp(host, DEVICE.mac, DEVICE.address)), true),
        (
            "an answer by ARP",
            sealed([&arp(host, ALL, DEVICE.address)[..21], &[2], &arp(host, ALL, DEVICE.address)[22..]].concat()),
            false,
        ),
        ("arp for another", sealed(arp(host, ALL, [10, 0, 7, 3])), false),
    ]
}

/// Gives the port each case, and compares with what plain code says.
fn runs_cases(mut rig: Rig<impl Pins>, seed: u64) {
    let mut random = SplitMix64::new(seed);
    for (about, frame, reacts) in cases(&mut random) {
        let expected = reaction(&frame);
        assert_eq!(expected != Reaction::default(), reacts, "plain code on {about}");
        rig.expect(&frame, &expected, about);
    }
}

#[test]
fn both_forms_react_to_each_kind_of_frame_as_plain_code_says() {
    runs_cases(Rig::new(Stepper::new("ethernet_udp_port", UdpPort::new(), 1), PERIODS[0], 1), 1);
}

#[test]
fn so_does_the_verilog_at_any_ratio_of_clocks() {
    for (seed, periods) in PERIODS.into_iter().enumerate() {
        runs_cases(Rig::new(Verilog::new("ethernet_udp_port", seed as u32), periods, seed as u64), 7 + seed as u64);
    }
}

/// A frame of any kind, often damaged in one place or many.
fn hostile(random: &mut SplitMix64) -> Vec<u8> {
    let host = Party::random(random);
    let payload: Vec<u8> = (0..random.below(80)).map(|_| random.below(256) as u8).collect();
    let to = [DEVICE.address, BROADCAST, [255; 4]][random.below(3) as usize];
    let mac = [DEVICE.mac, ALL][random.below(2) as usize];
    let mut frame = match random.below(6) {
        0 => arp(host, mac, DEVICE.address),
        1 => echo(host, (DEVICE.mac, DEVICE.address), &payload),
        2 => (0..random.below(200)).map(|_| random.below(256) as u8).collect(),
        _ => udp(host, (mac, to, DEVICE.port), &payload, random.below(2) == 0),
    };
    let mut sealed_frame = Vec::new();
    for is_after in [false, true] {
        let bytes = if is_after { &mut sealed_frame } else { &mut frame };
        for _ in 0..[0, 0, 1, 1, 2, 5][random.below(6) as usize] * usize::from(!is_after || random.below(6) == 0) {
            if bytes.is_empty() {
                break;
            }
            // Most damage goes to the headers.
            let reach = if random.below(4) > 0 { 44 } else { 1 << 16 };
            let place = random.below(reach) as usize % bytes.len();
            match random.below(5) {
                0 => bytes[place] = random.below(256) as u8,
                1 => bytes[place] ^= 1 << random.below(8),
                2 => bytes.truncate(place),
                3 => bytes.insert(place, random.below(256) as u8),
                _ => drop(bytes.remove(place)),
            }
        }
        if !is_after {
            if frame.len() > 34 && random.below(2) == 0 {
                frame[24..26].fill(0);
                let sum = internet_sum(&frame[14..34]);
                frame[24..26].copy_from_slice(&sum.to_be_bytes());
            }
            sealed_frame = sealed(frame.clone());
        }
    }
    sealed_frame
}

#[test]
fn hostile_frames_do_nothing_that_plain_code_does_not_expect() {
    let mut random = SplitMix64::new(77);
    let mut rig = Rig::new(Verilog::new("ethernet_udp_port", 3), PERIODS[1], 3);
    let (mut datagrams, mut answers) = (0, 0);
    for _ in 0..3000 {
        let frame = hostile(&mut random);
        let expected = reaction(&frame);
        datagrams += usize::from(expected.datagram.is_some());
        answers += usize::from(expected.answer.is_some());
        rig.expect(&frame, &expected, "a hostile frame");
    }
    assert!(datagrams > 300 && answers > 200, "{datagrams} datagrams and {answers} answers of 3000 frames");
}

#[test]
fn frames_without_a_pause_all_come_and_noise_between_them_does_not_matter() {
    let mut random = SplitMix64::new(4);
    for periods in [PERIODS[0], PERIODS[1]] {
        let mut rig = Rig::new(Verilog::new("ethernet_udp_port", 5), periods, 5);
        let mut expected = Vec::new();
        for run in 0..500 {
            let frame = hostile(&mut random);
            rig.put(&frame, if run % 2 == 0 { 12 } else { 1 });
            expected.extend(reaction(&frame).datagram);
            if run % 5 == 0 {
                rig.wire.push_back(None);
                rig.wire.extend((0..random.below(30)).map(|_| Some((random.below(16) as u8, random.below(9) == 0))));
            }
        }
        rig.rest();
        assert!(expected.len() > 30);
        assert_eq!(rig.datagrams, expected);
    }
}

#[test]
fn a_slow_reader_loses_whole_datagrams_only() {
    let mut random = SplitMix64::new(8);
    let mut rig = Rig::new(Verilog::new("ethernet_udp_port", 6), PERIODS[2], 6);
    rig.pace = 4;
    let mut sent = Vec::new();
    for _ in 0..120 {
        let payload: Vec<u8> = (0..random.below(700)).map(|_| random.below(256) as u8).collect();
        let us = (DEVICE.mac, DEVICE.address, DEVICE.port);
        let frame = sealed(udp(Party::random(&mut random), us, &payload, true));
        sent.extend(reaction(&frame).datagram);
        rig.put(&frame, 12);
    }
    rig.rest();
    // What came is a part of what was sent, in order.
    let mut rest = sent.iter();
    assert!(rig.datagrams.iter().all(|came| rest.any(|sent| sent == came)), "a datagram that nobody sent");
    let came = rig.datagrams.len();
    assert!((10..110).contains(&came), "{came} of 120 datagrams came");
    rig.pace = 1;
    let frame = sealed(udp(Party::random(&mut random), (DEVICE.mac, DEVICE.address, DEVICE.port), b"after", true));
    rig.expect(&frame, &reaction(&frame), "the next datagram");
}

#[test]
fn datagrams_go_out_to_whom_they_are_for_at_the_pace_of_the_wire() {
    let mut random = SplitMix64::new(12);
    for periods in PERIODS {
        let mut rig = Rig::new(Verilog::new("ethernet_udp_port", 7), periods, 7);
        let mut expected = Vec::new();
        for length in [1472, 1472, 1472, 0, 1, 17, 18, 19, 1471, 300] {
            let to = Party::random(&mut random);
            let payload: Vec<u8> = (0..length).map(|_| random.below(256) as u8).collect();
            let bytes = [to.bytes(), payload.clone()].concat();
            let last = bytes.len() - 1;
            rig.sends.extend(bytes.into_iter().enumerate().map(|(place, byte)| (byte, place == last)));
            expected.push(sealed(udp(DEVICE, (to.mac, to.address, to.port), &payload, false)));
        }
        rig.rest();
        let ends: Vec<u64> = rig.frames.iter().map(|frame| frame.1).collect();
        let sent: Vec<Vec<u8>> = rig.frames.into_iter().map(|frame| frame.0).collect();
        assert_eq!(sent, expected);
        // A frame of 1,514 bytes takes 1,538 clocks with preamble, check sum and gap.
        let pace = ends[2] - ends[1];
        assert!(periods[1] > 8000 || pace <= 1544, "a frame in {pace} clocks at {periods:?}");
    }
}

#[test]
fn short_datagrams_between_long_ones_cost_no_more_than_their_own_time() {
    let mut random = SplitMix64::new(15);
    for periods in [PERIODS[0], PERIODS[1]] {
        let mut rig = Rig::new(Verilog::new("ethernet_udp_port", 10), periods, 10);
        let mut expected = Vec::new();
        for run in 0..60 {
            let to = Party::random(&mut random);
            let length = if run % 3 == 0 { 1472 } else { 40 + random.below(5) as usize };
            let payload: Vec<u8> = (0..length).map(|_| random.below(256) as u8).collect();
            let bytes = [to.bytes(), payload.clone()].concat();
            let last = bytes.len() - 1;
            rig.sends.extend(bytes.into_iter().enumerate().map(|(place, byte)| (byte, place == last)));
            expected.push(sealed(udp(DEVICE, (to.mac, to.address, to.port), &payload, false)));
        }
        rig.rest();
        let (first, last) = (rig.frames[3].1, rig.frames[57].1);
        let sent: Vec<Vec<u8>> = rig.frames.into_iter().map(|frame| frame.0).collect();
        assert_eq!(sent, expected);
        // A long frame and two short ones take 1,538 and at most twice 110 clocks, and a few to be filled and begun.
        let clocks = (last - first) / 18;
        assert!(clocks <= 1538 + 2 * 110 + 40, "{clocks} clocks for a long and two short frames at {periods:?}");
    }
}

#[test]
fn a_datagram_that_is_dropped_leaves_no_trace() {
    let mut random = SplitMix64::new(14);
    for periods in PERIODS {
        let mut rig = Rig::new(Verilog::new("ethernet_udp_port", 9), periods, 9);
        let mut expected = Vec::new();
        for length in [1, 12, 13, 700, 1483] {
            rig.sends.extend((0..length).map(|_| (random.below(256) as u8, false)));
            rig.drops = true;
            while rig.drops {
                rig.step();
            }
            let to = Party::random(&mut random);
            let payload = vec![length as u8; 40];
            let bytes = [to.bytes(), payload.clone()].concat();
            let last = bytes.len() - 1;
            rig.sends.extend(bytes.into_iter().enumerate().map(|(place, byte)| (byte, place == last)));
            expected.push(sealed(udp(DEVICE, (to.mac, to.address, to.port), &payload, false)));
        }
        rig.rest();
        let sent: Vec<Vec<u8>> = rig.frames.into_iter().map(|frame| frame.0).collect();
        assert_eq!(sent, expected);
    }
}

#[test]
fn answers_and_datagrams_share_the_line() {
    let mut random = SplitMix64::new(13);
    let mut rig = Rig::new(Verilog::new("ethernet_udp_port", 8), PERIODS[1], 8);
    let (mut answers, mut datagrams) = (Vec::new(), Vec::new());
    for run in 0..40 {
        let to = Party::random(&mut random);
        let payload = vec![run as u8; 100];
        let bytes = [to.bytes(), payload.clone()].concat();
        let last = bytes.len() - 1;
        rig.sends.extend(bytes.into_iter().enumerate().map(|(place, byte)| (byte, place == last)));
        datagrams.push(sealed(udp(DEVICE, (to.mac, to.address, to.port), &payload, false)));
        let frame = sealed(echo(to, (DEVICE.mac, DEVICE.address), &payload));
        answers.extend(reaction(&frame).answer);
        rig.put(&frame, 400);
    }
    rig.rest();
    let sent: Vec<Vec<u8>> = rig.frames.iter().map(|frame| frame.0.clone()).collect();
    let of = |protocol: u8| sent.iter().filter(|frame| frame[23] == protocol).cloned().collect::<Vec<_>>();
    assert_eq!((of(17), of(1)), (datagrams, answers));
}

#[test]
fn wave_of_the_end_of_a_datagram_at_equal_clocks() {
    let mut rig = Rig::new(Stepper::new("ethernet_udp_port", UdpPort::new(), 1), PERIODS[0], 1);
    let mut random = SplitMix64::new(2);
    let payload: Vec<u8> = (60..78).collect();
    let us = (DEVICE.mac, DEVICE.address, DEVICE.port);
    let frame = sealed(udp(Party::random(&mut random), us, &payload, true));
    let line = [vec![0x55; 7], vec![0xd5], frame].concat();
    let block = &mut rig.pins;
    let mut wave = Wave::default();
    for clock in 0..line.len() + 14 {
        let byte = line.get(clock);
        block.set("rx_valid", byte.is_some());
        block.set("rx_data", byte.copied().unwrap_or(0));
        block.settle();
        let valid = block.is("entry_valid");
        block.set("entry_pop", valid);
        block.settle();
        if clock + 7 >= line.len() {
            let entry = if valid { block.get("entry") } else { 0 };
            let is_payload = clock + 4 < line.len();
            let shown = |shows: bool, value: u128| if shows { Cell::Number(value) } else { Cell::Open };
            wave.take(&[
                ("rx_valid", Cell::Bit(byte.is_some())),
                ("rx_data", shown(is_payload, byte.copied().unwrap_or(0).into())),
                ("entry_valid", Cell::Bit(valid)),
                ("entry[8]", if valid { Cell::Bit(entry >> 8 == 1) } else { Cell::Open }),
                ("entry[7:0]", shown(valid, entry & 0xff)),
            ]);
        }
        rise(block, [("port_clock", true), ("core_clock", true)]);
    }
    wave.assert_drawn_in("udp_port");
}
