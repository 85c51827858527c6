//! Interrupts: an interrupted run leaves no file and ends with exit code 130 and a sentence.
//!
//! The handler ends the process at once, except while a job runs. A job is first asked to end by itself, which tidies
//! up the device, and gets a moment for that. A second interrupt does not wait for the moment to pass.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::failure::{Exit, Failure};

static RAISED: AtomicBool = AtomicBool::new(false);
/// Whether a job runs that checks [`raised`].
static WORKING: AtomicBool = AtomicBool::new(false);
/// Whether the run is complete. Changed only under the lock of [`UNFINISHED`].
static DONE: AtomicBool = AtomicBool::new(false);
/// Whether the reason for the end of the run has been printed.
static TOLD: Mutex<bool> = Mutex::new(false);
/// The unfinished outputs of the run, which an interrupt removes.
static UNFINISHED: Mutex<Unfinished> = Mutex::new(Unfinished::none());
/// Older files, each under its second name and the name at which an output took its place. An interrupt puts them back.
static REPLACED: Mutex<Vec<[PathBuf; 2]>> = Mutex::new(Vec::new());
/// The sentence that says how the run can go on after an interrupt; empty if it cannot.
static REMEDY: Mutex<String> = Mutex::new(String::new());
/// Time for a job to end by itself. A slice of a simulated job takes less.
const GRACE: Duration = Duration::from_millis(1500);

/// Begins to watch for interrupts and for requests to terminate.
pub fn watch() -> Result<(), Failure> {
    DONE.store(false, Ordering::SeqCst);
    match ctrlc::set_handler(on_signal) {
        // An earlier run in this process has set the handler already.
        Ok(()) | Err(ctrlc::Error::MultipleHandlers) => Ok(()),
        Err(error) => Err(Failure::new(Exit::Device, format!("interrupts cannot be watched: {error}"))),
    }
}

/// Handles a signal. The function must return while a job has its moment, or the next signal would wait as well.
fn on_signal() {
    let again = RAISED.swap(true, Ordering::SeqCst);
    if again || !WORKING.load(Ordering::SeqCst) {
        return stop();
    }
    let patient = std::thread::Builder::new().spawn(|| {
        std::thread::sleep(GRACE);
        stop();
    });
    if patient.is_err() {
        stop();
    }
}

/// Ends the process, unless the run is complete already.
fn stop() {
    // The lock is held to the end, so that no output can be finished any more.
    let unfinished = unfinished();
    if DONE.load(Ordering::SeqCst) {
        return;
    }
    // The last one comes first: a folder is made before the files in it. A folder that is not empty stays.
    for path in unfinished.names.values().rev() {
        let _ = std::fs::remove_file(path).or_else(|_| std::fs::remove_dir(path));
    }
    for [older, path] in replaced().iter() {
        let _ = std::fs::rename(older, path);
    }
    tell(&interrupted());
    std::process::exit(Exit::Interrupted as i32);
}

/// Prints why the run ends. Only the first call prints.
pub fn tell(failure: &Failure) {
    let mut told = TOLD.lock().unwrap_or_else(PoisonError::into_inner);
    if !std::mem::replace(&mut *told, true) {
        // Nobody can be told that standard error is closed.
        let _ = writeln!(std::io::stderr(), "incircle: {failure}");
    }
}

fn interrupted() -> Failure {
    let remedy = REMEDY.lock().unwrap_or_else(PoisonError::into_inner);
    let message = if remedy.is_empty() { "interrupted: no file was written" } else { remedy.as_str() };
    Failure::new(Exit::Interrupted, message)
}

/// Sets the sentence of an interrupted run that can go on later.
pub fn set_remedy(sentence: String) {
    *REMEDY.lock().unwrap_or_else(PoisonError::into_inner) = sentence;
}

/// Whether the run was interrupted.
pub fn raised() -> bool {
    RAISED.load(Ordering::SeqCst)
}

/// Returns the failure of an interrupted run.
pub fn check() -> Result<(), Failure> {
    if raised() {
        return Err(interrupted());
    }
    Ok(())
}

/// Marks the run as complete, unless it was interrupted before. A later interrupt has no effect.
pub fn done() -> Result<(), Failure> {
    let _unfinished = unfinished();
    if !DONE.load(Ordering::SeqCst) {
        check()?;
        DONE.store(true, Ordering::SeqCst);
    }
    Ok(())
}

/// Calls `work`, which must check [`raised`] and end by itself if it is true.
pub fn working<T>(work: impl FnOnce() -> T) -> T {
    WORKING.store(true, Ordering::SeqCst);
    let result = work();
    WORKING.store(false, Ordering::SeqCst);
    result
}

/// The older files, each under its second name and its first, locked. Lock the unfinished outputs before.
pub fn replaced() -> MutexGuard<'static, Vec<[PathBuf; 2]>> {
    REPLACED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The unfinished files and folders of a run, in the order in which they were made. All calls take logarithmic time,
/// because a set may have any number of tiles.
pub struct Unfinished {
    /// The name with each number; later ones have larger numbers.
    names: BTreeMap<u64, PathBuf>,
    /// The number of each name.
    numbers: BTreeMap<PathBuf, u64>,
}

impl Unfinished {
    const fn none() -> Self {
        Self { names: BTreeMap::new(), numbers: BTreeMap::new() }
    }

    /// Adds a file or folder that was just made.
    pub fn push(&mut self, path: PathBuf) {
        let number = self.names.last_key_value().map_or(0, |(last, _)| last + 1);
        self.put(number, path);
    }

    /// Takes a file or folder out, if it is there.
    pub fn remove(&mut self, path: &Path) {
        self.names.remove(&self.numbers.remove(path).unwrap_or(u64::MAX));
    }

    /// Gives a file that is there its new name.
    pub fn rename(&mut self, from: &Path, to: PathBuf) {
        if let Some(number) = self.numbers.remove(from) {
            self.put(number, to);
        }
    }

    /// Puts a name at a number. A name that was there before has one number only.
    fn put(&mut self, number: u64, path: PathBuf) {
        if let Some(earlier) = self.numbers.insert(path.clone(), number) {
            self.names.remove(&earlier);
        }
        self.names.insert(number, path);
    }
}

/// The unfinished outputs, locked. While the lock is held no interrupt ends the process.
pub fn unfinished() -> MutexGuard<'static, Unfinished> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unfinished_files_keep_their_order_and_may_change_their_names() {
        let mut unfinished = Unfinished::none();
        for name in ["folder", "a", "b", "c", "a"] {
            unfinished.push(name.into());
        }
        unfinished.rename(Path::new("b"), "d".into());
        unfinished.rename(Path::new("missing"), "e".into());
        unfinished.remove(Path::new("c"));
        unfinished.remove(Path::new("b"));
        let names = |unfinished: &Unfinished| unfinished.names.values().cloned().collect::<Vec<_>>();
        assert_eq!(names(&unfinished), ["folder", "d", "a"].map(PathBuf::from));
        for name in ["folder", "d", "a"] {
            unfinished.remove(Path::new(name));
        }
        assert!(unfinished.names.is_empty() && unfinished.numbers.is_empty());
    }
}
