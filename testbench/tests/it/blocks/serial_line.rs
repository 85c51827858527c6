//! The serial link at the line: bits, bytes, rates, silence and breaks. Rust, Verilog and plain code agree.

use crate::rig::serial_host::{crc32_state, Listener, Talker};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::export::{HASTY_LINK, QUICK_LINK};
use incircle_hdl::serial::{BitClock, Crc32, LineTimers, RateControl, UartReceiver, UartTransmitter};
use incircle_protocol::{rate_step, FIRST_RATE, MAX_STEP};

named_ports!(BitClock, [step, starts], [ticks], clock);
named_ports!(UartReceiver, [reset, step, rx], [byte_valid, byte_data, noise, is_low], clock);
named_ports!(UartTransmitter, [reset, step, byte_valid, byte_data], [byte_ready, tx, is_idle], clock);
named_ports!(Crc32, [sets, start, takes, byte_data], [is_busy, state], clock);
named_ports!(LineTimers, [reset, is_low, hears], [is_broken, is_silent, beat], clock);
named_ports!(
    RateControl,
    [reset, asked, value, fails, acknowledges, closes, is_quiet],
    [step, is_refused, holds],
    clock
);

const TURN: u64 = 1 << 24;

/// Places of the fields of `Asked` that the rate depends on.
const OPENS: u32 = 1 << 2;
const RATE: u32 = 1 << 3;
const CLOSES: u32 = 1 << 5;

fn ticks(name: &'static str, block: BitClock, first: u64) {
    let mut random = SplitMix64::new(1);
    let mut block = Stepper::new(name, block, 1);
    for run in 0..40 {
        let step = match run {
            0 => u64::from(MAX_STEP),
            1 => TURN / 5000,
            _ => 1 + random.below(u64::from(MAX_STEP)),
        };
        block.set("step", step);
        for clock in 0..1500 {
            block.set("starts", clock == 0);
            block.settle();
            // The addition that showed last was the one of the clock before, and the first is that behind `starts`.
            if clock >= 1 {
                let turns = |additions: u64| (first + additions * step) / TURN;
                block.expect("ticks", clock >= 2 && turns(clock - 1) > turns(clock - 2));
            }
            block.edge();
        }
    }
}

#[test]
fn bits_tick_at_their_ends() {
    ticks("serial_bit_ends", BitClock::at_ends(), 0);
}

#[test]
fn bits_tick_in_their_middles() {
    ticks("serial_bit_middles", BitClock::in_middles(), TURN / 2);
}

/// A receiver, and what it has given.
struct Receiving {
    block: Stepper<UartReceiver>,
    bytes: Vec<u8>,
    noise: usize,
}

