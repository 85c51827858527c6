//! The whole serial link, pins on one side and a stand-in for the core on the other: Rust, Verilog and the rules of the protocol's page.

mod block_ports;
mod serial_host;
mod stepper;

use std::collections::{BTreeMap, VecDeque};

use incircle_cli::generate::SplitMix64;
use incircle_hdl::export::QUICK_LINK;
use incircle_hdl::serial::SerialLink;
use incircle_protocol::{
    rate_step, DeviceFrame, HostFrame, FIRST_RATE, LINK_MAGIC, MAX_STEP, SMALL, STATUS_BAD_RATE, STATUS_BUSY,
    STATUS_DROPPED, STATUS_OPEN,
};
use incircle_testbench::blocks;
use serial_host::{cobs, crc32, host_frame, Heard, Listener, Talker};
use stepper::{named_ports, Stepper};
use verilated::{Model, PortId};

named_ports!(
    SerialLink,
    [reset, rx, command_ready, response_valid, response_data],
    [tx, alive, busy, error, core_reset, command_valid, command_data, response_ready],
    clock
);

/// A link in one form or both.
trait Pins {
    fn set(&mut self, port: &'static str, value: u32);
    fn settle(&mut self);
    fn get(&self, port: &'static str) -> u32;
    fn edge(&mut self);
}

impl Pins for Stepper<SerialLink> {
    fn set(&mut self, port: &'static str, value: u32) {
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

/// The Verilog alone: fast.
struct Verilog {
    model: Model,
    ports: BTreeMap<&'static str, PortId>,
}

impl Verilog {
    fn new(seed: u32) -> Self {
        let model = blocks::randomized("serial_link", seed);
        let ports = model.description().ports();
        let ports = ports.map(|port| (port.name, model.port(port.name).expect("a port it lists"))).collect();
        Self { model, ports }
    }
}

impl Pins for Verilog {
    fn set(&mut self, port: &'static str, value: u32) {
        self.model.set(self.ports[port], value.into());
    }
    fn settle(&mut self) {
        self.model.eval();
    }
    fn get(&self, port: &'static str) -> u32 {
        self.model.get(self.ports[port]) as u32
    }
    fn edge(&mut self) {
        self.model.clock();
    }
}

/// A core of words: a command is one word, whose low 16 bits say how many words its answer has behind the first two.
#[derive(Default)]
struct StandIn {
    taken: Vec<u32>,
    answer: VecDeque<u32>,
    /// The word that is offered.
    offered: Option<u32>,
    resets: usize,
    /// Takes a command this seldom, for a FIFO that fills.
    pace: u64,
}

fn answer_of(word: u32) -> Vec<u32> {
    let length = word & 0xffff;
    let mut words = vec![word, length];
    words.extend((0..length).map(|index| if index % 7 == 3 { 0 } else { word.wrapping_mul(index ^ 0x9e37_79b9) }));
    words
}

struct Rig<P> {
    pins: P,
    core: StandIn,
    talker: Talker,
    listener: Listener,
    random: SplitMix64,
    clocks: usize,
}

const CLOCKS_PER_BIT: f64 = QUICK_LINK.clock_hz as f64 / FIRST_RATE as f64;
const SESSION: u8 = 0x5a;

impl<P: Pins> Rig<P> {
    fn new(pins: P) -> Self {
        let mut rig = Self {
            pins,
            core: StandIn { pace: 1, ..StandIn::default() },
            talker: Talker::new(CLOCKS_PER_BIT),
            listener: Listener::new(CLOCKS_PER_BIT),
            random: SplitMix64::new(5),
            clocks: 0,
        };
        rig.pins.set("reset", 1);
        for _ in 0..3 {
            rig.clock();
        }
        rig.pins.set("reset", 0);
        rig.core.resets = 0;
        rig
    }

    fn clock(&mut self) {
        let rx = self.talker.clock();
        let takes =
            self.random.below(self.core.pace) == 0 && self.core.answer.is_empty() && self.core.offered.is_none();
        self.pins.set("rx", rx.into());
        self.pins.set("command_ready", takes.into());
        self.pins.set("response_valid", self.core.offered.is_some().into());
        self.pins.set("response_data", self.core.offered.unwrap_or(0xdead_beef));
        self.pins.settle();
        self.listener.clock(self.pins.get("tx") == 1);
        if self.pins.get("response_ready") == 1 {
            self.core.offered = None;
        }
        if self.core.offered.is_none() && self.random.below(3) == 0 {
            self.core.offered = self.core.answer.pop_front();
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

    fn wait(&mut self, clocks: usize) {
        (0..clocks).for_each(|_| self.clock());
    }

    fn say(&mut self, session: u8, kind: HostFrame, number: u8, payload: &[u8]) {
        self.talker.say(&cobs(&host_frame(session, kind as u8, number, payload)));
    }

    fn data(&mut self, number: u8, words: &[u32]) {
        let payload: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        self.say(SESSION, HostFrame::Data, number, &payload);
    }

    /// Runs until a frame has come, for so many clocks at most.
    fn hear_within(&mut self, clocks: usize) -> Option<Heard> {
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

    fn hear(&mut self, kind: DeviceFrame) -> Heard {
        let frame = self.hear_within(200_000).unwrap_or_else(|| panic!("no {kind:?} comes"));
        assert_eq!(frame.kind, kind as u8, "not {kind:?}: {frame:x?}");
        frame
    }

    fn nothing_comes(&mut self, clocks: usize) {
        let frame = self.hear_within(clocks);
        assert_eq!(frame, None);
    }

    fn open(&mut self) {
        self.say(SESSION, HostFrame::Open, 0, &[]);
        let opened = self.hear(DeviceFrame::Opened);
        assert_eq!((opened.session, opened.expected, opened.answers), (SESSION, 0, 0));
        assert_eq!(u32::from(opened.free), QUICK_LINK.fifo_bytes);
        assert_eq!(opened.status & !STATUS_DROPPED, STATUS_OPEN);
    }

    /// A whole answer, whose frames are checked.
    fn answer(&mut self, number: u8) -> Vec<u32> {
        let mut bytes = Vec::new();
        // A frame of another session is nothing, but it breaks the silence.
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
                assert!(!words.is_empty() && words.len() <= 1024 && words.len() % 4 == 0);
                assert_eq!(u32::from_le_bytes(*digest), crc32(&bytes));
                return bytes.chunks(4).map(|word| u32::from_le_bytes(word.try_into().expect("a word"))).collect();
            }
            assert_eq!(frame.body.len(), 3 + 1024);
            bytes.extend(&frame.body[3..]);
        }
    }
}

fn greets_and_answers(pins: impl Pins) {
    let mut rig = Rig::new(pins);
    rig.say(0, HostFrame::Hello, 0, &[]);
    let hello = rig.hear(DeviceFrame::Hello);
    assert_eq!((hello.session, hello.status), (0, 0));
    let words = hello.words();
    assert_eq!(words.len(), 13);
    let link = QUICK_LINK;
    assert_eq!(
        words[..6],
        [LINK_MAGIC, 0x0001_0000, link.clock_hz, link.fifo_bytes, link.clock_hz / 8, link.silence_ms]
    );
    assert_eq!((words[6], words[10], words[11], words[12]), (0x696e_4369, SMALL.points, SMALL.contexts, SMALL.ring));
    rig.open();
    rig.data(0, &[0x0100_0003]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.session, ack.expected, ack.answers), (SESSION, 1, 0));
    assert_eq!(ack.words(), [crc32(&0x0100_0003u32.to_le_bytes())]);
    assert_eq!(rig.answer(0), answer_of(0x0100_0003));
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.expected, ack.answers, ack.status), (1, 1, STATUS_OPEN));
    rig.say(SESSION, HostFrame::Close, 0, &[]);
    let closed = rig.hear(DeviceFrame::Closed);
    assert_eq!((closed.session, closed.status), (0, 0));
}

#[test]
fn link_greets_and_answers_in_both_forms() {
    let link = SerialLink::new(SMALL, QUICK_LINK).map_err(|error| format!("{error:?}")).expect("a sound configuration");
    greets_and_answers(Stepper::new("serial_link", link, 1));
}

#[test]
fn link_greets_and_answers() {
    greets_and_answers(Verilog::new(3));
}

/// Opens a session, and says what it was before.
fn opened(seed: u32) -> Rig<Verilog> {
    let mut rig = Rig::new(Verilog::new(seed));
    rig.open();
    rig
}

fn payload(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

#[test]
fn without_a_session_nothing_but_a_greeting_is_to_be_had() {
    let mut rig = Rig::new(Verilog::new(1));
    for kind in [HostFrame::Poll, HostFrame::Close] {
        rig.say(SESSION, kind, 0, &[]);
        let frame = rig.hear(DeviceFrame::NoSession);
        assert_eq!((frame.session, frame.status, frame.body.len()), (0, 0, 0));
    }
    rig.say(SESSION, HostFrame::Rate, 0, &MAX_STEP.to_le_bytes());
    rig.hear(DeviceFrame::NoSession);
    rig.data(0, &[1, 2, 3]);
    rig.hear(DeviceFrame::NoSession);
    // Nothing of it has been there.
    rig.open();
    rig.wait(2000);
    assert!(rig.core.taken.is_empty(), "{:x?}", rig.core.taken);
    // In a session, frames of another one are nothing.
    for kind in [HostFrame::Poll, HostFrame::Close] {
        rig.say(SESSION ^ 1, kind, 0, &[]);
    }
    rig.say(SESSION ^ 1, HostFrame::Data, 0, &[0; 8]);
    rig.nothing_comes(5000);
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.expected, ack.status, ack.words()), (0, STATUS_OPEN, vec![0]));
}

#[test]
fn frames_that_are_not_sound_leave_no_trace() {
    let mut rig = opened(2);
    let mut random = SplitMix64::new(11);
    let good = payload(&[7 << 24, 8 << 24]);
    for run in 0..30 {
        let mut frame = host_frame(SESSION, HostFrame::Data as u8, 0, &payload(&[9 << 24, 1, 2, 3]));
        match run % 6 {
            0 => {
                let place = random.below(frame.len() as u64) as usize;
                frame[place] ^= 1 << random.below(8);
            }
            1 => frame.truncate(random.below(frame.len() as u64) as usize),
            2 => frame = host_frame(SESSION, HostFrame::Data as u8, 0, &[1; 5]),
            3 => frame = host_frame(SESSION, HostFrame::Data as u8, 0, &[1; 1028]),
            4 => frame = host_frame(SESSION, [0, 7, 8, 0x85][run / 6 % 4], 0, &[]),
            _ => frame = host_frame(0, HostFrame::Open as u8, 0, &[]),
        }
        let mut line = cobs(&frame);
        if run % 6 == 1 && run > 10 {
            // Its end is lost too, and a zero ends it.
            line.truncate(line.len() - 1);
            line.push(0);
        }
        if line.len() > 2 {
            rig.talker.say(&line);
            rig.nothing_comes(10 * 1200 * 9 / 5);
            assert_eq!(rig.pins.get("error"), 1, "run {run}");
        }
        rig.say(SESSION, HostFrame::Poll, 0, &[]);
        let ack = rig.hear(DeviceFrame::Ack);
        let status = if line.len() > 2 { STATUS_OPEN | STATUS_DROPPED } else { STATUS_OPEN };
        assert_eq!((ack.expected, ack.status, ack.words()), (0, status, vec![0]), "run {run}");
        assert_eq!(u32::from(ack.free), QUICK_LINK.fifo_bytes);
    }
    assert!(rig.core.taken.is_empty(), "{:x?}", rig.core.taken);
    rig.say(SESSION, HostFrame::Data, 0, &good);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.expected, ack.status & STATUS_DROPPED, ack.words()), (1, 0, vec![crc32(&good)]));
    assert_eq!(rig.answer(0), [7 << 24, 0]);
    assert_eq!(rig.answer(1), [8 << 24, 0]);
    assert_eq!(rig.core.taken, [7 << 24, 8 << 24]);
}

