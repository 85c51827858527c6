//! A simulated board behind a pseudo-terminal, in a thread of this program.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{mpsc, Arc};
use std::thread::JoinHandle;

use incircle_protocol::Config;
use incircle_sim::serve::{serve, Figures, Service};

use super::Detail;

/// How many were made in this program: each has a path of its own.
static MADE: AtomicUsize = AtomicUsize::new(0);

/// The board, until it is dropped.
pub struct Served {
    path: PathBuf,
    slow: u32,
    stops: Arc<AtomicBool>,
    thread: Option<JoinHandle<Result<Figures, String>>>,
}

impl Served {
    /// A board with the core of this configuration and these faults, at least `slow` times slower than real.
    ///
    /// # Errors
    /// A sentence: the board was not translated, the faults do not exist, or there is no terminal.
    pub fn new(detail: Detail, config: Config, faults: &str, slow: u32) -> Result<Self, String> {
        let faults = faults.parse().map_err(|error| format!("{error}"))?;
        let name = format!("incircle-board-{}-{}", std::process::id(), MADE.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        let service = Service { link: path.clone(), faults, slow };
        let stops = Arc::new(AtomicBool::new(false));
        let raised = Arc::clone(&stops);
        let (tell, told) = mpsc::channel();
        let thread = std::thread::spawn(move || {
            let mut board = detail.board(config).map_err(|error| error.to_string())?;
            let ready = || {
                // Whoever waits is there until it is told.
                let _ = tell.send(());
            };
            serve(board.as_mut(), &service, &raised, ready).map_err(|error| error.to_string())
        });
        let mut served = Self { path, slow, stops, thread: Some(thread) };
        match told.recv() {
            Ok(()) => Ok(served),
            // The thread ended without a word, so with an error.
            Err(_) => Err(served.stop().err().unwrap_or_default()),
        }
    }

    /// The link to the terminal.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What the library and the command open, at this rate.
    pub fn address(&self, rate: u32) -> String {
        format!("serial:{}?baud={rate}&slow={}", self.path.display(), self.slow)
    }

    /// Ends the board, and says what it did.
    ///
    /// # Errors
    /// The sentence of its error.
    pub fn stop(&mut self) -> Result<Figures, String> {
        self.stops.store(true, Ordering::Relaxed);
        let ended = self.thread.take().map(JoinHandle::join);
        ended
            .unwrap_or_else(|| Ok(Err("it was stopped before".to_owned())))
            .unwrap_or_else(|_| Err("it panicked".to_owned()))
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        // Nobody asks any more.
        let _ = self.stop();
    }
}
