//! Serial devices that lie, and lines that babble. Whatever comes, the protocol neither panics nor hangs, holds no more
//! memory than the job needs, and hands out either a whole answer of the right length or a fault of its own.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use crate::common::board::{cobs_decode, crc32, crc32_more, frame, greeting, CAPACITY};
use crate::common::heap;
use incircle::transports::parts::{Params, SerialProtocol};
use incircle_protocol::{Clear, Command, Layout, RecordRange, ShortIds};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

/// Cases tried for each property.
const CASES: u32 = 36_000;
/// Bytes that the protocol may hold besides command and answer, for frames under way and a frame that comes.
const MOST_OVERHEAD: isize = 48 * 1024;
/// Words of the longest answer that is not a range of records.
const LONGEST: usize = 2 + 128;

/// Something that happens to the protocol.
#[derive(Clone, Debug)]
enum Event {
    /// Time passes, in microseconds.
    Wait(u32),
    /// Bytes come that are not a frame.
    Noise(Vec<u8>),
    /// A frame of any content comes, with a check sum that holds. A session of 1 stands for the right one.
    Frame { session: u8, kind: u8, header: [u8; 5], body: Body },
    /// The device acknowledges all frames of the host but the last `behind`, with the right check sum of their payload.
    Proof { behind: usize },
    /// The last frame comes once more, or only its first bytes.
    Again { bytes: usize },
    /// The host closes the session.
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
    /// A part of an answer, with any number and index, and with a check sum that may be wrong.
    Part {
        number: u8,
        index: u16,
        header: u32,
        length: u32,
        words: usize,
        is_sound: bool,
    },
    /// A check sum of payload, which is right only by chance.
    Digest(u32),
}

fn odd() -> impl Strategy<Value = u32> {
    prop_oneof![Just(0u32), Just(1), Just(u32::MAX), any::<u32>(), 0u32..2000]
}

/// A part of an answer. In most cases it has as many words as it announces.
fn part() -> impl Strategy<Value = Body> {
    let header = prop_oneof![3 => (1u32..8).prop_map(|opcode| opcode << 24), 1 => any::<u32>()];
    let length = proptest::option::weighted(0.2, odd());
    let words = prop_oneof![1 => 1usize..257, 1 => 2usize..12];
    let index = prop_oneof![4 => Just(0u16), 1 => 0u16..4, 1 => any::<u16>()];
    (0u8..3, index, header, length, words, prop::bool::weighted(0.8)).prop_map(
        |(number, index, header, length, words, is_sound)| {
            let length = length.unwrap_or((words as u32).saturating_sub(2));
            Body::Part { number, index, header, length, words, is_sound }
        },
    )
}

fn body() -> impl Strategy<Value = Body> {
    prop_oneof![
        1 => proptest::collection::vec(any::<u8>(), 0..40).prop_map(Body::Raw),
        1 => (0usize..14, odd()).prop_map(|(place, value)| Body::Greeting { place, value }),
        6 => part(),
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
        2 => part().prop_map(|body| Event::Frame { session: 1, kind: 0x86, header: [1, 0, 0, 16, 1], body }),
        2 => (0usize..3).prop_map(|behind| Event::Proof { behind }),
        1 => (0usize..2000).prop_map(|bytes| Event::Again { bytes }),
    ]
}

fn command() -> impl Strategy<Value = Command<Vec<u32>>> {
    prop_oneof![
        Just(Command::Hello),
        Just(Command::Clear(Clear::one_mesh(0))),
        Just(Command::Counters),
        Just(Command::Latencies),
        (0u32..3000).prop_map(insert),
        (any::<u16>(), 0u32..3000).prop_map(|(first, count)| read(u32::from(first), count)),
        (any::<u16>(), 0u32..3000, 0usize..3).prop_map(|(first, count, form)| {
            let range = RecordRange { first: u32::from(first), count };
            let short = |ids| Command::ShortTriangles(range, ids);
            [Command::Triangles(range), short(ShortIds::Ten), short(ShortIds::Twelve)][form].clone()
        }),
    ]
}