#[test]
fn a_gap_gives_one_nak_and_repeats_give_acks() {
    let mut rig = opened(3);
    rig.data(1, &[1 << 24]);
    assert_eq!(rig.hear(DeviceFrame::Nak).expected, 0);
    rig.data(2, &[1 << 24]);
    rig.data(3, &[1 << 24]);
    rig.nothing_comes(9000);
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    assert_eq!(rig.hear(DeviceFrame::Nak).expected, 0);
    rig.data(0, &[5 << 24]);
    assert_eq!(rig.hear(DeviceFrame::Ack).expected, 1);
    assert_eq!(rig.answer(0), [5 << 24, 0]);
    rig.data(0, &[6 << 24]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.expected, ack.words()), (1, vec![crc32(&payload(&[5 << 24]))]));
    rig.nothing_comes(5000);
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    rig.hear(DeviceFrame::Ack);
    assert_eq!(rig.core.taken, [5 << 24]);
    // All numbers of 256, and on.
    for number in 1..=300u32 {
        rig.data(number as u8, &[number << 24 >> 8]);
        let ack = rig.hear_within(40_000).expect("an Ack or the end of an answer");
        assert!(ack.kind == DeviceFrame::Ack as u8, "{ack:x?}");
        assert_eq!(ack.expected, (number + 1) as u8);
        assert_eq!(rig.answer(number as u8)[0], number << 24 >> 8);
    }
}

