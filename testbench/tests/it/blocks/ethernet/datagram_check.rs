//! Runs `DatagramCheck` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::ethernet_frames::{internet_sum, sealed, udp, Party, DEVICE};
use crate::rig::head_bytes::OURS;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::ethernet::DatagramCheck;
use incircle_testkit::SplitMix64;

named_ports!(DatagramCheck, [begins, head_valid, head], [state], clock);

/// A frame with its check sum, of which numbers in the headers are often wrong.
fn frame(random: &mut SplitMix64) -> Vec<u8> {
    let length = [0, 1, 2, 17, 18, 19, 60, 61, random.below(200)][random.below(9) as usize];
    let payload: Vec<u8> = (0..length).map(|_| random.below(256) as u8).collect();
    let to = (DEVICE.mac, DEVICE.address, DEVICE.port);
    let mut frame = udp(Party::random(random), to, &payload, random.below(3) > 0);
    match random.below(8) {
        // A length of IPv4, also one that fits the frame less or more than the datagram.
        0 => frame[17] = frame[17].wrapping_add([1, 0xff, 4, 0x10][random.below(4) as usize]),
        1 => frame[17] = random.below(40) as u8,
        2 => frame[16] = random.below(256) as u8,
        // A length of UDP.
        3 => frame[38 + random.below(2) as usize] ^= 1 << random.below(8),
        // A byte that a sum covers, or a sum.
        4 | 5 => {
            let place = 14 + random.below(frame.len() as u64 - 14) as usize;
            frame[place] ^= 1 << random.below(8);
        }
        6 => frame[random.below(2) as usize + 40] = 0,
        _ => {}
    }
    let mut frame = sealed(frame);
    match random.below(8) {
        0 => frame.truncate(42 + random.below(frame.len() as u64 - 42) as usize),
        1 => frame.extend([7; 9]),
        _ => {}
    }
    frame
}

/// What plain code finds in a frame: the header is right, the datagram is whole, the numbers of UDP are right.
fn verdict(frame: &[u8]) -> [bool; 3] {
    let length = usize::from(frame[16]) << 8 | usize::from(frame[17]);
    let is_whole = length >= 28 && frame.len() >= 14 + length + 4;
    let udp_is_right = is_whole && {
        let packet = &frame[34..14 + length];
        let says = usize::from(packet[4]) << 8 | usize::from(packet[5]);
        let covered = [&frame[26..34], &[0, 17], &packet[4..6], packet].concat();
        says == packet.len() && (packet[6..8] == [0, 0] || internet_sum(&covered) == 0)
    };
    [internet_sum(&frame[14..34]) == 0, is_whole, udp_is_right]
}

#[test]
fn lengths_and_check_sums_are_judged_as_they_come() {
    let mut random = SplitMix64::new(8);
    let mut block = Stepper::new("ethernet_datagram_check", DatagramCheck::default(), 1);
    let mut counts = [[0; 2]; 3];
    for _ in 0..1500 {
        let frame = frame(&mut random);
        let length = usize::from(frame[16]) << 8 | usize::from(frame[17]);
        block.set("begins", true);
        block.set("head_valid", false);
        block.settle();
        block.edge();
        block.set("begins", false);
        let (mut come, pace) = (0, random.below(3));
        while come < frame.len() {
            let comes = pace < 2 || random.below(3) == 0;
            let data = if comes { frame[come] } else { random.below(256) as u8 };
            block.set("head_valid", comes);
            block.set("head", OURS.head(come, data, &mut random));
            block.settle();
            if come >= 42 && length >= 28 {
                block.expect("has_more", come < 14 + length);
            }
            block.edge();
            come += usize::from(comes);
        }
        block.set("head_valid", false);
        block.settle();
        let [header_is_right, is_whole, udp_is_right] = verdict(&frame);
        block.expect("header_is_right", header_is_right);
        block.expect("is_whole", is_whole);
        if is_whole {
            block.expect("udp_is_right", udp_is_right);
        }
        for (count, flag) in counts.iter_mut().zip([header_is_right, is_whole, udp_is_right]) {
            count[usize::from(flag)] += 1;
        }
    }
    assert!(counts.iter().flatten().all(|count| *count > 150), "{counts:?}");
}

#[test]
fn wave_of_the_end_of_a_datagram() {
    let mut random = SplitMix64::new(1);
    let mut stimuli = vec![(0, "begins", 1)];
    // The length of IPv4 and of UDP, the check sum 0, two bytes of payload, and the check sum of the frame.
    let bytes = [16, 17, 18, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47];
    for (clock, place) in bytes.into_iter().enumerate() {
        let byte = match place {
            17 => 30,
            39 => 10,
            16 | 38 | 40 | 41 => 0,
            _ => 9,
        };
        stimuli.extend([(clock + 1, "head_valid", 1), (clock + 1, "head", OURS.head(place, byte, &mut random))]);
    }
    let lanes = [
        ("begins", "begins", 0, 1, When::Always),
        ("head_valid", "head_valid", 0, 1, When::Always),
        ("head.data", "head", 0, 8, When::If("head_valid")),
        ("has_more", "state_has_more", 0, 1, When::At(&[8, 9, 10, 11, 12, 13, 14])),
        ("udp_is_right", "state_udp_is_right", 0, 1, When::At(&[14, 15])),
        ("is_whole", "state_is_whole", 0, 1, When::At(&[8, 9, 10, 11, 12, 13, 14, 15])),
    ];
    draw("ethernet_datagram_check", DatagramCheck::default(), &stimuli, 16, &lanes).assert_drawn_in("datagram_check");
}
