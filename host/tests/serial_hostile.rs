//! Serial devices that lie, and lines that babble: whatever comes, the engine neither panics nor hangs, holds no more than the job needs, and
//! hands out nothing but a whole answer of the right length or a fault of its own.

#[path = "common/board.rs"]
mod board;
#[path = "common/heap.rs"]
mod heap;

use std::time::Duration;

use board::{crc32, frame, greeting};
use incircle::serial::{Engine, Params};
use incircle_protocol::{command_word, Opcode};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

/// Of each property.
const CASES: u32 = 36_000;
/// What the engine may hold besides command and answer: frames under way, a frame that comes, small change.
const BESIDES: isize = 48 * 1024;
/// Words of the longest legal answer that is not a range of records.
const LONGEST: usize = 2 + 128;

/// Something that happens to the engine.
#[derive(Clone, Debug)]
enum Event {
    /// Time passes, in microseconds.
    Wait(u32),
    /// Bytes that are no frame.
    Noise(Vec<u8>),
    /// A frame of the device; what it says is anything, its check sum holds. A session of 1 stands for the right one.
    Frame { session: u8, kind: u8, header: [u8; 5], body: Body },
    /// The last frame once more, or only its first bytes.
    Again { bytes: usize },
    /// The host gives up.
    Close,
}

#[derive(Clone, Debug)]
enum Body {
    Raw(Vec<u8>),
    /// A greeting with one word changed.
    Greeting {
        place: usize,
        value: u32,
    },
    /// A part of an answer: how far its number and its index are off, its words, and whether its check sum is right.
    Part {
        number: u8,
        index: u16,
        header: u32,
        length: u32,
        words: usize,
        is_sound: bool,
    },
    /// The check sum of so many bytes of payload: right for none.
    Digest(u32),
}

fn body() -> impl Strategy<Value = Body> {
    let odd = prop_oneof![Just(0u32), Just(1), Just(u32::MAX), any::<u32>(), 0u32..2000];
    let header = prop_oneof![3 => (1u32..8).prop_map(|opcode| opcode << 24), 1 => any::<u32>()];
    prop_oneof![
        1 => proptest::collection::vec(any::<u8>(), 0..40).prop_map(Body::Raw),
        1 => (0usize..14, odd.clone()).prop_map(|(place, value)| Body::Greeting { place, value }),
        6 => (0u8..3, prop_oneof![4 => 0u16..4, 1 => any::<u16>()], header, odd, 1usize..257, prop::bool::weighted(0.8))
            .prop_map(|(number, index, header, length, words, is_sound)| {
                Body::Part { number, index, header, length, words, is_sound }
            }),
        2 => prop_oneof![Just(0u32), any::<u32>()].prop_map(Body::Digest),
    ]
}

fn event() -> impl Strategy<Value = Event> {
    let kind = prop_oneof![8 => 0x81u8..0x89, 1 => any::<u8>()];
    let session = prop_oneof![6 => Just(1u8), 1 => Just(0), 1 => any::<u8>()];
    let header = (prop_oneof![3 => 0u8..3, 1 => any::<u8>()], 0u8..4, any::<u8>(), 0u8..17, any::<u8>());
    let header = header.prop_map(|(expected, answers, low, high, status)| [expected, answers, low, high, status]);
    prop_oneof![
        4 => (0u32..200_000).prop_map(Event::Wait),
        1 => proptest::collection::vec(any::<u8>(), 0..60).prop_map(Event::Noise),
        8 => (session, kind, header, body())
            .prop_map(|(session, kind, header, body)| Event::Frame { session, kind, header, body }),
        1 => (0usize..2000).prop_map(|bytes| Event::Again { bytes }),
    ]
}

fn command() -> impl Strategy<Value = Vec<u32>> {
    prop_oneof![
        Just(vec![command_word(Opcode::Hello)]),
        Just(vec![command_word(Opcode::Clear)]),
        Just(vec![command_word(Opcode::Counters)]),
        Just(vec![command_word(Opcode::Latencies)]),
        (0u32..3000).prop_map(|count| {
            let mut words = vec![command_word(Opcode::Insert), count];
            words.extend(0..count);
            words
        }),
        (any::<u16>(), 0u32..3000).prop_map(|(first, count)| vec![command_word(Opcode::Read), u32::from(first), count]),
    ]
}

/// Words that its answer may have.
fn most_words(command: &[u32]) -> usize {
    if command.len() == 3 && command[0] == command_word(Opcode::Read) {
        2 + 3 * command[2] as usize
    } else {
        LONGEST
    }
}

fn bytes_of(session: u8, kind: u8, header: [u8; 5], body: &Body) -> Vec<u8> {
    let mut plain = vec![session, kind];
    plain.extend(header);
    match body {
        Body::Raw(bytes) => plain.extend(bytes),
        Body::Greeting { place, value } => {
            let mut words = greeting(4096);
            if let Some(word) = words.get_mut(*place) {
                *word = *value;
            }
            plain.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        }
        Body::Part { number, index, header, length, words, is_sound } => {
            plain.push(*number);
            plain.extend(index.to_le_bytes());
            let all: Vec<u8> =
                [*header, *length].iter().chain(&[7; 300]).take(*words).flat_map(|word| word.to_le_bytes()).collect();
            plain.extend(&all);
            if kind == 0x86 {
                plain.extend((crc32(&all) ^ u32::from(!is_sound)).to_le_bytes());
            }
        }
        Body::Digest(digest) => plain.extend(digest.to_le_bytes()),
    }
    frame(&plain)
}

