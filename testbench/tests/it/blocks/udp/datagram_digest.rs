//! Runs `DatagramDigest` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::drawing::{draw, When};
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

#[test]
fn wave_of_bytes_that_count_and_of_one_that_does_not() {
    let mut stimuli = vec![(0, "begins", 1), (4, "commits", 1), (6, "begins", 1), (9, "begins", 1)];
    for (clock, byte) in [(1, 49), (2, 50), (7, 51)] {
        stimuli.extend([(clock, "push", 1), (clock, "push_data", byte)]);
    }
    let lanes = [
        ("begins", "begins", 0, 1, When::Always),
        ("push", "push", 0, 1, When::Always),
        ("push_data", "push_data", 0, 8, When::If("push")),
        ("commits", "commits", 0, 1, When::Always),
        ("state[5:0]", "state", 0, 6, When::Always),
    ];
    draw("udp_datagram_digest", DatagramDigest::default(), &stimuli, 11, &lanes).assert_drawn_in("datagram_digest");
}
