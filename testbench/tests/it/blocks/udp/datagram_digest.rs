//! Runs `DatagramDigest` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::ethernet_frames::frame_sum;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::udp::DatagramDigest;
use incircle_testkit::SplitMix64;

named_ports!(DatagramDigest, [reset, begins, push, push_data, commits], [state], clock);

#[test]
fn digest_covers_the_bytes_that_count() {
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new("udp_datagram_digest", DatagramDigest::default(), 1);
    let (mut committed, mut provisional) = (Vec::new(), Vec::new());
    for clock in 0..20_000 {
        let reset = clock == 0 || random.below(3000) == 0;
        let (begins, commits) = (clock == 1 || random.below(40) == 0, clock > 1 && random.below(30) == 0);
        let push = clock > 1 && !begins && !commits && random.below(3) > 0;
        let byte = random.below(256) as u8;
        for (port, bit) in [("reset", reset), ("begins", begins || commits), ("push", push), ("commits", commits)] {
            block.set(port, bit);
        }
        block.set("push_data", byte);
        block.settle();
        if clock > 0 {
            block.expect("state", !u32::from_le_bytes(frame_sum(&committed)));
        }
        block.edge();
        if commits {
            committed.append(&mut provisional);
        }
        if begins {
            provisional.clear();
        }
        if push {
            provisional.push(byte);
        }
        if reset {
            committed.clear();
            provisional.clear();
            // The next datagram begins behind a reset.
            block.set("reset", false);
            block.set("push", false);
            block.set("commits", false);
            block.set("begins", true);
            block.settle();
            block.edge();
        } else if commits {
            // So it does behind one that counted.
            block.set("commits", false);
            block.set("begins", true);
            block.settle();
            block.edge();
        }
    }
}
