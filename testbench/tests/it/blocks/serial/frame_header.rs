//! Runs `FrameHeader` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::FrameHeader;
use incircle_testkit::SplitMix64;

named_ports!(
    FrameHeader,
    [reset, starts, open, answers, receipt, is_refused, is_busy, drops, kind, index],
    [byte_data, digest_taken],
    clock
);

#[test]
fn header_says_what_was_true_when_the_frame_began() {
    let mut random = SplitMix64::new(8);
    let mut block = Stepper::new("serial_frame_header", FrameHeader::default(), 1);
    let (mut header, mut digest, mut has_dropped) = ([0u8; 7], 0, false);
    for clock in 0..6000 {
        let [session, expected, answers, kind] = [0; 4].map(|_: u8| random.below(256) as u8);
        let (free, state) = (random.below(1 << 16) as u16, random.below(1 << 32) as u32);
        let [is_open, is_refused, is_busy] = [0; 3].map(|_: u8| random.below(2) == 0);
        let (starts, drops) = (clock == 1 || clock > 1 && random.below(9) == 0, random.below(12) == 0);
        let index = random.below(7) as usize;
        let reset = clock == 0;
        for (port, value) in [
            ("open_number", session.into()),
            ("expected", expected.into()),
            ("answers", answers.into()),
            ("kind", kind.into()),
            ("free", free.into()),
            ("digest", state),
            ("is_open", is_open.into()),
            ("is_refused", is_refused.into()),
            ("is_busy", is_busy.into()),
            ("starts", starts.into()),
            ("drops", drops.into()),
            ("reset", reset.into()),
            ("index", index as u32),
        ] {
            block.set(port, value);
        }
        block.settle();
        if clock > 1 {
            header[1] = kind;
            block.expect("byte_data", header[index]);
            block.expect("digest_taken", digest);
        }
        block.edge();
        if starts {
            let [low, high] = free.to_le_bytes();
            let status = [is_open, is_refused, has_dropped, is_busy]
                .iter()
                .rev()
                .fold(0, |status, bit| status << 1 | u8::from(*bit));
            (header, digest) = ([session, kind, expected, answers, low, high, status], state);
            has_dropped = false;
        }
        has_dropped = (has_dropped || drops) && !reset;
    }
}
