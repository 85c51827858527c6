//! Runs `PayloadDigest` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::serial_host::crc32_state;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::PayloadDigest;
use incircle_testkit::SplitMix64;

named_ports!(PayloadDigest, [reset, begins, push, push_data, commits], [state], clock);

#[test]
fn digest_covers_what_was_committed() {
    let mut random = SplitMix64::new(2);
    let mut block = Stepper::new("serial_payload_digest", PayloadDigest::default(), 1);
    let (mut committed, mut provisional): (Vec<u8>, Vec<u8>) = Default::default();
    for run in 0..1500 {
        let byte = random.below(256) as u8;
        let event = if run == 0 { 0 } else { 1 + random.below(12) };
        for (port, bit) in
            [("reset", event == 0 || run == 700), ("begins", event == 1), ("commits", event == 2), ("push", event > 2)]
        {
            block.set(port, bit);
        }
        block.set("push_data", byte);
        block.settle();
        block.edge();
        match event {
            1 => provisional.clear(),
            2 => committed.append(&mut provisional),
            3.. => provisional.push(byte),
            _ => {}
        }
        if event == 0 || run == 700 {
            committed.clear();
            provisional.clear();
        }
        ["reset", "begins", "commits", "push"].into_iter().for_each(|port| block.set(port, false));
        for _ in 0..9 {
            block.settle();
            block.expect("state", crc32_state(&committed));
            block.edge();
        }
    }
}
