//! The exchange in `protocol/SERIAL.md` is what the Verilated device says at its pins.

use incircle_model::serial::FromDevice;
use incircle_protocol::{rate_step, SMALL, STATUS_BUSY};
use incircle_sim::serial::{Board, PinBoard, Symbol};

const PAGE: &str = include_str!("../../protocol/SERIAL.md");

/// The rate that the page shows.
const RATE: u32 = 3_000_000;

/// Bytes to the device, and the frames that come back.
fn steps() -> Vec<(Vec<u8>, Vec<FromDevice>)> {
    let (_, block) = PAGE.split_once("```line\n").expect("an exchange");
    let block = block.split("```").next().expect("its body");
    let mut steps: Vec<(Vec<u8>, Vec<u8>)> = Vec::new();
    for line in block.lines().filter(|line| !line.is_empty()) {
        let said = line[1..].split(';').next().expect("a first part");
        let bytes = said.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).expect(line));
        match steps.last_mut() {
            Some((_, answer)) if line.starts_with('<') => answer.extend(bytes),
            Some((sent, answer)) if answer.is_empty() => sent.extend(bytes),
            _ => steps.push((bytes.collect(), Vec::new())),
        }
    }
    steps.into_iter().map(|(sent, answer)| (sent, frames(&answer))).collect()
}

/// The frames in these bytes, without what depends on how far the core has come when they begin: the room in the FIFO and whether a
/// command is under way.
fn frames(bytes: &[u8]) -> Vec<FromDevice> {
    let lines = bytes.split(|&byte| byte == 0).filter(|line| !line.is_empty());
    let frames = lines.map(|line| FromDevice::from_line(line).expect("a frame"));
    frames.map(|frame| FromDevice { free: 0, status: frame.status & !STATUS_BUSY, ..frame }).collect()
}

#[test]
fn the_device_says_what_the_page_shows() {
    let mut board = PinBoard::new(SMALL).expect("it was translated");
    let clock_hz = board.link().clock_hz;
    let step = rate_step(RATE, clock_hz).expect("a rate").to_le_bytes();
    for (number, (sent, expected)) in steps().into_iter().enumerate() {
        sent.iter().for_each(|&byte| board.send(Symbol::of(byte)));
        let (mut said, mut silent) = (Vec::new(), 0);
        // Ten bytes at the first rate.
        while silent < 100 {
            board.run(1085);
            silent = if board.waiting() == 0 { silent + 1 } else { 0 };
            while let Some((_, symbol)) = board.receive() {
                assert!(symbol.is_sound(), "step {number}");
                said.push(symbol.data());
                silent = 0;
            }
        }
        assert_eq!(frames(&said), expected, "step {number}");
        // The host follows the rate it has asked for.
        if sent.windows(3).any(|bytes| *bytes == step[..3]) {
            board.set_rate(RATE);
        }
    }
}
