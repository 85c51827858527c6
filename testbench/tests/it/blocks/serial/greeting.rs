//! Runs `Greeting` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_blocks::QUICK_LINK;
use incircle_hdl::serial::Greeting;
use incircle_protocol::{CORE_VERSION, SMALL};

named_ports!(Greeting, [index], [byte_data], clock);

#[test]
fn greeting_is_that_of_the_page() {
    let mut block = Stepper::new("serial_greeting", Greeting::new(SMALL, QUICK_LINK), 1);
    let words = [
        0x696e_436c,
        0x0001_0000,
        QUICK_LINK.clock_hz,
        QUICK_LINK.fifo_bytes,
        QUICK_LINK.clock_hz / 8,
        QUICK_LINK.silence_ms,
        0x696e_4369,
        0x0002_0000,
        CORE_VERSION,
        16,
        SMALL.points,
        1 << 8 | SMALL.contexts,
        2 << 16 | SMALL.ring,
    ];
    for index in 0..52 {
        block.set("index", index as u32);
        block.settle();
        block.edge();
        block.settle();
        block.expect("byte_data", words[index / 4].to_le_bytes()[index % 4]);
    }
}
