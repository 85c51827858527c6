//! Runs `FrameReader` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::serial_host::{crc32, host_frame};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::FrameReader;
use incircle_testkit::SplitMix64;

named_ports!(
    FrameReader,
    [reset, data_valid, data, frame_ends, is_broken],
    [head, header_comes, payload_valid, payload, value, comes, is_sound],
    clock
);

/// Runs one clock of a reader.
fn reader_clock(block: &mut Stepper<FrameReader>, byte: Option<u8>, end: Option<bool>) {
    block.set("data_valid", byte.is_some());
    block.set("data", byte.unwrap_or(0x33));
    block.set("frame_ends", end.is_some());
    block.set("is_broken", end.unwrap_or(true));
    block.settle();
}

#[test]
fn reader_gives_payload_as_it_comes_and_says_which_frames_are_sound() {
    let mut random = SplitMix64::new(3);
    let mut block = Stepper::new("serial_frame_reader", FrameReader::default(), 1);
    block.set("reset", true);
    reader_clock(&mut block, None, None);
    block.edge();
    block.set("reset", false);
    let mut judged = [0; 2];
    for run in 0..150 {
        let length = [0, 4, 1024, random.below(40) as usize][run % 4];
        let payload: Vec<u8> = (0..length).map(|_| random.below(256) as u8).collect();
        let mut frame = host_frame(random.below(256) as u8, random.below(256) as u8, random.below(256) as u8, &payload);
        let mut is_broken = false;
        match run % 7 {
            1 => frame.truncate(random.below(frame.len() as u64) as usize),
            2 => frame.push(random.below(256) as u8),
            3 => {
                let place = random.below(frame.len() as u64) as usize;
                frame[place] ^= 1 << random.below(8);
            }
            4 => is_broken = true,
            5 => {
                // A frame that is too long has a good check sum here.
                frame = host_frame(1, 5, 0, &vec![7; 1025 + random.below(200) as usize]);
            }
            _ => {}
        }
        let mut seen = Vec::new();
        let mut headers = 0;
        for place in 0..=frame.len() {
            let byte = frame.get(place).copied();
            reader_clock(&mut block, byte, byte.is_none().then_some(is_broken));
            let mut gap = 15 + random.below(3);
            loop {
                assert!(!block.is("comes"));
                block.edge();
                reader_clock(&mut block, None, None);
                if block.is("payload_valid") {
                    seen.push(block.get("payload") as u8);
                }
                headers += usize::from(block.is("header_comes"));
                if byte.is_none() || gap == 0 {
                    break;
                }
                gap -= 1;
            }
        }
        let said = |low: usize| frame.get(low).copied();
        let length = said(3).zip(said(4)).map(|(low, high)| usize::from(low) | usize::from(high) << 8);
        let is_short_enough = length.is_some_and(|length| length <= 1024);
        let held = length.filter(|_| is_short_enough).unwrap_or(0).min(frame.len().saturating_sub(5));
        let held = &frame[frame.len().min(5)..][..held];
        let is_sound = !is_broken
            && is_short_enough
            && frame.len() == 9 + length.expect("a length")
            && frame[frame.len() - 4..] == crc32(&frame[..frame.len() - 4]).to_le_bytes();
        assert_eq!(seen, held, "run {run}");
        assert_eq!(headers, usize::from(is_short_enough));
        assert!(block.is("comes"));
        block.expect("is_sound", is_sound);
        if is_short_enough {
            for (port, place) in [("session", 0), ("kind", 1), ("number", 2)] {
                block.expect(port, frame[place]);
            }
            block.expect("length", length.expect("a length") as u64);
        }
        if let Some(last) = held.last_chunk::<4>() {
            block.expect("value", u32::from_le_bytes(*last));
        }
        judged[usize::from(is_sound)] += 1;
        for _ in 0..random.below(20) {
            block.edge();
            reader_clock(&mut block, None, None);
            assert!(!block.is("comes"));
        }
        block.edge();
    }
    assert!(judged.iter().all(|count| *count > 30), "{judged:?} frames dropped and sound");
}
