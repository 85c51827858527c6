//! Runs `UartReceiver` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::serial_host::Talker;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::UartReceiver;
use incircle_protocol::MAX_STEP;
use incircle_testkit::SplitMix64;

named_ports!(UartReceiver, [reset, step, rx], [byte_valid, byte_data, noise, is_low], clock);

const TURN: u64 = 1 << 24;

/// A receiver, and the bytes and noise that it has reported.
struct Receiving {
    block: Stepper<UartReceiver>,
    bytes: Vec<u8>,
    noise: usize,
}

impl Receiving {
    fn new() -> Self {
        let mut this =
            Self { block: Stepper::new("serial_uart_receiver", UartReceiver::new(), 2), bytes: Vec::new(), noise: 0 };
        this.block.set("step", MAX_STEP);
        this.block.set("reset", true);
        for _ in 0..8 {
            this.clock(true);
        }
        this.block.set("reset", false);
        (this.bytes, this.noise) = (Vec::new(), 0);
        this
    }

    fn clock(&mut self, rx: bool) {
        self.block.set("rx", rx);
        self.block.settle();
        if self.block.clocks() > 4 {
            if self.block.is("byte_valid") {
                self.bytes.push(self.block.get("byte_data") as u8);
            }
            self.noise += usize::from(self.block.is("noise"));
            self.block.get("is_low");
        }
        self.block.edge();
    }
}

/// Rates from the fastest to slow ones, in clocks per bit.
pub fn clocks_per_bit(run: usize, random: &mut SplitMix64) -> f64 {
    match run % 4 {
        0 => 8.0,
        1 => 8.0 + random.below(4000) as f64 / 1000.0,
        2 => 10.416_667,
        _ => 12.0 + random.below(120_000) as f64 / 1000.0,
    }
}

#[test]
fn receiver_takes_bytes_of_a_line_that_is_two_percent_off() {
    let mut random = SplitMix64::new(3);
    let mut receiving = Receiving::new();
    for run in 0..48 {
        let nominal = clocks_per_bit(run, &mut random);
        let off = [0.98, 1.0, 1.02][run % 3];
        receiving.block.set("step", (TURN as f64 / nominal).round() as u32);
        let mut talker = Talker::new(nominal * off);
        let said: Vec<u8> = (0..24).map(|_| random.below(256) as u8).collect();
        for byte in &said {
            talker.say(&[*byte]);
            if random.below(3) == 0 {
                talker.hold(true, random.below(15) as usize);
            }
        }
        while !talker.is_silent() {
            let level = talker.clock();
            receiving.clock(level);
        }
        for _ in 0..2 * nominal as usize {
            receiving.clock(true);
        }
        assert_eq!(std::mem::take(&mut receiving.bytes), said, "{nominal} clocks a bit, {off} of them");
        assert_eq!(receiving.noise, 0);
    }
}

#[test]
fn receiver_outvotes_a_spike_in_every_bit() {
    let mut random = SplitMix64::new(4);
    let mut receiving = Receiving::new();
    for run in 0..16 {
        let nominal = clocks_per_bit(run, &mut random).floor();
        receiving.block.set("step", (TURN as f64 / nominal).round() as u32);
        let said: Vec<u8> = (0..12).map(|_| random.below(256) as u8).collect();
        let mut talker = Talker::new(nominal);
        talker.say(&said);
        // One clock of each bit is wrong; the wrong clock of a start bit does not move its beginning.
        let mut place = 0u64;
        let mut spike = 0;
        while !talker.is_silent() {
            if place.is_multiple_of(nominal as u64) {
                spike = 2 + random.below(nominal as u64 / 2 - 1);
            }
            let level = talker.clock() ^ (place % nominal as u64 == spike);
            receiving.clock(level);
            place += 1;
        }
        for _ in 0..2 * nominal as usize {
            receiving.clock(true);
        }
        assert_eq!((std::mem::take(&mut receiving.bytes), receiving.noise), (said, 0), "{nominal} clocks a bit");
    }
}

#[test]
fn receiver_ignores_glitches_and_tells_a_missing_stop_bit_once() {
    let mut random = SplitMix64::new(5);
    let mut receiving = Receiving::new();
    for run in 0..24 {
        let nominal = clocks_per_bit(run, &mut random);
        receiving.block.set("step", (TURN as f64 / nominal).round() as u32);
        // A glitch shorter than half a bit is no start bit.
        for clock in 0..4 * nominal as usize {
            receiving.clock(clock >= nominal as usize / 2 - 2);
        }
        assert_eq!((receiving.bytes.len(), receiving.noise), (0, 0));
        // A break, then a byte.
        let mut talker = Talker::new(nominal);
        talker.hold(false, 10 + random.below(40) as usize);
        talker.hold(true, 1);
        talker.say(&[0x5a]);
        while !talker.is_silent() {
            let level = talker.clock();
            receiving.clock(level);
        }
        for _ in 0..2 * nominal as usize {
            receiving.clock(true);
        }
        assert_eq!(std::mem::take(&mut receiving.bytes), [0x5a], "{nominal} clocks a bit");
        assert_eq!(std::mem::take(&mut receiving.noise), 1);
    }
}
