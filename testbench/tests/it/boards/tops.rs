//! Runs the boards' tops in simulation with a tiny device behind them: reset waits for the PLL, and
//! every pin leads to its port.

use incircle_blocks::QUICK_LINK;
use incircle_hdl::board::BOARDS;
use incircle_protocol::{FIRST_RATE, LINK_MAGIC};
use incircle_testbench::blocks;
use verilated::{Model, PortId};

/// Clocks until the model of the PLL in `cells/EHXPLLL.v` is locked.
const LOCKED: usize = 100;
/// Clocks that the reset lasts after that, with the two of the synchroniser.
const CALM: usize = 2 + 255 + 1;

/// Clocks of one bit at the first rate.
const BIT: f64 = QUICK_LINK.clock_hz as f64 / FIRST_RATE as f64;

fn port(model: &Model, name: &str) -> PortId {
    model.port(name).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn reset_waits_for_the_lock_and_obeys_the_button() {
    let mut model = blocks::model("board_clock");
    let [asks_reset, reset] = ["asks_reset", "reset"].map(|name| port(&model, name));
    let mut shown = |asks: bool, clocks: usize| {
        model.set(asks_reset, u64::from(asks));
        let clocks = (0..clocks).map(|_| {
            let shown = model.get(reset) == 1;
            model.clock();
            shown
        });
        clocks.collect::<Vec<_>>()
    };
    let begin = shown(false, 1000);
    assert_eq!(begin.iter().position(|is_reset| !is_reset), Some(LOCKED + CALM));
    assert!(begin[LOCKED + CALM..].iter().all(|is_reset| !is_reset));
    // The button is pressed for a few clocks, let go, and pressed again before the wait is over.
    let pressed = shown(true, 5);
    assert_eq!(pressed, [false, false, false, true, true]);
    assert!(shown(false, 200).iter().all(|is_reset| *is_reset));
    assert!(shown(true, 1).iter().all(|is_reset| *is_reset));
    let released = shown(false, 1000);
    assert_eq!(released.iter().position(|is_reset| !is_reset), Some(CALM));
}

/// Computes the check sum of frames bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), step))
}

/// Bytes of the frame `Hello` on the line.
fn hello() -> Vec<u8> {
    let mut frame = vec![1, 1, 0, 0, 0];
    frame.extend(crc32(&frame).to_le_bytes());
    let mut line = Vec::new();
    for piece in frame.split(|byte| *byte == 0) {
        line.push(piece.len() as u8 + 1);
        line.extend(piece);
    }
    line.push(0);
    line
}

/// Level of the line at each clock: the bytes with start and stop bits at the first rate.
fn waveform(bytes: &[u8]) -> Vec<bool> {
    let bits = bytes.iter().flat_map(|&byte| {
        let data = (0..8).map(move |bit| byte >> bit & 1 == 1);
        std::iter::once(false).chain(data).chain([true])
    });
    let bits: Vec<_> = bits.collect();
    let clocks = (bits.len() as f64 * BIT) as usize;
    (0..clocks).map(|clock| bits[(clock as f64 / BIT) as usize]).collect()
}

/// Bytes that a line carries.
fn bytes(line: &[bool]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut clock = 0;
    while let Some(start) = line[clock..].iter().position(|level| !level) {
        let bit = |number: usize| line.get(clock + start + ((number as f64 + 0.5) * BIT) as usize).copied();
        let data = (0..8).filter(|number| bit(1 + number) == Some(true));
        bytes.push(data.fold(0, |byte, number| byte | 1 << number));
        assert_ne!(bit(9), Some(false), "a stop bit is missing");
        clock += start + (9.5 * BIT) as usize;
        if clock >= line.len() {
            break;
        }
    }
    bytes
}

#[test]
fn every_board_greets_its_host() {
    for board in BOARDS {
        let mut model = blocks::randomized(&format!("board_{}", board.top), 1);
        let [rx, button, tx, lamps] = ["rx", "button", "tx", "lamps"].map(|name| port(&model, name));
        model.set(button, 0);
        let mut run = |levels: &[bool]| {
            let clocks = levels.iter().map(|&level| {
                model.set(rx, u64::from(level));
                model.clock();
                model.get(tx) == 1
            });
            clocks.collect::<Vec<_>>()
        };
        run(&vec![true; LOCKED + CALM + 50]);
        let mut answer = run(&waveform(&hello()));
        answer.extend(run(&vec![true; 12_000]));
        let answer = bytes(&answer);
        let magic = LINK_MAGIC.to_le_bytes();
        assert!(answer.windows(4).any(|window| window == magic), "{}: {answer:02x?}", board.name);
        assert_eq!(answer.last(), Some(&0), "{}: {answer:02x?}", board.name);
        // The lamps say that nothing is under way and nothing was dropped.
        assert_eq!(model.get(lamps) >> 1, 0, "{}", board.name);
    }
}
