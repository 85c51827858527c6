//! Runs `ResetReply` in Rust and in Verilog beside plain code: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::stream::ResetReply;
use incircle_testkit::SplitMix64;

named_ports!([] ResetReply, [request], [resets, reply, beat], clock);

#[test]
fn the_core_is_held_in_reset_and_says_so() {
    let mut random = SplitMix64::new(2);
    let mut block = Stepper::new("stream_reset_reply", ResetReply::new(), 1);
    let mut requests = vec![true; 9];
    let mut request = true;
    let mut beats = Vec::new();
    for clock in 0..3000 {
        if clock > 20 && random.below(15) == 0 {
            request = !request;
        }
        block.set("request", request);
        block.settle();
        if clock > 10 {
            block.expect("reply", requests[ResetReply::LATENCY - 1]);
            block.expect("resets", requests[0] || requests[ResetReply::LATENCY]);
        }
        beats.push(block.get("beat"));
        block.edge();
        requests.insert(0, request);
    }
    let changes: Vec<usize> = (1..beats.len()).filter(|clock| beats[*clock] != beats[clock - 1]).collect();
    assert!(changes.len() > 300 && changes.windows(2).all(|pair| pair[1] - pair[0] == 8), "{changes:?}");
}