/// Most words of the answer to a command.
fn most_words(command: &Command<Vec<u32>>) -> usize {
    match command {
        Command::Read(_) | Command::Triangles(_) | Command::ShortTriangles(..) => {
            2 + command.payload_words(Layout::of(16, CAPACITY)) as usize
        }
        _ => LONGEST,
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

/// The protocol under test, with a record of the frames that it sent.
struct Bench {
    protocol: SerialProtocol,
    now: Duration,
    session: u8,
    last: Vec<u8>,
    /// Number of `Data` frames of the session.
    frames: usize,
    answers: u8,
    /// Check sums of the payload up to each of the last frames.
    digests: VecDeque<u32>,
}

/// Number of answers that were handed out.
static HANDED_OUT: AtomicUsize = AtomicUsize::new(0);

impl Bench {
    fn new(rates: Vec<u32>) -> Self {
        let protocol = SerialProtocol::new(Params { rates, session: 41 });
        let (now, last, digests) = (Duration::from_secs(1), Vec::new(), VecDeque::from([0]));
        Self { protocol, now, session: 42, last, frames: 0, answers: 0, digests }
    }

    /// Lets the protocol send the bytes that are due, as often as it wants until that time.
    fn wait(&mut self, until: Duration) {
        let (mut last, mut idle) = (self.now, 0);
        for _ in 0..10_000 {
            let mut out = Vec::new();
            self.protocol.transmit(self.now, &mut out);
            assert!(out.len() < 64 * 1024, "{} bytes at once", out.len());
            self.heed(&out);
            // A protocol that asks to be called at a time must have something to send then.
            idle = if out.is_empty() && self.now == last { idle + 1 } else { 0 };
            assert!(idle < 4, "it wakes for nothing at {:?}", self.now);
            last = self.now;
            match self.protocol.next_wake() {
                Some(wake) if wake <= until => self.now = self.now.max(wake),
                _ => {
                    self.now = until;
                    return;
                }
            }
        }
        panic!("it wakes without end until {until:?}");
    }

    /// Records the `Data` frames that go out for the first time.
    fn heed(&mut self, out: &[u8]) {
        for piece in out.split(|&byte| byte == 0) {
            let frame = cobs_decode(piece).unwrap_or_default();
            if frame.len() > 9 && frame[1] == 5 && frame[2] == self.frames as u8 {
                self.frames += 1;
                let digest = self.digests.back().copied().unwrap_or(0);
                self.digests.push_back(crc32_more(digest, &frame[5..frame.len() - 4]));
                if self.digests.len() > 32 {
                    self.digests.pop_front();
                }
            }
        }
    }

    /// Makes the device acknowledge all frames but the last `behind`.
    fn prove(&mut self, behind: usize) {
        let behind = behind.min(self.digests.len() - 1);
        let digest = Body::Digest(self.digests[self.digests.len() - 1 - behind]);
        let header = [(self.frames - behind) as u8, self.answers, 0, 16, 1];
        self.protocol.receive(&bytes_of(self.session, 0x83, header, &digest), self.now);
    }

    fn happen(&mut self, event: &Event) {
        match event {
            Event::Wait(microseconds) => self.wait(self.now + Duration::from_micros(u64::from(*microseconds))),
            Event::Noise(bytes) => self.protocol.receive(bytes, self.now),
            Event::Frame { session, kind, header, body } => {
                let session = if *session == 1 { self.session } else { *session };
                self.last = bytes_of(session, *kind, *header, body);
                self.protocol.receive(&self.last, self.now);
            }
            Event::Proof { behind } => self.prove(*behind),
            Event::Again { bytes } => {
                let bytes = (*bytes).min(self.last.len());
                self.protocol.receive(&self.last[..bytes], self.now);
            }
            Event::Close => self.protocol.close(self.now),
        }
        self.wait(self.now);
    }

    /// Plays a sound device up to the open session.
    fn open(&mut self) {
        self.open_with(13, 0);
    }

    /// Does what [`Bench::open`] does, with another word in the greeting.
    fn open_with(&mut self, place: usize, value: u32) {
        self.wait(self.now);
        let greeting = Body::Greeting { place, value };
        self.protocol.receive(&bytes_of(0, 0x81, [0, 0, 0, 16, 0], &greeting), self.now);
        self.protocol.receive(&bytes_of(self.session, 0x82, [0, 0, 0, 16, 1], &Body::Raw(vec![])), self.now);
        self.wait(self.now);
    }
}

/// Runs the events, and checks that the protocol stays within its bounds at each of them.
fn check(bench: &mut Bench, command: &Command<Vec<u32>>, events: &[Event]) -> Result<(), TestCaseError> {
    let most = most_words(command);
    let bound = 4 * (command.words() + most) as isize + MOST_OVERHEAD;
    for event in events {
        bench.happen(event);
        prop_assert!(heap::held() <= bound, "{} bytes held, {bound} allowed", heap::held());
        if let Some(answer) = bench.protocol.take_answer() {
            prop_assert!(answer.len() >= 2 && answer.len() <= most, "{} words", answer.len());
            prop_assert!(answer.len() == 2 + answer[1] as usize || answer.len() == 2, "{} words", answer.len());
            HANDED_OUT.fetch_add(1, Ordering::Relaxed);
        }
    }
    // Left alone, the protocol comes to an end, or goes on polling without haste.
    bench.wait(bench.now + Duration::from_secs(8));
    prop_assert!(bench.protocol.check().is_err() || bench.protocol.is_closed() || !bench.protocol.is_open());
    Ok(())
}

fn run(cases: u32, strategy: impl Strategy<Value = (Command<Vec<u32>>, Vec<Event>)>, is_open: bool, rates: &[u32]) {
    let mut runner = TestRunner::new(Config { cases, failure_persistence: None, ..Config::default() });
    let result = runner.run(&strategy, |(command, events)| {
        heap::watch();
        let mut bench = Bench::new(rates.to_vec());
        bench.protocol.ask(command.borrowed(), bench.now).map_err(|fault| TestCaseError::fail(fault.to_string()))?;
        if is_open {
            bench.open();
            prop_assert!(bench.protocol.is_open());
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
    let answers = HANDED_OUT.load(Ordering::Relaxed);
    println!("{answers} answers were handed out");
    assert!(answers > 500, "only {answers} answers were handed out");
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

/// A device that never ends an answer is stopped.
#[test]
fn an_answer_without_end() {
    for command in [Command::Hello, read(0, 3000), Command::Latencies] {
        let mut bench = Bench::new(vec![]);
        bench.protocol.ask(command.borrowed(), bench.now).expect("a command");
        bench.open();
        let mut index = 0u16;
        while bench.protocol.check().is_ok() {
            assert!(index < 1024, "it is not stopped");
            let part = Body::Part { number: 0, index, header: 1 << 24, length: u32::MAX, words: 256, is_sound: true };
            bench.protocol.receive(&bytes_of(42, 0x85, [1, 0, 0, 16, 1], &part), bench.now);
            index += 256;
        }
        let fault = bench.protocol.check().expect_err("stopped").to_string();
        assert!(fault.contains("has more than"), "{fault}");
    }
}

/// The protocol with a session open and this command asked.
fn asked(command: &Command<Vec<u32>>) -> Bench {
    let mut bench = Bench::new(vec![]);
    bench.protocol.ask(command.borrowed(), bench.now).expect("a command");
    bench.open();
    bench
}

fn insert(count: u32) -> Command<Vec<u32>> {
    Command::Insert { count, points: (0..count).collect() }
}

fn read(first: u32, count: u32) -> Command<Vec<u32>> {
    Command::Read(RecordRange { first, count })
}

fn commands() -> [Command<Vec<u32>>; 4] {
    [Command::Latencies, read(0, 3000), insert(3), insert(3000)]
}

/// The whole answer of an insertion.
const REPORT: Body = Body::Part { number: 0, index: 0, header: 3 << 24, length: 5, words: 7, is_sound: true };

#[test]
fn an_answer_needs_a_question_that_was_taken() {
    for command in commands() {
        let mut bench = asked(&command);
        bench.protocol.receive(&bytes_of(42, 0x86, [0, 0, 0, 16, 1], &REPORT), bench.now);
        let fault = bench.protocol.check().expect_err("it has taken nothing").to_string();
        assert!(fault.contains("has taken 0"), "{fault}");
        assert_eq!(bench.protocol.take_answer(), None);
        let mut bench = asked(&command);
        bench.protocol.receive(&bytes_of(42, 0x83, [0, 1, 0, 16, 1], &Body::Digest(0)), bench.now);
        let fault = bench.protocol.check().expect_err("it has taken nothing").to_string();
        assert!(fault.contains("has taken 0"), "{fault}");
    }
    // A command of which the device has taken a part is not taken.
    let mut bench = asked(&insert(3000));
    bench.protocol.receive(&bytes_of(42, 0x86, [1, 0, 0, 16, 1], &REPORT), bench.now);
    let fault = bench.protocol.check().expect_err("more is to come").to_string();
    assert!(fault.contains("ends at byte 12008") && fault.contains("has taken 256"), "{fault}");
    let mut bench = asked(&insert(3));
    bench.protocol.receive(&bytes_of(42, 0x86, [1, 0, 0, 16, 1], &REPORT), bench.now);
    assert_eq!(bench.protocol.take_answer(), None, "what it has taken is not proved");
    bench.prove(0);
    assert_eq!(bench.protocol.take_answer().map(|answer| answer.len()), Some(7));
}

/// A device that counts answers for ever makes no memory grow, whether it takes the commands or not.
#[test]
fn answers_that_are_counted_and_never_come() {
    for (command, takes) in commands().into_iter().flat_map(|command| [(command.clone(), false), (command, true)]) {
        heap::watch();
        let mut bench = asked(&command);
        let bound = 4 * (command.words() + most_words(&command)) as isize + MOST_OVERHEAD;
        for step in 0..100_000 {
            if takes {
                bench.wait(bench.now + Duration::from_millis(3));
                bench.prove(0);
            }
            // By then a device that takes commands has taken all of the command.
            if !takes || step > 1000 {
                bench.answers = bench.answers.wrapping_add(1);
            }
            let expected = if takes { bench.frames as u8 } else { 0 };
            let frame = bytes_of(42, 0x82, [expected, bench.answers, 0, 16, 1], &Body::Raw(vec![]));
            bench.protocol.receive(&frame, bench.now);
            assert!(heap::held() <= bound, "{} bytes held, {bound} allowed", heap::held());
        }
        assert_eq!(bench.protocol.check().is_ok(), takes);
    }
}

#[test]
fn no_answer_is_longer_than_its_command_may_bring() {
    for (words, is_longest) in [(130, true), (131, false), (200, false)] {
        let mut bench = asked(&Command::Hello);
        let length = words as u32 - 2;
        let part = Body::Part { number: 0, index: 0, header: 1 << 24, length, words, is_sound: true };
        bench.protocol.receive(&bytes_of(42, 0x86, [1, 0, 0, 16, 1], &part), bench.now);
        bench.prove(0);
        match bench.protocol.check() {
            Ok(()) => assert!(is_longest && bench.protocol.take_answer().is_some_and(|answer| answer.len() == words)),
            Err(fault) => assert!(!is_longest && fault.to_string().contains("more than 130 words"), "{fault}"),
        }
    }
}

/// With a short silence a `Poll` is due before the line has carried the frame before it.
#[test]
fn what_is_due_waits_for_the_line() {
    let mut bench = Bench::new(vec![]);
    bench.protocol.ask(insert(3000).borrowed(), bench.now).expect("a command");
    bench.open_with(5, 20);
    bench.wait(bench.now + Duration::from_millis(300));
    assert!(bench.frames > 0 && bench.protocol.statistics().polls > 0);
}