#[test]
fn credit_is_what_the_fifo_has_and_no_more_is_taken() {
    let mut rig = opened(4);
    // The core takes next to nothing.
    rig.core.pace = 1 << 40;
    let words = [0x1100_0000u32; 256];
    let mut number = 0;
    let mut left = QUICK_LINK.fifo_bytes;
    loop {
        rig.data(number, &words);
        let frame = rig.hear_within(200_000).expect("a receipt");
        // A word may stand outside the FIFO.
        let free = u32::from(frame.free);
        assert!((left.saturating_sub(1024)..=left.saturating_sub(1024) + 4).contains(&free) || frame.kind == 0x84);
        if frame.kind == DeviceFrame::Nak as u8 {
            assert_eq!((frame.expected, free < 1024), (number, true));
            break;
        }
        assert_eq!((frame.kind, frame.expected), (DeviceFrame::Ack as u8, number + 1));
        (number, left) = (number + 1, free);
    }
    assert_eq!(number, 2);
    // As much as there is room for is taken; and the answers come when the core goes on.
    rig.data(number, &words[..left as usize / 4]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.expected, ack.free), (number + 1, 0));
    rig.core.pace = 1;
    for answer in 0..512 + left / 4 {
        assert_eq!(rig.answer(answer as u8), [0x1100_0000, 0]);
    }
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((u32::from(ack.free), ack.status), (QUICK_LINK.fifo_bytes, STATUS_OPEN));
}

