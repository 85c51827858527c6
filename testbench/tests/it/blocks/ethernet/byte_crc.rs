//! Runs `ByteCrc` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
use crate::rig::ethernet_frames::frame_sum;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::ethernet::ByteCrc;
use incircle_testkit::SplitMix64;

named_ports!(ByteCrc, [sets, start, takes, byte_data], [state], clock);

#[test]
fn check_sums_run_a_byte_a_clock() {
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new("ethernet_byte_crc", ByteCrc::default(), 1);
    for run in 0..200 {
        block.set("sets", true);
        block.set("start", ByteCrc::FIRST);
        block.set("takes", run % 2 == 0);
        block.set("byte_data", 0x5au8);
        block.settle();
        block.edge();
        block.set("sets", false);
        block.set("start", random.next_u64() as u32);
        let mut bytes = Vec::new();
        for _ in 0..random.below(40) {
            let (takes, byte) = (random.below(4) > 0, random.below(256) as u8);
            block.set("takes", takes);
            block.set("byte_data", byte);
            block.settle();
            block.expect("state", !u32::from_le_bytes(frame_sum(&bytes)));
            block.edge();
            if takes {
                bytes.push(byte);
            }
        }
        let sum = frame_sum(&bytes);
        for byte in sum {
            block.set("takes", true);
            block.set("byte_data", byte);
            block.settle();
            block.edge();
        }
        block.settle();
        block.expect("state", ByteCrc::SOUND);
    }
    assert_eq!(frame_sum(b"123456789"), 0xcbf4_3926u32.to_le_bytes());
}

#[test]
fn wave_of_a_sum_over_three_bytes() {
    let mut stimuli = vec![(0, "sets", 1), (0, "start", ByteCrc::FIRST.into())];
    for (clock, byte) in [(1, 49), (2, 50), (4, 51)] {
        stimuli.extend([(clock, "takes", 1), (clock, "byte_data", byte)]);
    }
    let lanes = [
        ("sets", "sets", 0, 1, When::Always),
        ("takes", "takes", 0, 1, When::Always),
        ("byte_data", "byte_data", 0, 8, When::If("takes")),
        ("state[5:0]", "state", 0, 6, When::At(&[1, 2, 3, 4, 5, 6])),
    ];
    draw("ethernet_byte_crc", ByteCrc::default(), &stimuli, 7, &lanes).assert_drawn_in("byte_crc");
}
