//! Runs `ResetRequest` in Rust and in Verilog beside plain code: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::stream::ResetRequest;
use incircle_testkit::SplitMix64;

named_ports!([] ResetRequest, [reset, asks, reply, core_beat], [request, resets, core_runs], clock);

#[test]
fn a_reset_is_asked_for_until_it_is_answered() {
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new("stream_reset_request", ResetRequest::default(), 1);
    // Whether a reset is requested, for how many clocks, and whether the end of the reply is awaited.
    let (mut requested, mut resetting, mut for_clocks) = (true, true, 0);
    let (mut reply, mut beat, mut still, mut runs, mut seen) = (true, false, 0, false, false);
    let (mut resets, mut stops) = (0, 0);
    for clock in 0..60_000 {
        let reset = clock < 2 || random.below(4000) == 0;
        let asks = random.below(600) == 0;
        // A reply may stand there from before, and may follow soon or late.
        if random.below([2, 30][clock / 3000 % 2]) == 0 {
            reply = requested;
        }
        let is_still = clock / 900 % 3 == 2;
        if !is_still && random.below(9) == 0 {
            beat = !beat;
        }
        for (port, bit) in [("reset", reset), ("asks", asks), ("reply", reply), ("core_beat", beat)] {
            block.set(port, bit);
        }
        block.settle();
        if clock > 2 {
            block.expect("request", requested);
            block.expect("resets", resetting);
            block.expect("core_runs", runs);
        }
        block.edge();
        if resetting && !requested && !reply {
            resetting = false;
        }
        if requested {
            for_clocks += 1;
            if for_clocks >= ResetRequest::LEAST_CLOCKS && reply {
                requested = false;
            }
        }
        if reset || asks {
            resets += usize::from(!resetting);
            (requested, resetting, for_clocks) = (true, true, 0);
        }
        still += 1;
        if still > ResetRequest::MOST_STILL - 1 {
            stops += usize::from(runs);
            runs = false;
        }
        if beat != seen {
            (still, runs) = (0, true);
        }
        if reset {
            (still, runs) = (0, false);
        }
        seen = beat;
    }
    assert!(resets > 50 && stops > 10, "{resets} resets, {stops} stops");
}
