//! Runs `CobsDecoder` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::serial_host::cobs;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::serial::CobsDecoder;
use incircle_testkit::SplitMix64;

named_ports!(CobsDecoder, [reset, byte_valid, byte_data, noise], [data_valid, data, frame_ends, is_broken], clock);

/// Bytes with runs of zeros and of others, up to beyond the longest piece of COBS.
pub fn bytes(random: &mut SplitMix64) -> Vec<u8> {
    let mut bytes = Vec::new();
    for _ in 0..1 + random.below(4) {
        let count = [0, 1, random.below(20), 253, 254, 255, random.below(600)][random.below(7) as usize];
        let zeros = [0, 2, 16, 256][random.below(4) as usize];
        bytes.extend((0..count).map(|_| if random.below(256) < zeros { 0 } else { 1 + random.below(255) as u8 }));
    }
    bytes
}

/// An output of a decoder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Decoded {
    Byte(u8),
    End { is_broken: bool },
}

/// Decodes a frame from COBS, piece by piece; `lacks` says that a byte of it was lost on the line.
fn decoded(mut encoded: &[u8], lacks: bool) -> Vec<Decoded> {
    let mut seen = Vec::new();
    let (mut owes_zero, mut is_broken) = (false, lacks);
    while let [length, rest @ ..] = encoded {
        if owes_zero {
            seen.push(Decoded::Byte(0));
        }
        owes_zero = *length != 255;
        let whole = usize::from(*length) - 1;
        let piece = &rest[..whole.min(rest.len())];
        is_broken |= piece.len() < whole;
        seen.extend(piece.iter().map(|byte| Decoded::Byte(*byte)));
        encoded = &rest[piece.len()..];
    }
    seen.push(Decoded::End { is_broken });
    seen
}

/// Runs one clock of a decoder, and returns its output.
fn decoder_clock(block: &mut Stepper<CobsDecoder>, byte: Option<u8>, noise: bool) -> Option<Decoded> {
    block.set("byte_valid", byte.is_some());
    block.set("byte_data", byte.unwrap_or(0x55));
    block.set("noise", noise);
    block.settle();
    let mut seen = None;
    if block.clocks() > 0 {
        if block.is("data_valid") {
            seen = Some(Decoded::Byte(block.get("data") as u8));
        }
        if block.is("frame_ends") {
            assert_eq!(seen, None);
            seen = Some(Decoded::End { is_broken: block.is("is_broken") });
        }
    }
    block.edge();
    seen
}

fn new_decoder() -> Stepper<CobsDecoder> {
    let mut block = Stepper::new("serial_cobs_decoder", CobsDecoder::default(), 1);
    block.set("reset", true);
    decoder_clock(&mut block, None, false);
    block.set("reset", false);
    block
}

#[test]
fn decoder_takes_frames_out_of_cobs_and_tells_broken_ones() {
    let mut random = SplitMix64::new(1);
    let mut block = new_decoder();
    let mut ends = [0; 2];
    for run in 0..300 {
        let mut line = match run % 4 {
            0 | 1 => cobs(&bytes(&mut random)),
            2 => cobs(&bytes(&mut random)).into_iter().filter(|byte| *byte == 0 || random.below(40) > 0).collect(),
            _ => (0..random.below(60)).map(|_| 1 + random.below(255) as u8).chain([0]).collect(),
        };
        if line.len() == 1 {
            // Two zeros with nothing in between hold no frame.
            line.push(0);
        }
        let noise_at = (run % 5 == 4).then(|| random.below(line.len() as u64) as usize);
        let mut seen = Vec::new();
        for (place, byte) in line.iter().enumerate() {
            if noise_at == Some(place) {
                seen.extend(decoder_clock(&mut block, None, true));
            }
            seen.extend(decoder_clock(&mut block, Some(*byte), false));
            for _ in 0..random.below(3) {
                seen.extend(decoder_clock(&mut block, None, false));
            }
        }
        seen.extend(decoder_clock(&mut block, None, false));
        let frame = line.split(|byte| *byte == 0).next().expect("what stands before the first zero");
        let is_hit = noise_at.is_some_and(|place| place > 0 && place <= frame.len());
        let expected = if frame.is_empty() { Vec::new() } else { decoded(frame, is_hit) };
        assert_eq!(seen, expected, "run {run}");
        if let Some(Decoded::End { is_broken }) = seen.last() {
            ends[usize::from(*is_broken)] += 1;
        }
    }
    assert!(ends.iter().all(|count| *count > 50), "{ends:?} frames whole and broken");
}

#[test]
fn decoder_shows_the_wave_of_its_header() {
    let mut block = new_decoder();
    let mut wave = Wave::default();
    let line = [None, Some(2), None, Some(11), Some(2), Some(22), Some(0), Some(0), None, Some(5), Some(33), Some(0)];
    for byte in line.into_iter().chain([None; 4]) {
        let seen = decoder_clock(&mut block, byte, false);
        let number = |byte: Option<u8>| byte.map_or(Cell::Open, |byte| Cell::Number(byte.into()));
        let data = if let Some(Decoded::Byte(data)) = seen { Some(data) } else { None };
        wave.take(&[
            ("byte_valid", Cell::Bit(byte.is_some())),
            ("byte_data", number(byte)),
            ("data_valid", Cell::Bit(data.is_some())),
            ("data", number(data)),
            ("frame_ends", Cell::Bit(matches!(seen, Some(Decoded::End { .. })))),
            ("is_broken", Cell::Bit(matches!(seen, Some(Decoded::End { is_broken: true })))),
        ]);
    }
    wave.assert_drawn_in("cobs_decoder");
}
