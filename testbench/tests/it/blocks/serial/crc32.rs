//! Runs `Crc32` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::serial_host::crc32_state;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::Crc32;
use incircle_testkit::SplitMix64;

named_ports!(Crc32, [sets, start, takes, byte_data], [is_busy, state], clock);

#[test]
fn check_sums_run() {
    let mut random = SplitMix64::new(7);
    let mut block = Stepper::new("serial_crc32", Crc32::default(), 1);
    for run in 0..60 {
        let start = if run % 2 == 0 { u32::MAX } else { random.below(1 << 32) as u32 };
        let bytes: Vec<u8> = (0..random.below(40)).map(|_| random.below(256) as u8).collect();
        for (port, value) in [("sets", 1), ("start", start), ("takes", (run % 3 == 0).into()), ("byte_data", 0x77)] {
            block.set(port, value);
        }
        block.settle();
        block.edge();
        block.set("sets", false);
        // Any other state is one to which some bytes lead: go on from there a byte at a time.
        let mut expected = start;
        for byte in bytes {
            block.set("takes", true);
            block.set("byte_data", byte);
            block.settle();
            block.expect("state", expected);
            block.expect("is_busy", false);
            block.edge();
            block.set("takes", false);
            for _ in 0..8 {
                block.settle();
                block.expect("is_busy", true);
                block.edge();
            }
            // From a state s a byte leads to where the byte xor the low byte of s leads from 0,
            // xor the upper bytes of s.
            let from_zero = crc32_state(&[byte ^ expected as u8 ^ 0xff]) ^ 0x00ff_ffff;
            expected = from_zero ^ expected >> 8;
            for _ in 0..random.below(3) {
                block.settle();
                block.expect("state", expected);
                block.edge();
            }
        }
        block.settle();
        block.expect("state", expected);
    }
    assert_eq!(!crc32_state(b"123456789"), 0xcbf4_3926);
    assert_eq!(crc32_state(&[b"a".as_slice(), &(!crc32_state(b"a")).to_le_bytes()].concat()), Crc32::SOUND as u32);
}
