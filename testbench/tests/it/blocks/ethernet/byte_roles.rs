//! Runs `ByteRoles` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::head_bytes::{roles, Addresses};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::ethernet::ByteRoles;
use incircle_testkit::SplitMix64;

named_ports!(
    ByteRoles,
    [reset, station, begins, byte_valid, byte_data, place, ends, is_sound],
    [frame_begins, head_valid, head, head_place, frame_ends, frame_is_sound],
    clock
);

/// The inputs of a clock.
#[derive(Clone, Copy, Debug)]
struct Given {
    addresses: Addresses,
    begins: bool,
    byte: Option<(usize, u8)>,
    ends: bool,
    is_sound: bool,
    reset: bool,
}

/// Compares the outputs with what was given a clock before.
fn compare(block: &Stepper<ByteRoles>, given: &Given) {
    block.expect("frame_begins", given.begins && !given.reset);
    block.expect("head_valid", given.byte.is_some() && !given.reset);
    block.expect("frame_ends", given.ends && !given.reset);
    block.expect("frame_is_sound", given.is_sound);
    let Some((place, data)) = given.byte else { return };
    block.expect("head_place", place as u32);
    block.expect("head_data", data);
    block.expect("head_is_low", place % 2 == 1);
    block.expect("head_roles", roles(place));
    for (field, byte) in ["head_wanted", "head_second", "head_broadcast"].into_iter().zip(given.addresses.wanted(place))
    {
        byte.into_iter().for_each(|byte| block.expect(field, byte));
    }
}

#[test]
fn each_place_has_the_roles_that_the_headers_give_it() {
    let mut random = SplitMix64::new(21);
    let mut block = Stepper::new("ethernet_byte_roles", ByteRoles::default(), 1);
    let mut before: Option<Given> = None;
    for clock in 0..12_000 {
        // Every place that a byte can have, then most often one of the headers.
        let place = if clock < 2048 { clock } else { random.below([60, 70, 2048][clock % 3]) as usize };
        let given = Given {
            addresses: Addresses::random(&mut random),
            begins: random.below(4) == 0,
            byte: (clock < 2048 || random.below(3) > 0).then(|| (place, random.below(256) as u8)),
            ends: random.below(4) == 0,
            is_sound: random.below(2) == 0,
            reset: clock >= 2048 && random.below(10) == 0,
        };
        block.set("reset", given.reset);
        block.set("station", given.addresses.packed());
        block.set("begins", given.begins);
        block.set("byte_valid", given.byte.is_some());
        block.set("place", given.byte.map_or(place, |byte| byte.0) as u32);
        block.set("byte_data", given.byte.map_or(0, |byte| byte.1));
        block.set("ends", given.ends);
        block.set("is_sound", given.is_sound);
        block.settle();
        before.iter().for_each(|before| compare(&block, before));
        block.edge();
        before = Some(given);
    }
}

#[test]
fn wave_of_the_destination_of_a_datagram() {
    let mut stimuli = vec![(0, "begins", 1), (6, "ends", 1)];
    for (clock, place, byte) in [(1, 31, 7), (2, 32, 0), (4, 33, 2), (5, 34, 99)] {
        stimuli.extend([(clock, "byte_valid", 1), (clock, "place", place), (clock, "byte_data", byte)]);
    }
    for clock in 0..8 {
        stimuli.push((clock, "station_address", 0x0a07_0002));
        stimuli.push((clock, "station_broadcast", 0x0a07_0063));
    }
    let lanes = [
        ("begins", "begins", 0, 1, When::Always),
        ("byte_valid", "byte_valid", 0, 1, When::Always),
        ("place", "place", 0, 11, When::If("byte_valid")),
        ("byte_data", "byte_data", 0, 8, When::If("byte_valid")),
        ("ends", "ends", 0, 1, When::Always),
        ("frame_begins", "frame_begins", 0, 1, When::Always),
        ("head_valid", "head_valid", 0, 1, When::Always),
        ("head.data", "head_data", 0, 8, When::If("head_valid")),
        ("tests_address", "head_roles_tests_address", 0, 1, When::If("head_valid")),
        ("head.wanted", "head_wanted", 0, 8, When::At(&[2, 3, 5])),
        ("head.broadcast", "head_broadcast", 0, 8, When::At(&[2, 3, 5])),
        ("frame_ends", "frame_ends", 0, 1, When::Always),
    ];
    draw("ethernet_byte_roles", ByteRoles::default(), &stimuli, 8, &lanes).assert_drawn_in("byte_roles");
}
