//! Interrupts: a run that is stopped leaves no file and ends with exit code 130.
//!
//! The handler raises a flag, which jobs and outputs look at, and gives the run a moment to end by itself; then it removes
//! the unfinished outputs and ends the process.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::failure::{Exit, Failure};

static RAISED: AtomicBool = AtomicBool::new(false);
/// The unfinished outputs of the run, to be removed if it is stopped.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());
/// Time for the run to end by itself: a chunk of a simulated job takes less.
const GRACE: Duration = Duration::from_millis(1500);

/// Watches for interrupts and for requests to terminate.
pub fn watch() -> Result<(), Failure> {
    let handler = || {
        RAISED.store(true, Ordering::SeqCst);
        std::thread::sleep(GRACE);
        // Kept locked to the end: no output can be finished any more.
        let unfinished = unfinished();
        for path in unfinished.iter() {
            let _ = std::fs::remove_file(path);
        }
        std::process::exit(Exit::Interrupted as i32);
    };
    match ctrlc::set_handler(handler) {
        // Set by an earlier run in this process.
        Ok(()) | Err(ctrlc::Error::MultipleHandlers) => Ok(()),
        Err(error) => Err(Failure::new(Exit::Device, format!("interrupts cannot be watched: {error}"))),
    }
}

/// Whether the run was interrupted.
pub fn raised() -> bool {
    RAISED.load(Ordering::SeqCst)
}

/// Ends an interrupted run.
pub fn check() -> Result<(), Failure> {
    if raised() {
        return Err(Failure::new(Exit::Interrupted, "interrupted: nothing was written"));
    }
    Ok(())
}

/// The unfinished outputs, locked: while the lock is held no interrupt ends the process.
pub fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}
