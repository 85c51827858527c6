//! Runs the serial link at its pins beside its model by bytes: one random exchange with noise, breaks and silences must
//! bring the same frames from both.

use std::collections::VecDeque;

use crate::rig::serial_host::{cobs, host_frame, Heard, Listener};
use crate::rig::serial_rig::{answer_of, payload, Pins, Rig, Verilog};
use incircle_blocks::QUICK_LINK;
use incircle_model::serial::{core_identity, Passed, SerialModel, WordDevice};
use incircle_protocol::{HostFrame, MAX_STEP, PHASE_BITS, SMALL, STATUS_BUSY};
use incircle_testkit::SplitMix64;

/// Clocks of a silent line after which nothing more comes unasked.
const QUIET: usize = 600;
/// Bits on the line for each byte.
const BITS: usize = 10;
/// Clocks of a break: more than a millisecond and an eighth.
const BREAK_CLOCKS: usize = 1300;
const SILENCE: usize = (QUICK_LINK.silence_ms * (QUICK_LINK.clock_hz / 1000)) as usize;

/// A stand-in for the core, as behind the pins, that works a clock at a time.
#[derive(Default)]
struct Answering(VecDeque<u32>);

impl WordDevice for Answering {
    fn reset(&mut self) {
        self.0.clear();
    }

    fn step(&mut self, command: Option<u32>, takes_answer: bool) -> Passed {
        if !self.0.is_empty() {
            return Passed { is_taken: false, answer: [self.0.pop_front_if(|_| takes_answer), None] };
        }
        self.0.extend(command.into_iter().flat_map(answer_of));
        Passed { is_taken: command.is_some(), ..Passed::default() }
    }
}

/// An event on the line to the device.
#[derive(Clone, Copy, Debug)]
enum Event {
    Byte(u8),
    /// A byte whose stop bit is missing.
    Noise(u8),
    Break,
    /// Silence for this many clocks.
    Silence(usize),
}

/// Both forms of the device.
struct Pair {
    rig: Rig<Verilog>,
    model: SerialModel<Answering>,
    clocks: [usize; 2],
}

impl Pair {
    fn new(seed: u32) -> Self {
        let model = SerialModel::new(QUICK_LINK, core_identity(SMALL), Answering::default());
        Self { rig: Rig::new(Verilog::new(seed)), model, clocks: [0; 2] }
    }

    fn clocks_per_bit(&self) -> f64 {
        f64::from(1u32 << PHASE_BITS) / f64::from(self.model.rate_step())
    }

    /// Sends the events to both, and returns the frames that come back from each.
    fn exchange(&mut self, events: &[Event]) -> [Vec<Heard>; 2] {
        let bit = self.clocks_per_bit();
        self.rig.talker.clocks_per_bit = bit;
        self.rig.listener = Listener::new(bit);
        let found = self.at_the_pins(events, bit);
        let expected = self.by_bytes(events, (BITS as f64 * bit) as usize);
        // The model catches up, so that both have lived for the same time.
        self.pass(self.clocks[0].saturating_sub(self.clocks[1]));
        [found, expected].map(|frames| frames.into_iter().map(without_time).collect())
    }

    fn at_the_pins(&mut self, events: &[Event], bit: f64) -> Vec<Heard> {
        for event in events {
            let talker = &mut self.rig.talker;
            match *event {
                Event::Byte(byte) => talker.say(&[byte]),
                Event::Noise(byte) => {
                    talker.hold(false, 1);
                    (0..8).for_each(|place| talker.hold(byte >> place & 1 == 1, 1));
                    talker.hold(false, 1);
                    talker.hold(true, 3);
                }
                Event::Break => {
                    talker.hold(false, (BREAK_CLOCKS as f64 / bit) as usize);
                    talker.hold(true, 20);
                }
                Event::Silence(clocks) => talker.hold(true, (clocks as f64 / bit) as usize),
            }
        }
        let mut quiet = 0;
        while quiet < QUIET {
            self.rig.clock();
            self.clocks[0] += 1;
            let is_idle = self.rig.talker.is_silent() && self.rig.pins.get("tx") == 1;
            quiet = if is_idle { quiet + 1 } else { 0 };
        }
        assert_eq!(self.rig.listener.faults, 0, "some bytes lack their stop bit");
        self.rig.listener.frames()
    }

    fn by_bytes(&mut self, events: &[Event], byte_clocks: usize) -> Vec<Heard> {
        let mut line = Vec::new();
        for event in events {
            match *event {
                Event::Silence(clocks) => self.pass(clocks),
                Event::Break => self.pass(BREAK_CLOCKS),
                Event::Byte(_) | Event::Noise(_) => self.pass(byte_clocks),
            }
            match *event {
                Event::Byte(byte) => self.model.take(byte),
                Event::Noise(_) => self.model.spoil(),
                Event::Break => self.model.break_line(),
                Event::Silence(_) => {}
            }
            line.extend(self.model.give());
        }
        let mut quiet = 0;
        while quiet < 6 {
            self.pass(byte_clocks);
            let byte = self.model.give();
            quiet = if byte.is_some() { 0 } else { quiet + 1 };
            line.extend(byte);
        }
        line.split(|&byte| byte == 0).filter(|line| !line.is_empty()).filter_map(Heard::parse).collect()
    }

