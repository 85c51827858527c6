//! COBS towards the device, and reverse COBS towards the host. Rust, Verilog and plain code agree.

use crate::rig::serial_host::{cobs, reverse_cobs};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::serial::{CobsDecoder, CobsEncoder};

named_ports!(CobsDecoder, [reset, byte_valid, byte_data, noise], [data_valid, data, frame_ends, is_broken], clock);
named_ports!(
    CobsEncoder,
    [reset, data_valid, data, ends, cuts, byte_ready],
    [data_ready, ended, byte_valid, byte_data],
    clock
);
/// Bytes with runs of zeros and of others, up to beyond the longest piece of COBS.
fn bytes(random: &mut SplitMix64) -> Vec<u8> {
    let mut bytes = Vec::new();
    for _ in 0..1 + random.below(4) {
        let count = [0, 1, random.below(20), 253, 254, 255, random.below(600)][random.below(7) as usize];
        let zeros = [0, 2, 16, 256][random.below(4) as usize];
        bytes.extend((0..count).map(|_| if random.below(256) < zeros { 0 } else { 1 + random.below(255) as u8 }));
    }
    bytes
}

/// What a decoder gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Decoded {
    Byte(u8),
    End { is_broken: bool },
}

/// A frame out of COBS, piece by piece; `lacks` if a byte of it was lost on the line.
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

/// One clock of a decoder, and what it gives in it.
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
            // Nothing between two zeros: no frame.
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

/// One clock of an encoder: the byte it gives, whether it takes the one it is offered, whether the frame is over.
fn encoder_clock(
    block: &mut Stepper<CobsEncoder>,
    offered: Option<u8>,
    [ends, cuts, is_ready]: [bool; 3],
) -> (Option<u8>, bool, bool) {
    block.set("data_valid", offered.is_some());
    block.set("data", offered.unwrap_or(0));
    for (port, bit) in [("ends", ends), ("cuts", cuts), ("byte_ready", is_ready)] {
        block.set(port, bit);
    }
    block.settle();
    let mut seen = (None, false, false);
    if block.clocks() > 0 {
        let gives = block.is("byte_valid");
        seen.0 = (gives && is_ready).then(|| block.get("byte_data") as u8);
        seen.1 = offered.is_some() && block.is("data_ready");
        seen.2 = block.is("ended");
    }
    block.edge();
    seen
}

fn new_encoder() -> Stepper<CobsEncoder> {
    let mut block = Stepper::new("serial_cobs_encoder", CobsEncoder::default(), 1);
    block.set("reset", true);
    encoder_clock(&mut block, None, [false; 3]);
    block.set("reset", false);
    block
}

#[test]
fn encoder_puts_frames_into_reverse_cobs_under_any_back_pressure() {
    let mut random = SplitMix64::new(2);
    let mut block = new_encoder();
    for run in 0..200 {
        let frame = bytes(&mut random);
        let cut_at = (run % 4 == 3).then(|| random.below(frame.len() as u64 + 1) as usize);
        let (idle, busy) = ([1, 3][run % 2], [1, 4][run / 2 % 2]);
        let (mut next, mut offers, mut line) = (0, false, Vec::new());
        loop {
            let is_cut = cut_at.is_some_and(|place| next >= place);
            offers = !is_cut && next < frame.len() && (offers || random.below(idle) == 0);
            let offered = offers.then(|| frame[next]);
            let ends = is_cut || next == frame.len();
            let (byte, is_taken, ended) = encoder_clock(&mut block, offered, [ends, is_cut, random.below(busy) == 0]);
            line.extend(byte);
            if is_taken {
                (next, offers) = (next + 1, false);
            }
            if ended {
                break;
            }
        }
        if cut_at.is_some() {
            let whole = reverse_cobs(&frame[..next]);
            assert_eq!(line[..line.len() - 1], whole[..whole.len() - 2], "run {run}");
            assert_eq!(line.last(), Some(&0));
        } else {
            assert_eq!(line, reverse_cobs(&frame), "run {run}");
        }
    }
}

#[test]
fn encoder_shows_the_wave_of_its_header() {
    let mut block = new_encoder();
    let mut wave = Wave::default();
    let frame = [11, 0, 22];
    let mut next = 0;
    for clock in 0..14 {
        let is_begun = (1..13).contains(&clock);
        let offered = frame.get(next).copied().filter(|_| is_begun);
        let ends = is_begun && offered.is_none();
        let is_ready = clock % 2 == 0;
        let (byte, is_taken, ended) = encoder_clock(&mut block, offered, [ends, false, is_ready]);
        next += usize::from(is_taken);
        let number = |byte: Option<u8>| byte.map_or(Cell::Open, |byte| Cell::Number(byte.into()));
        wave.take(&[
            ("data_valid", Cell::Bit(offered.is_some())),
            ("data", number(offered)),
            ("data_ready", Cell::Bit(is_taken)),
            ("ends", Cell::Bit(ends)),
            ("byte_ready", Cell::Bit(is_ready)),
            ("byte_data", number(byte)),
            ("ended", Cell::Bit(ended)),
        ]);
        if ended {
            next = usize::MAX;
            break;
        }
    }
    assert_eq!(next, usize::MAX, "the frame is over");
    wave.assert_drawn_in("cobs_encoder");
}
