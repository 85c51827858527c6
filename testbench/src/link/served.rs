//! A simulated board behind a pseudo-terminal, in a thread of this program.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{mpsc, Arc};
use std::thread::JoinHandle;

use incircle_protocol::Config;
use incircle_sim::serve::{serve, Figures, Service};

use super::Detail;

/// Number of boards made in this program, so that each has a path of its own.
static MADE: AtomicUsize = AtomicUsize::new(0);

/// A board that is served until it is dropped.
pub struct Served {
    path: PathBuf,
    slow: u32,
    stops: Arc<AtomicBool>,
    thread: Option<JoinHandle<Result<Figures, String>>>,
}

impl Served {
    /// Serves a board with the core of this configuration and these faults, at least `slow`
    /// times slower than a real one.
    ///
    /// # Errors
    /// A sentence: the board is not part of this build, the faults do not exist, or there is no terminal.
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
                // The receiver waits until it gets this message, so the send cannot fail.
                let _ = tell.send(());
            };
            serve(board.as_mut(), &service, &raised, ready).map_err(|error| error.to_string())
        });
        let mut served = Self { path, slow, stops, thread: Some(thread) };
        match told.recv() {
            Ok(()) => Ok(served),
            // The thread ended without a message, and so with an error.
            Err(_) => Err(served.stop().err().unwrap_or_default()),
        }
    }

    /// Path of the terminal.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Address for the library and the command, with this rate.
    pub fn address(&self, rate: u32) -> String {
        format!("serial:{}?baud={rate}&slow={}", self.path.display(), self.slow)
    }

    /// Ends the board, and returns the figures of its run.
    ///
    /// # Errors
    /// The sentence of the board's error.
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
        // Nobody asks for an error of the board any more.
        let _ = self.stop();
    }
}
