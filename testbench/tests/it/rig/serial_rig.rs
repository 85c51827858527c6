//! A serial link at its pins, with a host on the line and a stand-in for the core.

use std::collections::{BTreeMap, VecDeque};

use incircle_blocks::QUICK_LINK;
use incircle_hdl::serial::SerialLink;
use incircle_protocol::{DeviceFrame, HostFrame, FIRST_RATE, STATUS_BUSY, STATUS_DROPPED, STATUS_OPEN};
use incircle_testbench::blocks;
use incircle_testkit::SplitMix64;
use verilated::{Model, PortId};

use crate::rig::serial_host::{cobs, crc32, host_frame, Heard, Listener, Talker};
use crate::rig::stepper::{named_ports, Stepper};

named_ports!(
    SerialLink,
    [reset, rx, command.ready, response.valid, response.data, response.both, response.last, device_busy],
    [tx, lamps, core_reset, command.valid, command.data, response.ready],
    clock
);

/// The pins of a link, in one form or both.
pub trait Pins {
    fn set(&mut self, port: &'static str, value: u64);
    fn settle(&mut self);
    fn get(&self, port: &'static str) -> u32;
    fn edge(&mut self);
}

impl Pins for Stepper<SerialLink> {
    fn set(&mut self, port: &'static str, value: u64) {
        Stepper::set(self, port, value);
    }
    fn settle(&mut self) {
        Stepper::settle(self);
    }
    fn get(&self, port: &'static str) -> u32 {
        Stepper::get(self, port) as u32
    }
    fn edge(&mut self) {
        Stepper::edge(self);
    }
}

/// Fields of the bundle `lamps`, the first in its lowest bit.
const LAMPS: [&str; 3] = ["alive", "busy", "error"];

/// The link as Verilog alone, which runs fast.
pub struct Verilog {
    model: Model,
    /// Ports by their names in the exported device; a signal of a channel is `command_valid`, not `command$valid`.
    ports: BTreeMap<String, PortId>,
}

impl Verilog {
    pub fn new(seed: u32) -> Self {
        let model = blocks::randomized("serial_link", seed);
        let ports = model.description().ports();
        let ports =
            ports.map(|port| (port.name.replace('$', "_"), model.port(port.name).expect("a port it lists"))).collect();
        Self { model, ports }
    }
}

impl Pins for Verilog {
    fn set(&mut self, port: &'static str, value: u64) {
        self.model.set(self.ports[port], value);
    }
    fn settle(&mut self) {
        self.model.eval();
    }
    fn get(&self, port: &'static str) -> u32 {
        match LAMPS.iter().position(|lamp| *lamp == port) {
            Some(bit) => (self.model.get(self.ports["lamps"]) >> bit) as u32 & 1,
            None => self.model.get(self.ports[port]) as u32,
        }
    }
    fn edge(&mut self) {
        self.model.clock();
    }
}

/// A stand-in for the core. A command is one word, whose low 16 bits are the number of
/// answer words behind the first two.
#[derive(Default)]
pub struct StandIn {
    pub taken: Vec<u32>,
    answer: VecDeque<u32>,
    /// The words on offer, one or two, and whether the answer ends with them.
    offered: Option<(u32, Option<u32>, bool)>,
    pub resets: usize,
    /// Takes a command once in this many clocks, so that a FIFO can fill.
    pub pace: u64,
}

/// Words of the stand-in's answer to a command.
pub fn answer_of(word: u32) -> Vec<u32> {
    let length = word & 0xffff;
    let mut words = vec![word, length];
    words.extend((0..length).map(|index| if index % 7 == 3 { 0 } else { word.wrapping_mul(index ^ 0x9e37_79b9) }));
    words
}

/// A link at its pins between a talking and listening host and the stand-in.
pub struct Rig<P> {
    pub pins: P,
    pub core: StandIn,
    pub talker: Talker,
    pub listener: Listener,
    random: SplitMix64,
    clocks: usize,
}

/// Clocks of a bit at the first rate.
pub const CLOCKS_PER_BIT: f64 = QUICK_LINK.clock_hz as f64 / FIRST_RATE as f64;
pub const SESSION: u8 = 0x5a;

impl<P: Pins> Rig<P> {
    pub fn new(pins: P) -> Self {
        let mut rig = Self {
            pins,
            core: StandIn { pace: 1, ..StandIn::default() },
            talker: Talker::new(CLOCKS_PER_BIT),
            listener: Listener::new(CLOCKS_PER_BIT),
            random: SplitMix64::new(5),
            clocks: 0,
        };
        rig.pins.set("reset", 1);
        // Before its first edge a device shows the values with which its flip-flops start.
        rig.pins.set("rx", 1);
        rig.pins.settle();
        rig.pins.edge();
        for _ in 0..3 {
            rig.clock();
        }
        rig.pins.set("reset", 0);
        rig.core.resets = 0;
        rig
    }

    pub fn clock(&mut self) {
        let rx = self.talker.clock();
        let takes =
            self.random.below(self.core.pace) == 0 && self.core.answer.is_empty() && self.core.offered.is_none();
        self.pins.set("rx", rx.into());
        self.pins.set("command_ready", takes.into());
        self.pins.set("response_valid", self.core.offered.is_some().into());
        let (low, high, last) = self.core.offered.unwrap_or((0xdead_beef, None, true));
        self.pins.set("response_data", u64::from(low) | u64::from(high.unwrap_or(0)) << 32);
        self.pins.set("response_both", high.is_some().into());
        self.pins.set("response_last", last.into());
        self.pins.set("device_busy", 0);
        self.pins.settle();
        self.listener.clock(self.pins.get("tx") == 1);
        if self.pins.get("response_ready") == 1 {
            self.core.offered = None;
        }
        if self.core.offered.is_none() && self.random.below(3) == 0 {
            let low = self.core.answer.pop_front();
            let high = if self.random.below(2) == 0 { self.core.answer.pop_front() } else { None };
            self.core.offered = low.map(|low| (low, high, self.core.answer.is_empty()));
        }
        if takes && self.pins.get("command_valid") == 1 && self.pins.get("core_reset") == 0 {
            let word = self.pins.get("command_data");
            self.core.taken.push(word);
            self.core.answer = answer_of(word).into();
        }
        if self.pins.get("core_reset") == 1 {
            self.core = StandIn { resets: self.core.resets + 1, pace: self.core.pace, ..StandIn::default() };
        }
        self.pins.edge();
        self.clocks += 1;
    }

    pub fn wait(&mut self, clocks: usize) {
        (0..clocks).for_each(|_| self.clock());
    }

    pub fn say(&mut self, session: u8, kind: HostFrame, number: u8, payload: &[u8]) {
        self.talker.say(&cobs(&host_frame(session, kind as u8, number, payload)));
    }

    pub fn data(&mut self, number: u8, words: &[u32]) {
        let payload: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        self.say(SESSION, HostFrame::Data, number, &payload);
    }

    /// Runs until a frame has come, for at most this many clocks.
    pub fn hear_within(&mut self, clocks: usize) -> Option<Heard> {
        for _ in 0..clocks {
            self.clock();
            if self.listener.bytes.last() == Some(&0) {
                if let Some(frame) = self.listener.frames().pop() {
                    return Some(frame);
                }
            }
        }
        None
    }

    pub fn hear(&mut self, kind: DeviceFrame) -> Heard {
        let frame = self.hear_within(200_000).unwrap_or_else(|| panic!("no {kind:?} comes"));
        assert_eq!(frame.kind, kind as u8, "not {kind:?}: {frame:x?}");
        frame
    }

    pub fn nothing_comes(&mut self, clocks: usize) {
        let frame = self.hear_within(clocks);
        assert_eq!(frame, None);
    }

    pub fn open(&mut self) {
        self.say(SESSION, HostFrame::Open, 0, &[]);
        let opened = self.hear(DeviceFrame::Opened);
        assert_eq!((opened.session, opened.expected, opened.answers), (SESSION, 0, 0));
        assert_eq!(u32::from(opened.free), QUICK_LINK.fifo_bytes);
        assert_eq!(opened.status & !STATUS_DROPPED, STATUS_OPEN);
    }

    /// Collects a whole answer and checks its frames.
    pub fn answer(&mut self, number: u8) -> Vec<u32> {
        let mut bytes = Vec::new();
        // A frame of another session is dropped, but it breaks the silence.
        self.say(SESSION ^ 1, HostFrame::Poll, 0, &[]);
        loop {
            let frame = self.hear_within(200_000).expect("a part of an answer");
            let is_end = frame.kind == DeviceFrame::AnswerEnd as u8;
            assert!(is_end || frame.kind == DeviceFrame::Answer as u8, "{frame:x?}");
            assert_eq!((frame.session, frame.answers, frame.body[0]), (SESSION, number, number));
            assert_eq!(usize::from(frame.body[1]) | usize::from(frame.body[2]) << 8, (bytes.len() / 4) & 0xffff);
            assert!(frame.status & STATUS_BUSY != 0);
            if is_end {
                let (words, digest) = frame.body[3..].split_last_chunk::<4>().expect("a digest");
                bytes.extend(words);
                assert!(!words.is_empty() && words.len() <= 1024 && words.len().is_multiple_of(4));
                assert_eq!(u32::from_le_bytes(*digest), crc32(&bytes));
                return bytes.chunks(4).map(|word| u32::from_le_bytes(word.try_into().expect("a word"))).collect();
            }
            assert_eq!(frame.body.len(), 3 + 1024);
            bytes.extend(&frame.body[3..]);
        }
    }
}

/// Makes a link and opens a session on it.
pub fn opened(seed: u32) -> Rig<Verilog> {
    let mut rig = Rig::new(Verilog::new(seed));
    rig.open();
    rig
}

/// Words as bytes, little-endian.
pub fn payload(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}
