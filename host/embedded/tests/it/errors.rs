//! Errors of the caller, of the wiring and of other hosts, each found with its numbers.

use embedded_io::{ErrorType, Read, ReadReady, Write};
use incircle_embedded::{records_needed, Buffers, Device, Error};
use incircle_model::serial::{FromHost, Instantly, SerialModel};
use incircle_protocol::{HostFrame, SMALL};

use crate::rig::{ask, by_cpu, random_points, run, small, End, Fate, LINK, PATIENCE};

#[test]
fn wrong_points_and_buffers_are_refused_before_anything_is_sent() {
    let board = small();
    let mut device = Device::new(End(board.clone()), End(board.clone()));
    device.greet().unwrap();
    let sent = board.borrow().bytes;
    let points = random_points(1025, 1 << 16, 1);
    assert_eq!(ask(&mut device, &points, PATIENCE), Err(Error::Capacity { given: 1025, capacity: 1024 }));
    let many = vec![[0, 0]; 65_537];
    assert_eq!(ask(&mut device, &many, PATIENCE), Err(Error::TooManyPoints { given: 65_537, most: 65_536 }));
    let mut order = [0; 10];
    let mut records = [[0; 3]; records_needed(10)];
    for (places, entries, name, given, needed) in [(9, 18, "order", 9, 10), (10, 17, "records", 17, 18)] {
        let buffers = Buffers { order: &mut order[..places], records: &mut records[..entries] };
        let found = device.triangulate(&points[..10], buffers, PATIENCE).map(|_| ());
        assert_eq!(found, Err(Error::Buffer { name, given, needed }));
        assert!(found.unwrap_err().to_string().contains("but these points need"));
    }
    assert_eq!(board.borrow().bytes, sent);

    let core = Instantly::new(8, 64, 16).unwrap();
    let board = crate::rig::Board::new(core.identity(), core);
    let beyond = Error::Coordinate { index: 2, x: 3, y: 256, bits: 8 };
    assert_eq!(run(&board, &[[0, 0], [255, 255], [3, 256]]), Err(beyond));
}

#[test]
fn nothing_or_noise_at_the_port() {
    let points = random_points(5, 99, 1);
    let board = small();
    board.borrow_mut().faults = Box::new(|to_host, _| if to_host { Fate::Lost } else { Fate::Passes });
    assert_eq!(run(&board, &points), Err(Error::Silent));
    board.borrow_mut().faults = Box::new(|to_host, _| if to_host { Fate::Flipped(1) } else { Fate::Passes });
    assert!(matches!(run(&board, &points), Err(Error::Noise { bytes: 500.. })));
}

#[test]
fn a_line_that_is_cut_at_any_byte_ends_the_job() {
    let points = random_points(60, 1 << 16, 1);
    for place in (0..700).step_by(7) {
        let board = small();
        board.borrow_mut().faults = Box::new(move |_, byte| if byte < place { Fate::Passes } else { Fate::Lost });
        let since = board.borrow().nanoseconds;
        match run(&board, &points) {
            Err(Error::Silent | Error::Noise { .. }) => assert!(place < 100, "{place}"),
            Err(Error::Lost { milliseconds: 3000.. }) => {}
            other => panic!("{place}: {other:?}"),
        }
        assert!(board.borrow().nanoseconds - since < 10_000_000_000, "{place}");
    }
}

