//! Runs `FramePart` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::FramePart;

named_ports!(FramePart, [at, word_byte_is_last], [is_last], clock);

#[test]
fn parts_of_a_frame_end_where_the_page_says() {
    let mut block = Stepper::new("serial_frame_part", FramePart::default(), 1);
    let lengths = [7, 52, 4, 3, 0, 4];
    for (part, length) in lengths.into_iter().enumerate() {
        for index in 0..52 {
            for word_byte_is_last in [false, true] {
                block.set("part", part as u32);
                block.set("index", index as u32);
                block.set("word_byte_is_last", word_byte_is_last);
                block.settle();
                block.edge();
                block.settle();
                block.expect("is_last", if part == 4 { word_byte_is_last } else { index + 1 == length });
            }
        }
    }
}
