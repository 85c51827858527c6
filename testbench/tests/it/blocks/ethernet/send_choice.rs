//! Runs `SendChoice` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::ethernet::SendChoice;
use incircle_testkit::SplitMix64;

named_ports!(
    SendChoice,
    [answer_waits, answer_data, answer_is_last, datagram_waits, datagram_data, datagram_is_last, begins],
    [answer_begins, datagram_begins, waits, byte_data, byte_is_last],
    clock
);

/// The two sides, by the beginning of their ports.
const SIDES: [&str; 2] = ["answer", "datagram"];

#[test]
fn the_side_that_waits_begins_and_both_take_turns() {
    let mut random = SplitMix64::new(11);
    let mut block = Stepper::new("ethernet_send_choice", SendChoice::default(), 1);
    // The side that began last. The block has no reset, so the first frame is one for which only one side waits.
    let mut last: Option<usize> = None;
    let mut begun = [[0; 2]; 2];
    for _ in 0..20_000 {
        let waits = [0, 1].map(|side| random.below(3) == 0 && (last.is_some() || side == 0));
        let bytes = [0, 1].map(|_| (random.below(256) as u8, random.below(2) == 0));
        let begins = waits.contains(&true) && random.below(3) == 0;
        for (side, name) in SIDES.into_iter().enumerate() {
            block.set(&format!("{name}_waits"), waits[side]);
            block.set(&format!("{name}_data"), bytes[side].0);
            block.set(&format!("{name}_is_last"), bytes[side].1);
        }
        block.set("begins", begins);
        block.settle();
        let chosen = match waits {
            [true, true] => last.map(|last| 1 - last),
            _ => waits.iter().position(|waits| *waits),
        };
        block.expect("waits", waits != [false; 2]);
        for (side, name) in SIDES.into_iter().enumerate() {
            block.expect(&format!("{name}_begins"), begins && chosen == Some(side));
        }
        if let Some(last) = last {
            block.expect("byte_data", bytes[last].0);
            block.expect("byte_is_last", bytes[last].1);
        }
        block.edge();
        if begins {
            last = chosen;
            begun[usize::from(waits == [true; 2])][chosen.expect("a side that waits")] += 1;
        }
    }
    assert!(begun.iter().flatten().all(|count| *count > 300), "{begun:?}");
}

#[test]
fn wave_of_frames_in_turn() {
    let mut stimuli = vec![(0, "answer_waits", 1), (0, "begins", 1), (4, "begins", 1), (7, "begins", 1)];
    for clock in 1..10 {
        stimuli.push((clock, "answer_data", 10 + clock as u128));
        stimuli.push((clock, "datagram_data", 50 + clock as u128));
    }
    stimuli.extend((3..8).map(|clock| (clock, "answer_waits", 1)));
    stimuli.extend((2..5).map(|clock| (clock, "datagram_waits", 1)));
    stimuli.extend([(3, "answer_is_last", 1), (6, "datagram_is_last", 1)]);
    let behind = When::At(&[1, 2, 3, 4, 5, 6, 7, 8, 9]);
    let lanes = [
        ("answer_waits", "answer_waits", 0, 1, When::Always),
        ("datagram_waits", "datagram_waits", 0, 1, When::Always),
        ("begins", "begins", 0, 1, When::Always),
        ("answer_begins", "answer_begins", 0, 1, When::Always),
        ("datagram_begins", "datagram_begins", 0, 1, When::Always),
        ("answer_data", "answer_data", 0, 8, behind),
        ("datagram_data", "datagram_data", 0, 8, behind),
        ("byte_data", "byte_data", 0, 8, behind),
        ("byte_is_last", "byte_is_last", 0, 1, behind),
    ];
    draw("ethernet_send_choice", SendChoice::default(), &stimuli, 10, &lanes).assert_drawn_in("send_choice");
}
