//! Proves the exchange in `protocol/SERIAL.md`: the Verilated device says the same at its pins.

use incircle_model::serial::FromDevice;
use incircle_protocol::{rate_step, SMALL, STATUS_BUSY};
use incircle_sim::serial::{Board, PinBoard, Symbol};
use incircle_testkit::exchange_steps;

/// Text of the page.
const PAGE: &str = include_str!("../../../../protocol/SERIAL.md");

/// Rate that the page shows.
const RATE: u32 = 3_000_000;

/// The frames in these bytes, without the fields that depend on how far the core has come when they begin: the room in
/// the FIFO and whether a command is under way.
fn frames(bytes: &[u8]) -> Vec<FromDevice> {
    let lines = bytes.split(|&byte| byte == 0).filter(|line| !line.is_empty());
    let frames = lines.map(|line| FromDevice::from_line(line).expect("a frame"));
    frames.map(|frame| FromDevice { free: 0, status: frame.status & !STATUS_BUSY, ..frame }).collect()
}

#[test]
fn the_device_says_what_the_page_shows() {
    let mut board = PinBoard::new(SMALL).expect("the board is part of this build");
    let clock_hz = board.link().clock_hz;
    let step = rate_step(RATE, clock_hz).expect("a rate").to_le_bytes();
    for (number, (sent, expected)) in exchange_steps(PAGE).into_iter().enumerate() {
        sent.iter().for_each(|&byte| board.send(Symbol::of(byte)));
        let (mut said, mut silent) = (Vec::new(), 0);
        // The device is silent once no byte has come for ten bytes at the first rate.
        while silent < 100 {
            board.run(1085);
            silent = if board.waiting() == 0 { silent + 1 } else { 0 };
            while let Some((_, symbol)) = board.receive() {
                assert!(symbol.is_sound(), "step {number}");
                said.push(symbol.data());
                silent = 0;
            }
        }
        assert_eq!(frames(&said), frames(&expected), "step {number}");
        // The host follows the rate that it has asked for.
        if sent.windows(3).any(|bytes| *bytes == step[..3]) {
            board.set_rate(RATE);
        }
    }
}