#[test]
fn long_answers_come_in_parts_and_receipts_go_between_them() {
    let mut rig = opened(5);
    let command = 0x2200_0000 | 700;
    rig.data(0, &[command]);
    assert_eq!(rig.hear(DeviceFrame::Ack).status, STATUS_OPEN);
    let mut bytes = Vec::new();
    for (kind, index, words) in [(DeviceFrame::Answer, 0u16, 256), (DeviceFrame::Answer, 256, 256)] {
        rig.say(SESSION, HostFrame::Poll, 0, &[]);
        let part = rig.hear(kind);
        assert_eq!((part.body[0], part.body.len(), part.status), (0, 3 + 4 * words, STATUS_OPEN | STATUS_BUSY));
        assert_eq!(part.body[1..3], index.to_le_bytes());
        bytes.extend(&part.body[3..]);
        let ack = rig.hear(DeviceFrame::Ack);
        assert_eq!((ack.answers, ack.status), (0, STATUS_OPEN | STATUS_BUSY));
    }
    let part = rig.hear(DeviceFrame::AnswerEnd);
    let (words, digest) = part.body[3..].split_last_chunk::<4>().expect("a digest");
    bytes.extend(words);
    assert_eq!(bytes, payload(&answer_of(command)));
    assert_eq!(u32::from_le_bytes(*digest), crc32(&bytes));
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    let ack = rig.hear(DeviceFrame::Ack);
    assert_eq!((ack.answers, ack.status), (1, STATUS_OPEN));
}

