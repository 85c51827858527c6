//! Devices whose frames are sound and whose answers lie: every lie ends in a typed error or does no harm. No lie makes
//! the driver panic or hang.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::convert::Infallible;
use std::rc::Rc;

use embedded_io::{ErrorType, Read, ReadReady, Write};
use incircle_embedded::{Buffers, Clock, Device, Error, Fault};
use incircle_model::serial::{core_identity, FromDevice, Instantly, Passed, WordDevice};
use incircle_protocol::{DeviceFrame, Greeting, LINK_MAGIC, LINK_VERSION, SMALL};
use incircle_testkit::SplitMix64;

use crate::rig::{by_cpu, random_points, run, Board};

/// A core of which one word of all its answers is changed.
struct Liar {
    core: Instantly,
    said: u64,
    word: u64,
    change: fn(u32) -> u32,
}

impl WordDevice for Liar {
    fn reset(&mut self) {
        self.core.reset();
    }

    fn step(&mut self, command: Option<u32>, takes_answer: bool) -> Passed {
        let mut passed = self.core.step(command, takes_answer);
        for word in passed.answer.iter_mut().flatten() {
            if self.said == self.word {
                *word = (self.change)(*word);
            }
            self.said += 1;
        }
        passed
    }
}

#[test]
fn every_word_of_an_answer_is_checked() {
    let points = random_points(24, 1 << 12, 5);
    let expected = by_cpu(&points);
    let changes: [fn(u32) -> u32; 6] =
        [|_| 0, |_| u32::MAX, |word| word ^ 1, |word| word.swap_bytes(), |word| word ^ 1 << 16, |word| word ^ 1 << 30];
    let (mut found_out, mut harmless) = (0, 0);
    for word in 0..90 {
        for (number, &change) in changes.iter().enumerate() {
            let core = Instantly::of(SMALL).unwrap();
            let board = Board::new(core.identity(), Liar { core, said: 0, word, change });
            match run(&board, &points) {
                Ok(mesh) => {
                    assert_eq!(mesh, expected, "{word} {number}");
                    harmless += 1;
                }
                Err(Error::Device(_) | Error::Lost { .. } | Error::Timeout { .. }) => found_out += 1,
                Err(error) => panic!("{word} {number}: {error}"),
            }
        }
    }
    println!("{found_out} lies found out, {harmless} without harm");
    assert!(found_out > 300, "{found_out}");
}

#[test]
fn a_status_and_a_report_are_named() {
    let points = random_points(24, 1 << 12, 5);
    let fault = |word: u64, change: fn(u32) -> u32| {
        let core = Instantly::of(SMALL).unwrap();
        match run(&Board::new(core.identity(), Liar { core, said: 0, word, change }), &points) {
            Err(Error::Device(fault)) => fault,
            other => panic!("{word}: {other:?}"),
        }
    };
    assert_eq!(fault(0, |_| 0x0205_0000), Fault::Status { opcode: 2, header: 0x0205_0000 });
    assert_eq!(fault(2, |_| 0x0304_0000), Fault::Status { opcode: 3, header: 0x0304_0000 });
    assert_eq!(fault(4, |_| 7), Fault::Report { what: "points that arrived", found: 7, expected: 24 });
    assert_eq!(fault(8, |_| 44), Fault::Report { what: "records", found: 44, expected: 46 });
    assert!(matches!(fault(11, |_| 0), Fault::Vertices { .. } | Fault::Orientation { .. }));
}

#[test]
fn greetings_of_other_devices_are_refused() {
    let points = random_points(24, 1 << 12, 5);
    let core = || Instantly::of(SMALL).unwrap();
    let fault = |change: fn(&mut incircle_protocol::Identity)| {
        let mut identity = core().identity();
        change(&mut identity);
        match run(&Board::new(identity, core()), &points) {
            Err(Error::Device(Fault::Greeting { what, found, .. })) => (what, found),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(fault(|identity| identity.magic = 5), ("mark of the core", 5));
    assert_eq!(fault(|identity| identity.protocol_version = 3 << 16), ("version of the protocol", 3 << 16));
    assert_eq!(fault(|identity| identity.coord_bits = 0), ("bits of a coordinate", 0));
    assert_eq!(fault(|identity| identity.capacity = 1), ("number of points", 1));
    assert_eq!(fault(|identity| identity.contexts = 0), ("number of contexts", 0));
}

/// A device that greets, and then says random frames with sound check sums without an end.
struct Babbler {
    random: SplitMix64,
    bytes: VecDeque<u8>,
    has_greeted: bool,
    nanoseconds: u64,
}

/// The port and the clock of a host that listens to a babbler.
struct Ear(Rc<RefCell<Babbler>>);

impl Babbler {
    fn say(&mut self) {
        let kinds = [0x82, 0x83, 0x84, 0x85, 0x86, 0x87, 0x88].map(|kind| DeviceFrame::from_u8(kind).unwrap());
        let random = &mut self.random;
        let mut frame = FromDevice {
            session: random.below(2) as u8,
            kind: random.pick(&kinds),
            expected: random.below(3) as u8,
            answers: random.below(3) as u8,
            free: random.below(5000) as u16,
            status: 0,
            body: (0..random.below(40)).map(|_| random.below(3) as u8).collect(),
        };
        if !std::mem::replace(&mut self.has_greeted, true) {
            let greeting = Greeting {
                magic: LINK_MAGIC,
                link_version: LINK_VERSION,
                clock_hz: 1,
                fifo_bytes: 4096,
                max_rate: 1,
                silence_ms: 2000,
                identity: core_identity(SMALL),
            };
            frame.kind = DeviceFrame::Hello;
            frame.body = greeting.to_words().into_iter().flat_map(u32::to_le_bytes).collect();
        }
        self.bytes.extend(frame.to_line());
    }
}

impl ErrorType for Ear {
    type Error = Infallible;
}

impl Read for Ear {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Infallible> {
        let mut babbler = self.0.borrow_mut();
        if babbler.bytes.is_empty() {
            babbler.say();
        }
        babbler.nanoseconds += 87_000;
        buffer[0] = babbler.bytes.pop_front().unwrap();
        Ok(1)
    }
}

impl ReadReady for Ear {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(true)
    }
}

impl Write for Ear {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        self.0.borrow_mut().nanoseconds += 87_000;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

impl Clock for Ear {
    fn milliseconds(&mut self) -> u32 {
        (self.0.borrow().nanoseconds / 1_000_000) as u32
    }
}

#[test]
fn a_device_that_never_stops_talking_ends_in_an_error() {
    let points = random_points(100, 1 << 12, 5);
    for (seed, has_greeted) in (0..300).zip([false, true].into_iter().cycle()) {
        let babbler = Babbler { random: SplitMix64::new(seed), bytes: VecDeque::new(), has_greeted, nanoseconds: 0 };
        let ear = Rc::new(RefCell::new(babbler));
        let mut device = Device::new(Ear(ear.clone()), Ear(ear.clone()));
        let (mut order, mut records) = ([0; 100], [[0; 3]; 198]);
        let buffers = Buffers { order: &mut order, records: &mut records };
        let found = device.triangulate(&points, buffers, 20_000).map(|_| ());
        if has_greeted {
            // It says everything but a greeting.
            assert!(matches!(found, Err(Error::Noise { .. })), "{seed}: {found:?}");
        } else {
            assert!(found.is_err(), "{seed}");
        }
        assert!(ear.borrow().nanoseconds < 30_000_000_000, "{seed}");
    }
}