    fn pass(&mut self, clocks: usize) {
        self.model.pass(clocks as u64);
        self.clocks[1] += clocks;
    }
}

/// A frame without the fields that depend on how far the core has come when the frame begins.
fn without_time(frame: Heard) -> Heard {
    Heard { free: 0, status: frame.status & !STATUS_BUSY, ..frame }
}

/// A host that sends every kind of frame, and now and then a wrong one.
struct Host {
    random: SplitMix64,
    session: u8,
    is_open: bool,
    expected: u8,
}

impl Host {
    fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.random.below(choices.len() as u64) as usize]
    }

    fn byte(&mut self) -> u8 {
        self.random.below(256) as u8
    }

    fn frame(&mut self) -> Vec<u8> {
        let named = self.byte();
        let session = self.one_of(&[self.session, self.session, self.session, self.session, self.session, 0, named]);
        let number = self.expected.wrapping_add(self.one_of(&[0, 0, 0, 0, 1, 2, 127, 128, 255]));
        let (one, other) = (self.random.below(7), self.random.below(7));
        let words = (0..=one).map(|_| (self.random.below(40) as u32) | ((other as u32 + 1) << 24));
        let words: Vec<u32> = words.collect();
        let step = self.one_of(&[1u32 << 21, 1 << 20, 1 << 19, 0x0012_3456, 0, MAX_STEP + 1, u32::MAX]);
        // Most frames of a host without a session ask for one.
        let kinds: &[u8] =
            if self.is_open { &[1, 2, 3, 3, 4, 4, 5, 5, 5, 5, 5, 6] } else { &[1, 2, 2, 2, 2, 3, 4, 5, 6] };
        let kind = self.one_of(kinds);
        let payload = match kind {
            3 => step.to_le_bytes().to_vec(),
            5 => payload(&words),
            _ => Vec::new(),
        };
        match self.random.below(20) {
            0 => host_frame(session, named, number, &payload),
            1 => host_frame(session, kind, number, &[1; 5]),
            2 => host_frame(session, HostFrame::Data as u8, number, &[1; 1028]),
            _ => host_frame(session, kind, number, &payload),
        }
    }

    /// Events for one frame with what the line does to it, or for another disturbance.
    fn events(&mut self) -> Vec<Event> {
        let mut events: Vec<_> = cobs(&self.frame()).into_iter().map(Event::Byte).collect();
        let (place, byte) = (self.random.below(events.len() as u64) as usize, self.byte());
        match self.random.below(32) {
            0 => events[place] = Event::Byte(byte),
            1 => {
                events.remove(place);
            }
            2 => events.insert(place, Event::Byte(byte)),
            3 => events[place] = Event::Noise(byte),
            4 => events.insert(place, Event::Noise(byte)),
            5 | 6 => events.insert(0, Event::Noise(byte)),
            7 => events.truncate(place),
            8 => events = [vec![Event::Byte(byte), Event::Byte(0)], events].concat(),
            9 => return vec![Event::Break],
            10 => {
                events.truncate(place);
                events.push(Event::Break);
            }
            11 => return vec![Event::Silence(SILENCE / 2)],
            12 => return vec![Event::Silence(SILENCE + 2000)],
            _ => {}
        }
        events
    }
}

#[test]
fn pins_and_bytes_bring_the_same_frames() {
    let (mut kinds, mut rates) = ([0; 8], 0);
    for seed in 1..=3 {
        let mut pair = Pair::new(seed);
        let mut host = Host { random: SplitMix64::new(u64::from(seed)), session: 9, is_open: false, expected: 0 };
        for step in 0..400 {
            let events = host.events();
            let before = pair.model.rate_step();
            let [found, expected] = pair.exchange(&events);
            assert_eq!(found, expected, "seed {seed}, step {step}: {events:x?}");
            found.iter().for_each(|frame| kinds[usize::from(frame.kind - 0x81)] += 1);
            if let Some(last) = found.last() {
                host.expected = last.expected;
                host.is_open = last.session != 0;
                host.session = if last.session == 0 { host.session } else { last.session };
            }
            rates += usize::from(pair.model.rate_step() != before);
        }
    }
    println!("{kinds:?} frames from Hello to Closed, {rates} changes of the rate");
    // No answer here is long enough to have several parts, so frames of that kind need not occur.
    assert!((0..8).all(|kind| kinds[kind] > 20 || kind == 4) && rates > 40, "{kinds:?}, {rates}");
}
