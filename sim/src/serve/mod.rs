//! Simulated devices for other programs: a board behind a pseudo-terminal, a device at a UDP port, and a board at a TAP
//! device.
//!
//! **Behind a pseudo-terminal** simulated time runs at most `1 / slow` times as fast as real time, which also spares the processor. When the line is
//! idle and the board is at rest (no session open, first rate set), passing time would change nothing, so simulated
//! time stops until a byte comes.

mod network;
mod on_network;
mod on_tap;
mod pace;
mod tap;
mod terminal;

use std::io;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::faults::{FaultSpec, Proxy};
use crate::serial::Board;

pub use network::{serve_network, NetworkError, NetworkFigures, NetworkService};
pub use on_tap::{serve_tap, TapError, TapFigures};
use pace::Pace;
pub use terminal::LinkError;
use terminal::Terminal;

/// Number of clocks that are simulated between two reads of the terminal: 32 microseconds of the board.
const SLICE: u64 = 4000;
/// Largest number of symbols that wait for the line to the board. More bytes wait in the terminal, as they would in
/// a computer's serial port.
const QUEUE: usize = 64;
/// Longest sleep. A signal to end may have to wait this long.
const NAP: Duration = Duration::from_millis(50);
/// Largest number of bytes that wait for a host that does not read. As in a real serial port, bytes
/// beyond that are lost.
const UNREAD: usize = 1 << 16;

/// The options of a service.
#[derive(Clone, Debug)]
pub struct Service {
    /// The symbolic link that leads to the terminal.
    pub link: PathBuf,
    /// Faults between the terminal and the board.
    pub faults: FaultSpec,
    /// Smallest ratio of real time to simulated time.
    pub slow: u32,
}

/// The figures of a service that has ended.
#[derive(Clone, Copy, Debug, Default)]
pub struct Figures {
    /// Number of bytes to the board.
    pub to_board: u64,
    /// Number of bytes to the host.
    pub to_host: u64,
    /// Number of faults on the line.
    pub faults: u64,
    /// Ratio of real time to simulated time while the board worked; `None` if it never did.
    pub slow_down: Option<f64>,
}

/// Serves the board until `stops` is set, and calls `ready` as soon as the link can be opened. The link is
/// removed at the end.
///
/// # Errors
/// The link exists and is in use, or the system refuses a terminal.
pub fn serve(
    board: &mut dyn Board,
    service: &Service,
    stops: &AtomicBool,
    ready: impl FnOnce(),
) -> Result<Figures, LinkError> {
    let mut server = Server {
        terminal: Terminal::new(&service.link)?,
        proxy: Proxy::new(&service.faults),
        pace: Pace::new(service.slow, board.link().clock_hz),
        board,
        unread: Vec::new(),
        figures: Figures::default(),
    };
    ready();
    while !stops.load(Ordering::Relaxed) {
        server.turn()?;
        if let Some(length) = server.proxy.take_unplug() {
            server.unplug(length, service, stops)?;
        }
    }
    let Server { figures, proxy, pace, .. } = server;
    Ok(Figures { faults: proxy.faults(), slow_down: pace.slow_down(), ..figures })
}

/// The state of a running service.
struct Server<'b> {
    board: &'b mut dyn Board,
    terminal: Terminal,
    proxy: Proxy,
    pace: Pace,
    /// Bytes that the terminal has not taken yet.
    unread: Vec<u8>,
    figures: Figures,
}

impl Server<'_> {
    /// Reads the terminal once, simulates one slice of clocks, and hands the answers to the terminal.
    fn turn(&mut self) -> io::Result<()> {
        let clock_hz = u64::from(self.board.link().clock_hz);
        let now = nanoseconds(self.board.clocks(), clock_hz);
        let mut buffer = [0; QUEUE];
        let is_free = self.board.waiting() < QUEUE && self.proxy.is_empty_to_device();
        let came = if is_free { self.terminal.read(&mut buffer)? } else { 0 };
        for &byte in &buffer[..came] {
            self.proxy.from_host(byte, now);
        }
        self.figures.to_board += came as u64;
        while self.board.waiting() < QUEUE {
            match self.proxy.next_to_device(now) {
                Some(symbol) => self.board.send(symbol),
                None => break,
            }
        }
        if self.board.is_at_rest() && self.proxy.is_empty() && self.unread.is_empty() {
            self.pace.rest();
            return self.terminal.wait(NAP);
        }
        self.board.set_rate(self.terminal.rate()?);
        self.pace.begin();
        self.board.run(SLICE);
        while let Some((clock, symbol)) = self.board.receive() {
            self.proxy.from_device(symbol, nanoseconds(clock, clock_hz));
        }
        let now = nanoseconds(self.board.clocks(), clock_hz);
        self.unread.extend(std::iter::from_fn(|| self.proxy.next_to_host(now)));
        self.hand_out()?;
        match self.pace.ahead(SLICE) {
            Some(ahead) if ahead >= Duration::from_millis(1) => self.terminal.wait(ahead.min(NAP)),
            _ => Ok(()),
        }
    }

    /// Writes bytes to the terminal. If no host has the port open, the bytes are lost.
    fn hand_out(&mut self) -> io::Result<()> {
        if self.unread.is_empty() {
            return Ok(());
        }
        let taken = self.terminal.write(&self.unread)?;
        self.figures.to_host += taken as u64;
        self.unread.drain(..taken);
        self.unread.truncate(UNREAD);
        Ok(())
    }

    /// Pulls the cable, which also cuts the board's power, and plugs it in again after `length`.
    fn unplug(&mut self, length: Duration, service: &Service, stops: &AtomicBool) -> Result<(), LinkError> {
        self.terminal.close();
        self.proxy.clear();
        self.unread.clear();
        self.board.power_cycle();
        let until = Instant::now() + length;
        while Instant::now() < until && !stops.load(Ordering::Relaxed) {
            std::thread::sleep(NAP.min(until.saturating_duration_since(Instant::now())));
        }
        self.pace.rest();
        self.terminal = Terminal::new(&service.link)?;
        Ok(())
    }
}

fn nanoseconds(clocks: u64, clock_hz: u64) -> u64 {
    (u128::from(clocks) * 1_000_000_000 / u128::from(clock_hz.max(1))) as u64
}
