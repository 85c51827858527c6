//! The progress bar of long jobs, on standard error and only on a terminal.

use std::cell::{Cell, OnceCell};
use std::io::{self, stderr, IsTerminal, Read, Seek, SeekFrom};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use incircle::{Progress, Stage};
use indicatif::{ProgressBar, ProgressStyle};

use crate::interrupt;

/// The bar appears after this time, so short jobs show none.
const PATIENCE: Duration = Duration::from_millis(500);

/// The listener of a job, which shows the progress and ends the job when the user interrupts.
pub struct Meter {
    shown: bool,
    since: Instant,
    bar: OnceCell<ProgressBar>,
    stage: Cell<Option<Stage>>,
}

impl Meter {
    /// Makes a meter. With `quiet`, or if standard error is no terminal, the meter shows nothing.
    pub fn new(quiet: bool) -> Self {
        Self { shown: is_shown(quiet), since: Instant::now(), bar: OnceCell::new(), stage: Cell::new(None) }
    }

    /// Takes a progress report of the job.
    pub fn hear(&self, progress: Progress) -> ControlFlow<()> {
        if interrupt::raised() {
            return ControlFlow::Break(());
        }
        if self.shown && self.since.elapsed() >= PATIENCE {
            let bar = self.bar.get_or_init(|| new_bar(progress.total as u64, OF_JOBS));
            if self.stage.replace(Some(progress.stage)) != Some(progress.stage) {
                // Each stage has a speed of its own, so the estimate of the time left begins anew.
                bar.reset();
                bar.set_message(verb(progress.stage));
                bar.set_prefix(if progress.stage == Stage::Read { "records" } else { "points" });
            }
            bar.set_length(progress.total as u64);
            bar.set_position(progress.done as u64);
        }
        ControlFlow::Continue(())
    }
}

impl Drop for Meter {
    fn drop(&mut self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}

/// The progress of work that is counted in one unit.
pub struct CountMeter {
    shown: bool,
    total: u64,
    what: [&'static str; 2],
    since: Instant,
    bar: OnceCell<ProgressBar>,
    done: Cell<u64>,
}

impl CountMeter {
    /// Makes a meter of `total` units, such as "regions", for work such as "joining". With `quiet`, or if standard
    /// error is no terminal, the meter shows nothing.
    pub fn new(total: u64, work: &'static str, units: &'static str, quiet: bool) -> Self {
        let (shown, what) = (is_shown(quiet), [work, units]);
        Self { shown, total, what, since: Instant::now(), bar: OnceCell::new(), done: Cell::new(0) }
    }

    /// Counts units that are done.
    pub fn advance(&self, units: u64) {
        self.done.set(self.done.get() + units);
        if self.shown && self.since.elapsed() >= PATIENCE {
            let bar = self.bar.get_or_init(|| {
                let bar = new_bar(self.total, OF_JOBS);
                bar.set_message(self.what[0]);
                bar.set_prefix(self.what[1]);
                bar
            });
            bar.set_position(self.done.get());
        }
    }
}

impl Drop for CountMeter {
    fn drop(&mut self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}

/// A reader that shows how much of a file has been read.
pub struct ReadMeter<R> {
    source: R,
    shown: bool,
    /// The number of bytes of the file; zero if that is unknown.
    total: u64,
    done: u64,
    since: Instant,
    bar: Option<ProgressBar>,
}

impl<R> ReadMeter<R> {
    /// Makes a meter of a source with `total` bytes, or zero if the number is unknown. With `quiet`, or if standard
    /// error is no terminal, the meter shows nothing.
    pub fn new(source: R, total: u64, quiet: bool) -> Self {
        Self { source, shown: is_shown(quiet), total, done: 0, since: Instant::now(), bar: None }
    }
}

impl<R: Read> Read for ReadMeter<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(into)?;
        self.done += count as u64;
        if self.shown && self.since.elapsed() >= PATIENCE {
            let (done, total) = (self.done, self.total);
            let template = if total > 0 { OF_FILES } else { OF_PIPES };
            let bar = self.bar.get_or_insert_with(|| new_bar(total, template));
            bar.set_position(done);
        }
        Ok(count)
    }
}

impl<R: Seek> Seek for ReadMeter<R> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        // The bar shows the place in the file, not the bytes read, because a part may be read twice.
        self.done = self.source.seek(to)?;
        Ok(self.done)
    }
}

impl<R> Drop for ReadMeter<R> {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// The form of the bar of a job.
const OF_JOBS: &str = "{msg:>10} {bar:40} {human_pos}/{human_len} {prefix}, {eta} left";
/// The form of the bar of a file.
const OF_FILES: &str = "   reading {bar:40} {bytes}/{total_bytes}, {eta} left";
/// The form of the bar of a pipe, whose length is unknown.
const OF_PIPES: &str = "   reading {bytes}, {bytes_per_sec}";

fn is_shown(quiet: bool) -> bool {
    !quiet && stderr().is_terminal()
}

fn new_bar(total: u64, template: &str) -> ProgressBar {
    let bar = ProgressBar::new(total);
    // The templates are fixed and valid. If one were not, the library's own style would do.
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar
}

fn verb(stage: Stage) -> &'static str {
    match stage {
        Stage::Order => "ordering",
        Stage::Insert => "inserting",
        Stage::Read => "reading",
        Stage::Assemble => "assembling",
        // Stages that the library adds later have only their names.
        other => other.name(),
    }
}