impl Receiving {
    fn new() -> Self {
        let mut this = Self {
            block: Stepper::new("serial_uart_receiver", UartReceiver::new(), 2),
            bytes: Vec::new(),
            noise: 0,
        };
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
fn clocks_per_bit(run: usize, random: &mut SplitMix64) -> f64 {
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
        // One clock of each bit is wrong; that of a start bit does not move its beginning.
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
        // A glitch of less than half a bit, as start bits go, is nothing.
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

#[test]
fn transmitter_sends_bytes_without_a_gap_or_when_they_come() {
    let mut random = SplitMix64::new(6);
    let mut block = Stepper::new("serial_uart_transmitter", UartTransmitter::new(), 2);
    block.set("byte_valid", false);
    block.set("byte_data", 0u8);
    block.set("step", MAX_STEP);
    block.set("reset", true);
    block.settle();
    block.edge();
    block.set("reset", false);
    for run in 0..36 {
        let nominal = clocks_per_bit(run, &mut random);
        let step = (TURN as f64 / nominal).round();
        block.set("step", step as u32);
        let mut listener = Listener::new(nominal * [0.98, 1.0, 1.02][run % 3]);
        let said: Vec<u8> = (0..24).map(|_| random.below(256) as u8).collect();
        let is_lazy = run % 2 == 1;
        let (mut next, mut offers) = (0, false);
        let (mut first, mut last) = (None, 0);
        while next < said.len() || !block.is("is_idle") {
            offers = next < said.len() && (offers || !is_lazy || random.below(300) == 0);
            block.set("byte_valid", offers);
            block.set("byte_data", if offers { said[next] } else { 0xff });
            block.settle();
            listener.clock(block.is("tx"));
            if offers && block.is("byte_ready") {
                (next, offers) = (next + 1, false);
                first.get_or_insert(block.clocks());
            }
            if !block.is("is_idle") {
                last = block.clocks();
            }
            block.edge();
            block.settle();
        }
        assert_eq!((listener.bytes, listener.faults), (said, 0), "{nominal} clocks a bit");
        if !is_lazy {
            let taken = (last - first.expect("a byte")) as f64;
            let bits = 10.0 * 24.0 * TURN as f64 / step;
            assert!((taken - bits).abs() <= 1.0, "{taken} clocks for {bits}");
        }
    }
}

#[test]
fn check_sums_run() {
    let mut random = SplitMix64::new(7);
    let mut block = Stepper::new("serial_crc32", Crc32::default(), 1);
    for run in 0..60 {
        let start = if run % 2 == 0 { u32::MAX } else { random.below(1 << 32) as u32 };
        let bytes: Vec<u8> = (0..random.below(40)).map(|_| random.below(256) as u8).collect();
        for (port, value) in [("sets", 1), ("start", start), ("takes", (run % 3 == 0).into()), ("byte_data", 0x77)] {
            block.set(port, value);
        }
        block.settle();
        block.edge();
        block.set("sets", false);
        // A state that is not the first is one that some bytes lead to: go on from it a byte at a time.
        let mut expected = start;
        for byte in bytes {
            block.set("takes", true);
            block.set("byte_data", byte);
            block.settle();
            block.expect("state", expected);
            block.expect("is_busy", false);
            block.edge();
            block.set("takes", false);
            for _ in 0..8 {
                block.settle();
                block.expect("is_busy", true);
                block.edge();
            }
            // From a state s, a byte leads where the byte xor the low byte of s leads from 0, xor s without it.
            let from_zero = crc32_state(&[byte ^ expected as u8 ^ 0xff]) ^ 0x00ff_ffff;
            expected = from_zero ^ expected >> 8;
            for _ in 0..random.below(3) {
                block.settle();
                block.expect("state", expected);
                block.edge();
            }
        }
        block.settle();
        block.expect("state", expected);
    }
    assert_eq!(!crc32_state(b"123456789"), 0xcbf4_3926);
    assert_eq!(crc32_state(&[b"a".as_slice(), &(!crc32_state(b"a")).to_le_bytes()].concat()), Crc32::SOUND as u32);
}

#[test]
fn timers_tell_silence_and_breaks() {
    let eighth = HASTY_LINK.clock_hz as usize / 8000;
    let millisecond = 8 * eighth;
    let silence = HASTY_LINK.silence_ms as usize * millisecond;
    let mut random = SplitMix64::new(8);
    let mut block = Stepper::new("serial_line_timers", LineTimers::new(HASTY_LINK), 1);
    let (mut low_for, mut silent_for) = (0, 0);
    let (mut low_left, mut hears_in) = (0, 0);
    let (mut breaks, mut silences, mut beats) = (0, 0, 0);
    let (mut was_broken, mut was_silent, mut beat) = (false, false, false);
    for clock in 0..400_000 {
        if low_left == 0 && random.below(3 * millisecond as u64) == 0 {
            low_left = 1 + random.below(2 * millisecond as u64);
        }
        let is_low = clock > 0 && low_left > 0;
        low_left = low_left.saturating_sub(1);
        if hears_in == 0 {
            hears_in = 1 + random.below(2 * silence as u64);
        }
        hears_in -= 1;
        let (hears, reset) = (clock > 0 && hears_in == 0, clock == 0);
        for (port, value) in [("reset", reset), ("is_low", is_low), ("hears", hears)] {
            block.set(port, value);
        }
        block.settle();
        if clock > 0 {
            let (is_broken, is_silent) = (block.is("is_broken"), block.is("is_silent"));
            // The earliest and the latest clock of each.
            assert!(low_for >= millisecond || !is_broken, "a break after {low_for} clocks");
            assert!(low_for < millisecond + eighth + 3 || is_broken, "no break after {low_for} clocks");
            assert!(silent_for >= silence || !is_silent, "silence after {silent_for} clocks");
            assert!(silent_for < silence + eighth + 3 || is_silent, "no silence after {silent_for} clocks");
            breaks += usize::from(is_broken && !was_broken);
            silences += usize::from(is_silent && !was_silent);
            beats += usize::from(beat != block.is("beat"));
            (was_broken, was_silent, beat) = (is_broken, is_silent, block.is("beat"));
        }
        block.edge();
        low_for = if is_low { low_for + 1 } else { 0 };
        silent_for = if hears || reset { 0 } else { silent_for + 1 };
    }
    assert!(breaks > 20 && silences > 3, "{breaks} breaks, {silences} silences");
    assert!(beats <= 1, "{beats} beats in less than half a second");
}

/// The rate as the page has it.
#[derive(Default)]
struct Rates {
    present: u32,
    wanted: Option<u32>,
    coming: Option<u32>,
    returns: bool,
    refused: bool,
}

#[test]
fn the_rate_changes_behind_its_receipt_and_returns() {
    let first = rate_step(FIRST_RATE, QUICK_LINK.clock_hz).expect("a rate");
    let mut random = SplitMix64::new(9);
    let mut block = Stepper::new("serial_rate_control", RateControl::new(QUICK_LINK), 1);
    let mut rates = Rates::default();
    let mut value = 0u32;
    let (mut changes, mut refusals) = (0, 0);
    for clock in 0..30_000 {
        // The value stands for two clocks at least before it counts.
        let asked =
            if clock % 4 == 3 { [0, 0, 0, RATE, RATE, RATE, OPENS, CLOSES][random.below(8) as usize] } else { 0 };
        if clock % 4 == 0 {
            value = match random.below(6) {
                0 => 0,
                1 => MAX_STEP,
                2 => MAX_STEP + 1 + random.below(u64::from(u32::MAX - MAX_STEP)) as u32,
                _ => 1 + random.below(u64::from(MAX_STEP)) as u32,
            };
        }
        let reset = clock == 0;
        let [fails, begins, closes, is_quiet] = [200, 9, 4, 3].map(|times| clock > 0 && random.below(times) == 0);
        // A frame begins only while the rate is not about to change.
        let begins = begins && rates.coming.is_none() && !rates.returns;
        let (acknowledges, closes) = (begins && !closes, begins && closes);
        block.set("asked", asked);
        block.set("value", value);
        for (port, bit) in [
            ("reset", reset),
            ("fails", fails),
            ("acknowledges", acknowledges),
            ("closes", closes),
            ("is_quiet", is_quiet),
        ] {
            block.set(port, bit);
        }
        block.settle();
        if clock > 0 {
            block.expect("step", rates.present);
            block.expect("is_refused", rates.refused);
            block.expect("holds", rates.coming.is_some() || rates.returns);
        }
        block.edge();
        let before = rates.present;
        if is_quiet {
            if let Some(step) = rates.coming.take() {
                rates.present = step;
            }
            if std::mem::take(&mut rates.returns) {
                rates.present = first;
            }
        }
        if acknowledges {
            rates.coming = rates.wanted.take();
        }
        rates.returns |= closes;
        if asked == RATE {
            let is_fit = (1..=MAX_STEP).contains(&value);
            rates.refused = !is_fit;
            rates.wanted = is_fit.then_some(value);
            refusals += usize::from(!is_fit);
        }
        if asked == OPENS || asked == CLOSES {
            (rates.wanted, rates.refused) = (None, false);
        }
        if fails || reset {
            rates = Rates { present: first, ..Rates::default() };
        }
        changes += usize::from(rates.present != before);
    }
    assert!(changes > 100 && refusals > 100, "{changes} changes, {refusals} refusals");
}
