//! Runs `MacOut` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::ethernet_frames::sealed;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::ethernet::MacOut;
use incircle_testkit::SplitMix64;

named_ports!(MacOut, [reset, waits, byte_data, byte_is_last], [begins, data_valid, data], clock);

fn idle(block: &mut Stepper<MacOut>) {
    for (port, value) in [("reset", true), ("waits", false), ("byte_is_last", false)] {
        block.set(port, value);
    }
    block.set("byte_data", 0u8);
    block.settle();
    block.edge();
    block.set("reset", false);
}

/// Sends the frames, each after the clocks that `pause` gives for it. Returns what the line shows from the first byte
/// on, in each clock a byte or nothing.
fn send(block: &mut Stepper<MacOut>, frames: &[Vec<u8>], mut pause: impl FnMut() -> u64) -> Vec<Option<u8>> {
    let mut line = Vec::new();
    for frame in frames {
        let mut left = pause();
        let mut since_begin: Option<usize> = None;
        loop {
            let at = since_begin.and_then(|since| since.checked_sub(MacOut::LEAD));
            block.set("waits", left == 0 && since_begin.is_none());
            block.set("byte_data", at.map_or(0xee, |at| frame[at]));
            block.set("byte_is_last", at.is_some_and(|at| at + 1 == frame.len()));
            block.settle();
            line.push(block.is("data_valid").then(|| block.get("data") as u8));
            let begins = block.is("begins");
            block.edge();
            left = left.saturating_sub(1);
            since_begin = if begins { Some(1) } else { since_begin.map(|since| since + 1) };
            if at.is_some_and(|at| at + 1 == frame.len()) {
                break;
            }
        }
    }
    block.set("waits", false);
    block.set("byte_is_last", false);
    for _ in 0..100 {
        block.settle();
        line.push(block.is("data_valid").then(|| block.get("data") as u8));
        block.edge();
    }
    line
}

#[test]
fn frames_are_padded_summed_and_kept_apart() {
    let mut random = SplitMix64::new(9);
    let mut block = Stepper::new("ethernet_mac_out", MacOut::default(), 1);
    idle(&mut block);
    let lengths = [1, 59, 60, 61, 42, 1514, 58];
    let frames: Vec<Vec<u8>> =
        (0..28).map(|run| (0..lengths[run % lengths.len()]).map(|_| random.below(256) as u8).collect()).collect();
    for most in [1, 40] {
        let mut pauses = random.clone();
        let line = send(&mut block, &frames, || pauses.below(most));
        let sent: Vec<&[Option<u8>]> = line.split(Option::is_none).filter(|run| !run.is_empty()).collect();
        assert_eq!(sent.len(), frames.len());
        for (run, frame) in sent.iter().zip(&frames) {
            let bytes: Vec<u8> = run.iter().flatten().copied().collect();
            let expected = [vec![0x55; 7], vec![0xd5], sealed(frame.clone())].concat();
            assert!(bytes == expected, "a frame of {} bytes", frame.len());
        }
        let gaps: Vec<usize> = line.split(Option::is_some).map(<[_]>::len).filter(|gap| *gap > 0).collect();
        let between = &gaps[1..gaps.len() - 1];
        assert!(between.iter().all(|gap| *gap >= 12), "{between:?}");
        assert!(most > 1 || between.iter().all(|gap| *gap == 12), "{between:?}");
    }
}

#[test]
fn wave_of_the_end_of_a_frame() {
    let mut block = Stepper::new("ethernet_mac_out", MacOut::default(), 1);
    idle(&mut block);
    let mut wave = Wave::default();
    let (mut since_begin, mut drawn) = (None, 0);
    while drawn < 10 {
        let byte: Option<usize> = since_begin.and_then(|since: usize| since.checked_sub(MacOut::LEAD));
        let is_last = byte == Some(63);
        block.set("waits", since_begin.is_none());
        block.set("byte_is_last", is_last);
        block.settle();
        let begins = block.is("begins");
        if byte.is_some_and(|byte| byte >= 62) {
            let valid = Cell::Bit(block.is("data_valid"));
            wave.take(&[("clock", Cell::Number(drawn)), ("byte_is_last", Cell::Bit(is_last)), ("data_valid", valid)]);
            drawn += 1;
        }
        block.edge();
        since_begin = if begins { Some(1) } else { since_begin.map(|since| since + 1) };
    }
    wave.assert_drawn_in("mac_out");
}