#[test]
fn an_opening_cuts_an_answer_and_resets_the_core() {
    let mut rig = opened(6);
    for length in [300u32, 3, 1000] {
        rig.data(0, &[0x3300_0000 | length, 0x4400_0000, 0x5500_0000]);
        rig.hear(DeviceFrame::Ack);
        rig.wait(1500);
        let resets = rig.core.resets;
        rig.talker.say(&[0]);
        rig.say(SESSION ^ 7, HostFrame::Open, 0, &[]);
        // What was under way is cut, or it was whole before.
        let mut frame = rig.hear_within(300_000).expect("a frame");
        while frame.kind != DeviceFrame::Opened as u8 {
            assert_eq!(frame.session, SESSION, "{frame:x?}");
            frame = rig.hear_within(300_000).expect("a frame");
        }
        assert_eq!((frame.session, frame.expected, frame.answers, frame.status), (SESSION ^ 7, 0, 0, STATUS_OPEN));
        assert_eq!(u32::from(frame.free), QUICK_LINK.fifo_bytes);
        assert!(rig.core.resets > resets, "the core was not reset");
        rig.nothing_comes(3000);
        assert!(rig.core.taken.is_empty(), "{:x?}", rig.core.taken);
        rig.open();
        rig.data(0, &[0x6600_0002]);
        assert_eq!(rig.hear(DeviceFrame::Ack).words(), [crc32(&payload(&[0x6600_0002]))]);
        assert_eq!(rig.answer(0), answer_of(0x6600_0002));
        rig.open();
    }
}

#[test]
fn the_rate_changes_and_falls_back() {
    let mut rig = opened(7);
    // A step out of range changes nothing.
    for step in [0, MAX_STEP + 1, u32::MAX] {
        rig.say(SESSION, HostFrame::Rate, 0, &step.to_le_bytes());
        assert_eq!(rig.hear(DeviceFrame::Ack).status, STATUS_OPEN | STATUS_BAD_RATE);
    }
    for (clocks_per_bit, off) in [(8.0, 1.0), (8.0, 0.98), (8.3, 1.02), (21.7, 0.98), (40.0, 1.02), (8.0, 1.02)] {
        let step = ((1 << 24) as f64 / clocks_per_bit).round() as u32;
        rig.say(SESSION, HostFrame::Rate, 0, &step.to_le_bytes());
        assert_eq!(rig.hear(DeviceFrame::Ack).status, STATUS_OPEN);
        // The last stop bit is under way still.
        rig.wait(60);
        rig.talker.clocks_per_bit = clocks_per_bit * off;
        rig.listener = Listener::new(clocks_per_bit * off);
        rig.say(SESSION, HostFrame::Poll, 0, &[]);
        assert_eq!(rig.hear(DeviceFrame::Ack).status, STATUS_OPEN);
    }
    assert_eq!(rate_step(QUICK_LINK.clock_hz / 8, QUICK_LINK.clock_hz), Some(MAX_STEP));
    rig.data(0, &[0x7700_0064]);
    rig.hear(DeviceFrame::Ack);
    assert_eq!(rig.answer(0), answer_of(0x7700_0064));
    // The end of the session returns to the first rate, behind its last frame.
    rig.say(SESSION, HostFrame::Close, 0, &[]);
    rig.hear(DeviceFrame::Closed);
    rig.wait(60);
    rig.talker.clocks_per_bit = CLOCKS_PER_BIT;
    rig.listener = Listener::new(CLOCKS_PER_BIT);
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    rig.hear(DeviceFrame::NoSession);
}

