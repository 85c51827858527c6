//! A simulated board behind a pseudo-terminal, for any program that opens serial ports.
//!
//! Simulated time runs at most one `slow`-th as fast as real time, which also spares the processor. When nothing is on the line and the board is at rest, no
//! session open and the first rate set, time would change nothing: it stands still until a byte comes.

mod pace;
mod terminal;

use std::io;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::faults::{FaultSpec, Proxy};
use crate::serial::Board;

use pace::Pace;
pub use terminal::LinkError;
use terminal::Terminal;

/// Clocks between two looks at the terminal: 32 microseconds of the board.
const SLICE: u64 = 4000;
/// Symbols that wait for the line to the board; the rest waits in the terminal, as in a computer's.
const QUEUE: usize = 64;
/// Longest sleep: so long may a signal wait.
const NAP: Duration = Duration::from_millis(50);
/// Bytes that wait for a host that does not read; a serial port loses what is too much.
const UNREAD: usize = 1 << 16;

/// What is served.
#[derive(Clone, Debug)]
pub struct Service {
    /// The symbolic link that leads to the terminal.
    pub link: PathBuf,
    /// Faults between the terminal and the board.
    pub faults: FaultSpec,
    /// Real time over simulated time, at least.
    pub slow: u32,
}

/// What a service did.
#[derive(Clone, Copy, Debug, Default)]
pub struct Figures {
    /// Bytes to the board.
    pub to_board: u64,
    /// Bytes to the host.
    pub to_host: u64,
    /// Faults of the line.
    pub faults: u64,
    /// Real time over simulated time while the board worked; none if it never did.
    pub slow_down: Option<f64>,
}

/// Serves the board until `stops` is set; calls `ready` once the link can be opened. The link is removed at the end.
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

/// A service under way.
struct Server<'b> {
    board: &'b mut dyn Board,
    terminal: Terminal,
    proxy: Proxy,
    pace: Pace,
    /// Bytes that the terminal did not take.
    unread: Vec<u8>,
    figures: Figures,
}

impl Server<'_> {
    /// One look at the terminal, and a slice of the board's time.
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

    /// Bytes to whoever has the terminal open; nobody hears what is said to a closed port.
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

    /// The cable is pulled, with the board's power, and plugged in again.
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
