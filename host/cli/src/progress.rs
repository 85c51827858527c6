//! The progress bar of long jobs, on standard error and only on a terminal.

use std::cell::{Cell, OnceCell};
use std::io::{stderr, IsTerminal};
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
        Self {
            shown: !quiet && stderr().is_terminal(),
            since: Instant::now(),
            bar: OnceCell::new(),
            stage: Cell::new(None),
        }
    }

    /// Takes a progress report of the job.
    pub fn hear(&self, progress: Progress) -> ControlFlow<()> {
        if interrupt::raised() {
            return ControlFlow::Break(());
        }
        if self.shown && self.since.elapsed() >= PATIENCE {
            let bar = self.bar.get_or_init(|| new_bar(progress.total));
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

fn new_bar(total: usize) -> ProgressBar {
    let bar = ProgressBar::new(total as u64);
    // The template is fixed and valid. If it were not, the library's own style would do.
    if let Ok(style) = ProgressStyle::with_template("{msg:>10} {bar:40} {human_pos}/{human_len} {prefix}, {eta} left") {
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
