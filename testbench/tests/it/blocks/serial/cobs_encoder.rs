//! Runs `CobsEncoder` in Rust and in Verilog beside plain code: all three must agree.

use super::cobs_decoder::bytes;
use crate::rig::serial_host::reverse_cobs;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::serial::CobsEncoder;
use incircle_testkit::SplitMix64;

named_ports!(
    CobsEncoder,
    [reset, data_valid, data, ends, cuts, byte_ready],
    [data_ready, ended, byte_valid, byte_data],
    clock
);

/// Runs one clock of an encoder. Returns the byte that it gives, whether it takes the byte on offer,
/// and whether the frame is over.
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
