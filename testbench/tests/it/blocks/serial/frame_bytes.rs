//! Runs `FrameBytes` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::FrameBytes;
use incircle_testkit::SplitMix64;

named_ports!(
    FrameBytes,
    [part, index, ends_answer, header, greeting, word, answer, payload_state, answer_state, sum_state],
    [byte_data],
    clock
);

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
