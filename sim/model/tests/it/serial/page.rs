//! The exchange in `protocol/SERIAL.md` is that of the model of the serial link, byte by byte, and the tables of the
//! page have the numbers of the crate.

use incircle_model::serial::{core_identity, FrameReceiver, FromDevice, FromHost, Received, SerialModel};
use incircle_model::ClockModel;
use incircle_protocol::{
    DeviceFrame, HostFrame, LinkConfig, BREAK_MS, FIRST_RATE, FRAME_END, LINK_MAGIC, LINK_VERSION, MAX_PAYLOAD,
    SILENCE_MS, SMALL, WINDOW,
};
use incircle_testkit::exchange_steps;
use std::collections::BTreeSet;

/// The text of the page.
const PAGE: &str = include_str!("../../../../../protocol/SERIAL.md");

/// Number of clocks of a byte while the exchange is replayed.
const BYTE: u64 = 10_850;

/// The serial link of the board that the page shows.
const LINK: LinkConfig = LinkConfig { clock_hz: 125_000_000, fifo_bytes: 4096, silence_ms: 200 };

fn hex(bytes: &[u8]) -> String {
    let bytes: Vec<_> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    bytes.join(" ")
}

#[test]
fn the_model_says_what_the_page_shows() {
    let core = ClockModel::new(SMALL).expect("a named configuration");
    let mut board = SerialModel::new(LINK, core_identity(SMALL), core);
    for (sent, expected) in exchange_steps(PAGE) {
        let (mut said, mut silent) = (Vec::new(), 0);
        let mut sending = sent.iter();
        while silent < 10 {
            board.pass(BYTE);
            silent += 1;
            if let Some(&byte) = sending.next() {
                board.take(byte);
                silent = 0;
            }
            if let Some(byte) = board.give() {
                said.push(byte);
                silent = 0;
            }
        }
        assert_eq!(hex(&said), hex(&expected), "answer to {}", hex(&sent));
    }
    assert!(board.is_at_rest());
}

#[test]
fn the_exchange_shows_the_kinds_of_frames() {
    let (mut asked, mut said) = (BTreeSet::new(), BTreeSet::new());
    let mut receiver = FrameReceiver::new();
    for (sent, answer) in exchange_steps(PAGE) {
        for frame in sent.iter().filter_map(|&byte| receiver.take(byte)) {
            if let Received::Frame(FromHost { kind, .. }) = frame {
                asked.insert(kind as u8);
            }
        }
        for line in answer.split(|&byte| byte == FRAME_END).filter(|line| !line.is_empty()) {
            said.insert(FromDevice::from_line(line).expect("a frame").kind as u8);
        }
    }
    assert_eq!(asked, BTreeSet::from([1, 2, 3, 4, 5, 6]));
    // `Answer` is missing, since such an answer would fill the page.
    assert_eq!(said, BTreeSet::from([0x81, 0x82, 0x83, 0x84, 0x86, 0x87, 0x88]));
}

#[test]
fn the_tables_and_the_prose_have_the_numbers_of_the_crate() {
    let thousands = |number: u32| format!("{},{:03}", number / 1000, number % 1000);
    let mut pieces: Vec<String> = Vec::new();
    pieces.extend((0..=255).filter_map(HostFrame::from_u8).map(|it| format!("| {:02x} | `{it:?}` |", it as u8)));
    pieces.extend((0..=255).filter_map(DeviceFrame::from_u8).map(|it| format!("| {:02x} | `{it:?}` |", it as u8)));
    pieces.extend([
        format!("Link version {}.{}.", LINK_VERSION >> 16, LINK_VERSION & 0xffff),
        format!("(`{LINK_MAGIC:08x}`)"),
        format!("{} bits per second after reset", thousands(FIRST_RATE)),
        format!("0 to {}", thousands(MAX_PAYLOAD as u32)),
        format!("at most {WINDOW} `Data` frames"),
        "low for a millisecond".to_owned(),
        "Two seconds without a valid frame".to_owned(),
    ]);
    assert_eq!((BREAK_MS, SILENCE_MS), (1, 2000));
    for piece in pieces {
        assert!(PAGE.contains(&piece), "not said: {piece}");
    }
}