#[test]
fn silence_and_a_break_end_the_session_and_the_rate() {
    let silence = (QUICK_LINK.silence_ms * QUICK_LINK.clock_hz / 1000) as usize;
    for breaks in [false, true] {
        let mut rig = opened(8);
        let step = (1u32 << 24) / 16;
        rig.say(SESSION, HostFrame::Rate, 0, &step.to_le_bytes());
        rig.hear(DeviceFrame::Ack);
        rig.wait(100);
        (rig.talker.clocks_per_bit, rig.listener) = (16.0, Listener::new(16.0));
        // Polls keep it open, for longer than the silence.
        for _ in 0..4 {
            rig.wait(silence / 3);
            rig.say(SESSION, HostFrame::Poll, 0, &[]);
            assert_eq!(rig.hear(DeviceFrame::Ack).status, STATUS_OPEN);
        }
        rig.data(0, &[0x0100_0000 | 4000]);
        rig.hear(DeviceFrame::Ack);
        if breaks {
            rig.talker.hold(false, 85);
            rig.wait(990);
            assert_eq!(rig.pins.get("core_reset"), 0);
            rig.wait(600);
        } else {
            rig.wait(silence + 200);
        }
        (rig.talker.clocks_per_bit, rig.listener) = (CLOCKS_PER_BIT, Listener::new(CLOCKS_PER_BIT));
        rig.wait(3000);
        rig.listener = Listener::new(CLOCKS_PER_BIT);
        assert_eq!(rig.pins.get("core_reset"), 1);
        rig.say(SESSION, HostFrame::Poll, 0, &[]);
        rig.hear(DeviceFrame::NoSession);
        rig.open();
    }
}

#[test]
fn replies_come_in_their_order_and_an_ack_stands_for_many() {
    let mut rig = opened(9);
    rig.data(0, &[0x0100_0000 | 400]);
    rig.hear(DeviceFrame::Ack);
    rig.wait(600);
    // While a part of the answer is sent, much is asked for.
    for number in 1..5 {
        rig.data(number, &[0x0200_0000]);
    }
    rig.say(SESSION, HostFrame::Hello, 0, &[]);
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    rig.hear(DeviceFrame::Answer);
    rig.hear(DeviceFrame::Hello);
    assert_eq!(rig.hear(DeviceFrame::Ack).expected, 5);
    rig.hear(DeviceFrame::AnswerEnd);
    for answer in 1..5 {
        assert_eq!(rig.answer(answer), [0x0200_0000, 0]);
    }
    rig.nothing_comes(3000);
    // A closing goes before what was due to the session, and that is forgotten.
    rig.data(5, &[0x0300_0000 | 250]);
    rig.say(SESSION, HostFrame::Poll, 0, &[]);
    rig.say(SESSION, HostFrame::Close, 0, &[]);
    let mut frame = rig.hear_within(300_000).expect("a frame");
    while frame.kind != DeviceFrame::Closed as u8 {
        frame = rig.hear_within(300_000).expect("a frame");
    }
    assert_eq!(frame.session, 0);
    rig.nothing_comes(30_000);
}

#[test]
fn noise_costs_frames_and_changes_no_word() {
    let mut rig = opened(10);
    let mut random = SplitMix64::new(12);
    let (mut expected, mut taken, mut lost) = (0u8, Vec::new(), 0);
    for run in 0..250u32 {
        let words: Vec<u32> = (0..1 + random.below(5)).map(|_| random.below(256) as u32 * 0x0101_0000).collect();
        let mut line = cobs(&host_frame(SESSION, HostFrame::Data as u8, expected, &payload(&words)));
        let is_hit = random.below(3) == 0;
        if is_hit {
            let place = random.below(line.len() as u64) as usize;
            match random.below(4) {
                0 => line[place] ^= 1 << random.below(8),
                1 => drop(line.remove(place)),
                2 => line.insert(place, random.below(256) as u8),
                _ => line.swap(place, 0),
            }
        }
        rig.talker.say(&line);
        // Whatever became of it: a zero and a poll bring the two sides together.
        rig.talker.say(&[0]);
        rig.say(SESSION, HostFrame::Poll, 0, &[]);
        let mut state = None;
        while let Some(frame) = rig.hear_within(8000) {
            if frame.kind == DeviceFrame::Ack as u8 || frame.kind == DeviceFrame::Nak as u8 {
                state = Some(frame);
            }
        }
        let state = state.expect("an answer to the poll");
        if state.expected != expected {
            assert_eq!(state.expected, expected.wrapping_add(1));
            taken.extend(words);
            expected = state.expected;
        } else {
            assert!(is_hit, "run {run}: a sound frame was not taken");
            lost += 1;
        }
        assert_eq!(state.words(), [crc32(&payload(&taken))]);
    }
    assert_eq!(rig.core.taken, taken);
    assert!(lost > 30, "{lost} frames lost");
}
