//! The serial transport over pseudo-terminals, in real time: a job, a port that another program has, a port that goes
//! away, and a port where nobody reads.

use std::io::{Read, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crate::common::board::{self, Board};
use crate::common::Random;
use incircle::serial::{greet, Address, PortFault, SerialFault, SerialTransport};
use incircle::{Device, Error, ErrorKind, Options, Point};
use serialport::{SerialPort, TTYPort};

/// Time for an action that takes well under a second, on a machine where other programs run as well.
const BUSY_MACHINE: Duration = Duration::from_secs(3);

/// A board behind a pseudo-terminal.
struct Virtual {
    port: String,
    board: Arc<Mutex<Board>>,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
    /// The other end, held open so that the master's end works between two hosts.
    _slave: TTYPort,
}

impl Virtual {
    fn new() -> Self {
        let (mut master, slave) = TTYPort::pair().expect("a pseudo-terminal");
        let port = slave.name().expect("it has a name");
        let board = Arc::new(Mutex::new(Board::new(4096)));
        let stop = Arc::new(AtomicBool::new(false));
        let (shared, stopped) = (board.clone(), stop.clone());
        let thread = std::thread::spawn(move || {
            let since = Instant::now();
            master.set_timeout(Duration::from_millis(1)).expect("a timeout");
            let mut bytes = [0; 4096];
            while !stopped.load(Ordering::SeqCst) {
                let read = master.read(&mut bytes).unwrap_or(0);
                let mut board = shared.lock().expect("no panic");
                board.take(&bytes[..read], since.elapsed());
                board.tick(since.elapsed());
                while let Some(frame) = board.say() {
                    let _ = master.write_all(&frame);
                    board.said();
                }
            }
        });
        Self { port, board, stop, thread: Some(thread), _slave: slave }
    }

    fn address(&self) -> String {
        format!("serial:{}?baud=3000000", self.port)
    }

    /// Closes the master's end, as if the cable were pulled.
    fn unplug(&mut self) {
        self.stop.store(true, Ordering::SeqCst);
        if let Some(thread) = self.thread.take() {
            thread.join().expect("no panic");
        }
    }
}

impl Drop for Virtual {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::SeqCst);
    }
}

fn points(count: usize) -> Vec<Point> {
    Random(9).points(count, 1 << 16)
}

/// The fault that the link has found, if this is an error of the link.
fn link_fault(error: &Error) -> Option<&SerialFault> {
    match error {
        Error::Link { source, .. } => source.fault(),
        _ => None,
    }
}

fn refusal(port: &str) -> PortFault {
    match Device::open(&format!("serial:{port}")).err() {
        Some(error) => {
            assert_eq!(error.kind(), ErrorKind::DeviceNotFound);
            assert!(error.to_string().contains(port), "{error}");
            match error {
                Error::Open { source, .. } => *source.downcast().expect("a fault of the port"),
                other => panic!("{other:?}"),
            }
        }
        None => panic!("{port} is open"),
    }
}

#[test]
fn a_job_and_a_goodbye() {
    let host = Virtual::new();
    let points = points(3000);
    let expected = incircle::triangulate(&points).expect("the model");
    for _ in 0..2 {
        let mut device = Device::open(&host.address()).expect("a port");
        let mut session = device.session().expect("a board");
        let solution = session.triangulate(&points).expect("a mesh");
        assert_eq!(solution.mesh.triangles, expected.triangles);
        assert_eq!(solution.report.backend, format!("serial:{}", host.port));
        assert!(host.board.lock().expect("no panic").rate > 2_900_000);
        drop(device);
        let board = host.board.lock().expect("no panic");
        assert_eq!((board.rate, board.session), (115_200, 0));
    }
}

#[test]
fn a_greeting_opens_nothing() {
    let host = Virtual::new();
    let greeting = greet(&Address::of_port(&*host.port), Duration::from_secs(4)).expect("a board");
    assert_eq!((greeting.clock_hz, greeting.identity.capacity), (board::CLOCK, board::CAPACITY));
    assert_eq!(host.board.lock().expect("no panic").session, 0);
}

/// A caller may choose to wait for ever.
#[test]
fn a_timeout_may_be_longer_than_any_clock_runs() {
    let host = Virtual::new();
    let address = Address::of_port(&*host.port);
    greet(&address, Duration::MAX).expect("a board");
    let mut transport = SerialTransport::open(&address).expect("a port");
    transport.connect(Duration::MAX).expect("a board");
}

#[test]
fn only_one_program_has_a_port() {
    let host = Virtual::new();
    let first = Device::open(&host.address()).expect("a port");
    assert!(matches!(refusal(&host.port), PortFault::Busy));
    // The refused attempt has left the port to the first program.
    assert!(matches!(refusal(&host.port), PortFault::Busy));
    drop(first);
    drop(Device::open(&host.address()).expect("a port"));
}

#[test]
fn a_port_that_goes_ends_the_job() {
    let mut host = Virtual::new();
    let mut device = Device::open(&host.address()).expect("a port");
    device.session().expect("a board");
    host.unplug();
    let since = Instant::now();
    let error = device.session().map(|_| ()).expect_err("no board");
    assert!(since.elapsed() < BUSY_MACHINE);
    assert_eq!(error.kind(), ErrorKind::Link);
    let fault = link_fault(&error);
    assert!(matches!(fault, Some(SerialFault::Unplugged { .. })), "{error}");
    drop(device);
    assert!(since.elapsed() < BUSY_MACHINE);
}

#[test]
fn nobody_reads_and_nobody_answers() {
    let (master, slave) = TTYPort::pair().expect("a pseudo-terminal");
    let address = Address::of_port(slave.name().expect("it has a name"));
    let since = Instant::now();
    let mut transport = SerialTransport::open(&address).expect("a port");
    let error = transport.connect(Duration::from_secs(12)).expect_err("nobody");
    assert_eq!(link_fault(&error), Some(&SerialFault::Silent), "{error}");
    assert!(since.elapsed() < Duration::from_secs(3) + BUSY_MACHINE);
    drop((transport, master));
}

/// After a session has worked, the other end stops reading. Writes must not block.
#[test]
fn deadlines_hold_when_nobody_reads() {
    let host = Virtual::new();
    let mut device = Device::open(&host.address()).expect("a port");
    let mut session = device.session().expect("a board");
    // Holding the lock of the board stops its thread.
    let board = host.board.lock().expect("no panic");
    let since = Instant::now();
    let options = Options::default().timeout(Duration::from_millis(700));
    let error = session.triangulate_with(&points(8000), &options).expect_err("nobody reads");
    assert_eq!(error.kind(), ErrorKind::Timeout, "{error}");
    assert!(since.elapsed() < BUSY_MACHINE, "{:?}", since.elapsed());
    drop(device);
    assert!(since.elapsed() < 2 * BUSY_MACHINE, "{:?}", since.elapsed());
    drop(board);
}

#[test]
fn what_is_no_port_is_told() {
    assert!(matches!(refusal("/dev/null"), PortFault::NoTerminal));
    assert!(matches!(refusal(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml")), PortFault::NoTerminal));
    assert!(matches!(refusal("/nowhere/ttyUSB0"), PortFault::Missing { .. }));
}