#[test]
fn a_board_that_is_reset_loses_the_session_and_serves_the_next_job() {
    let points = random_points(300, 1 << 16, 1);
    let board = small();
    let mut device = Device::new(End(board.clone()), End(board.clone()));
    for after in (100..2000).step_by(100) {
        let begin = board.borrow().bytes[1];
        let is_due = std::rc::Rc::new(std::cell::Cell::new(false));
        let due = is_due.clone();
        board.borrow_mut().faults = Box::new(move |to_host, byte| {
            due.set(due.get() || to_host && byte >= begin + after);
            Fate::Passes
        });
        // The board is reset by a clock that looks whether it is time.
        let reset = board.clone();
        let (port, mut clock) = (End(board.clone()), End(board.clone()));
        let mut done = false;
        let ticking = move || {
            if is_due.get() && !done {
                done = true;
                let core = Instantly::of(SMALL).unwrap();
                reset.borrow_mut().model = SerialModel::new(LINK, core.identity(), core);
            }
            incircle_embedded::Clock::idle(&mut clock);
            incircle_embedded::Clock::milliseconds(&mut clock)
        };
        let mut other = Device::new(port, ticking);
        let (mut order, mut records) = (vec![0; 300], vec![[0; 3]; 598]);
        let buffers = Buffers { order: &mut order, records: &mut records };
        let found = other.triangulate(&points, buffers, PATIENCE).map(|_| ());
        assert_eq!(found, Err(Error::Reset { silence_ms: 2000 }), "{after}");
        board.borrow_mut().faults = Box::new(|_, _| Fate::Passes);
        assert_eq!(ask(&mut device, &points, PATIENCE), Ok(by_cpu(&points)), "{after}");
    }
}

#[test]
fn another_host_is_named() {
    let points = random_points(300, 1 << 16, 1);
    let board = small();
    let mut device = Device::new(End(board.clone()), End(board.clone()));
    // The first job has a session of its own number; the other host takes the next one but one, in the second job.
    ask(&mut device, &points, PATIENCE).unwrap();
    let open = FromHost { session: 200, kind: HostFrame::Open, number: 0, payload: vec![] };
    let line: Vec<u8> = [0].into_iter().chain(open.to_line()).collect();
    let begin = board.borrow().bytes[0] + 300;
    // The bytes of the other host replace some of this host's.
    let place = move |byte: u64| byte.checked_sub(begin).and_then(|place| usize::try_from(place).ok());
    let (port, clock) = (Intruder { end: End(board.clone()), line, place: Box::new(place) }, End(board.clone()));
    let mut device = Device::new(port, clock);
    let (mut order, mut records) = (vec![0; 300], vec![[0; 3]; 598]);
    let buffers = Buffers { order: &mut order, records: &mut records };
    let found = device.triangulate(&points, buffers, PATIENCE).map(|_| ());
    assert_eq!(found, Err(Error::Taken { session: 200 }));
}

/// A port on whose line another host speaks.
struct Intruder {
    end: End<Instantly>,
    line: Vec<u8>,
    place: Box<dyn Fn(u64) -> Option<usize>>,
}

impl ErrorType for Intruder {
    type Error = std::convert::Infallible;
}

impl Read for Intruder {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Self::Error> {
        self.end.read(buffer)
    }
}

impl ReadReady for Intruder {
    fn read_ready(&mut self) -> Result<bool, Self::Error> {
        self.end.read_ready()
    }
}

impl Write for Intruder {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Self::Error> {
        let sent = self.end.0.borrow().bytes[0];
        let other = (self.place)(sent).and_then(|place| self.line.get(place).copied());
        self.end.write(&[other.unwrap_or(bytes[0])])
    }

    fn flush(&mut self) -> Result<(), Self::Error> {
        self.end.flush()
    }
}

#[test]
fn a_job_ends_when_its_time_is_over() {
    let points = random_points(300, 1 << 16, 1);
    let board = small();
    let mut device = Device::new(End(board.clone()), End(board.clone()));
    device.greet().unwrap();
    for milliseconds in [0, 1, 10, 100, 300] {
        let since = board.borrow().nanoseconds;
        assert_eq!(ask(&mut device, &points, milliseconds), Err(Error::Timeout { milliseconds }));
        let took = (board.borrow().nanoseconds - since) / 1_000_000;
        // A frame that has begun is sent to its end.
        assert!(took <= u64::from(milliseconds) + 100, "{took} {milliseconds}");
        assert_eq!(ask(&mut device, &points, PATIENCE), Ok(by_cpu(&points)));
    }
}