/// The engine under test, with what is held of it.
struct Bench {
    engine: Engine,
    now: Duration,
    session: u8,
    last: Vec<u8>,
}

impl Bench {
    fn new(rates: Vec<u32>) -> Self {
        let engine = Engine::new(Params { rates, session: 41 });
        Self { engine, now: Duration::from_secs(1), session: 42, last: Vec::new() }
    }

    /// Lets the engine say what is due, as often as it wants within the time.
    fn wait(&mut self, until: Duration) {
        for _ in 0..10_000 {
            let mut out = Vec::new();
            self.engine.transmit(self.now, &mut out);
            assert!(out.len() < 64 * 1024, "{} bytes at once", out.len());
            match self.engine.next_wake() {
                Some(wake) if wake <= until => self.now = self.now.max(wake),
                _ => {
                    self.now = until;
                    return;
                }
            }
        }
        panic!("it wakes without end until {until:?}");
    }

    fn happen(&mut self, event: &Event) {
        match event {
            Event::Wait(microseconds) => self.wait(self.now + Duration::from_micros(u64::from(*microseconds))),
            Event::Noise(bytes) => self.engine.receive(bytes, self.now),
            Event::Frame { session, kind, header, body } => {
                let session = if *session == 1 { self.session } else { *session };
                self.last = bytes_of(session, *kind, *header, body);
                self.engine.receive(&self.last, self.now);
            }
            Event::Again { bytes } => {
                let bytes = (*bytes).min(self.last.len());
                self.engine.receive(&self.last[..bytes], self.now);
            }
            Event::Close => self.engine.close(self.now),
        }
        self.wait(self.now);
    }

    /// A sound device up to the open session.
    fn open(&mut self) {
        self.wait(self.now);
        let greeting = Body::Greeting { place: 13, value: 0 };
        self.engine.receive(&bytes_of(0, 0x81, [0, 0, 0, 16, 0], &greeting), self.now);
        self.engine.receive(&bytes_of(self.session, 0x82, [0, 0, 0, 16, 1], &Body::Raw(vec![])), self.now);
        self.wait(self.now);
    }
}

/// Runs the events; the engine must stay within its bounds at each of them.
fn check(bench: &mut Bench, command: &[u32], events: &[Event]) -> Result<(), TestCaseError> {
    let most = most_words(command);
    let bound = 4 * (command.len() + most) as isize + BESIDES;
    for event in events {
        bench.happen(event);
        prop_assert!(heap::held() <= bound, "{} bytes held, {bound} allowed", heap::held());
        if let Some(answer) = bench.engine.take_answer() {
            prop_assert!(answer.len() >= 2 && answer.len() <= most, "{} words", answer.len());
            prop_assert!(answer.len() == 2 + answer[1] as usize || answer.len() == 2, "{} words", answer.len());
        }
    }
    // Left alone it comes to an end, or goes on asking without haste.
    bench.wait(bench.now + Duration::from_secs(8));
    prop_assert!(bench.engine.check().is_err() || bench.engine.is_closed() || !bench.engine.is_open());
    Ok(())
}

fn run(cases: u32, strategy: impl Strategy<Value = (Vec<u32>, Vec<Event>)>, is_open: bool, rates: &[u32]) {
    let mut runner = TestRunner::new(Config { cases, failure_persistence: None, ..Config::default() });
    let result = runner.run(&strategy, |(command, events)| {
        heap::watch();
        let mut bench = Bench::new(rates.to_vec());
        bench.engine.ask(&command, bench.now).map_err(|fault| TestCaseError::fail(fault.to_string()))?;
        if is_open {
            bench.open();
            prop_assert!(bench.engine.is_open());
        }
        check(&mut bench, &command, &events)
    });
    if let Err(error) = result {
        panic!("{error}");
    }
}

#[test]
fn whatever_a_device_says_in_a_session() {
    run(CASES, (command(), proptest::collection::vec(event(), 0..16)), true, &[]);
}

#[test]
fn whatever_a_device_says_from_the_beginning() {
    let close = prop_oneof![30 => event(), 1 => Just(Event::Close)];
    run(CASES, (command(), proptest::collection::vec(close, 0..16)), false, &[3_000_000]);
}

#[test]
fn whatever_bytes_come() {
    let noise = proptest::collection::vec(prop_oneof![Just(0u8), any::<u8>()], 0..100).prop_map(Event::Noise);
    let events = proptest::collection::vec(prop_oneof![3 => noise, 1 => event()], 0..6);
    run(CASES, (command(), events), true, &[]);
}

/// A device that goes on with one answer for ever is stopped.
#[test]
fn an_answer_without_end() {
    for opcode in [Opcode::Hello, Opcode::Read, Opcode::Latencies] {
        let mut bench = Bench::new(vec![]);
        let command =
            if opcode == Opcode::Read { vec![command_word(opcode), 0, 3000] } else { vec![command_word(opcode)] };
        bench.engine.ask(&command, bench.now).expect("a command");
        bench.open();
        let mut index = 0u16;
        while bench.engine.check().is_ok() {
            assert!(index < 1024, "it is not stopped");
            let part = Body::Part { number: 0, index, header: 1 << 24, length: u32::MAX, words: 256, is_sound: true };
            bench.engine.receive(&bytes_of(42, 0x85, [1, 0, 0, 16, 1], &part), bench.now);
            index += 256;
        }
        let fault = bench.engine.check().expect_err("stopped").to_string();
        assert!(fault.contains("more than the"), "{fault}");
    }
}
