//! Watching work from Python: signals such as Ctrl-C, and a function that hears of the progress of a job.

use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use incircle::{living, Progress, Stage};
use pyo3::prelude::*;

use crate::error::of_living;

/// The interpreter is asked at most once in this time, because another thread may hold it.
const PAUSE: Duration = Duration::from_millis(20);
/// Changes or questions between two looks for signals.
const LOOK: usize = 65_536;

/// Asks the interpreter for signals while a job runs, and passes its progress on.
pub struct Watch {
    listener: Option<Py<PyAny>>,
    /// The stage and the time of the last look.
    last: Cell<Option<(Stage, Instant)>>,
    raised: RefCell<Option<PyErr>>,
}

impl Watch {
    pub fn new(listener: Option<Py<PyAny>>) -> Self {
        Self { listener, last: Cell::new(None), raised: RefCell::new(None) }
    }

    /// The exception that ended the job, if one did.
    pub fn into_raised(self) -> Option<PyErr> {
        self.raised.into_inner()
    }

    /// Looks for signals, and tells the listener. Ends the job if a signal or the listener raises an exception, or if
    /// the listener returns `False`.
    pub fn hear(&self, progress: Progress) -> ControlFlow<()> {
        let is_due = self.last.get().is_none_or(|(stage, time)| stage != progress.stage || time.elapsed() >= PAUSE);
        if !is_due && progress.done != progress.total {
            return ControlFlow::Continue(());
        }
        let goes_on = Python::attach(|py| {
            py.check_signals()?;
            self.listener.as_ref().map_or(Ok(true), |listener| tell(listener.bind(py), progress))
        });
        self.last.set(Some((progress.stage, Instant::now())));
        match goes_on {
            Ok(true) => ControlFlow::Continue(()),
            Ok(false) => ControlFlow::Break(()),
            Err(error) => {
                self.raised.replace(Some(error));
                ControlFlow::Break(())
            }
        }
    }
}

/// Calls the listener; whether the job goes on.
fn tell(listener: &Bound<'_, PyAny>, Progress { stage, done, total }: Progress) -> PyResult<bool> {
    let answer = listener.call1((stage.name(), done, total))?;
    Ok(!answer.is(&*pyo3::types::PyBool::new(listener.py(), false)))
}

/// Looks for signals while work of many steps goes on.
pub struct Signals(Cell<Instant>);

impl Signals {
    pub fn new() -> Self {
        Self(Cell::new(Instant::now()))
    }

    /// The exception of a signal, if one has come. The interpreter is asked if the last look was some time ago.
    pub fn look(&self) -> PyResult<()> {
        if self.0.get().elapsed() < PAUSE {
            return Ok(());
        }
        let signals = Python::attach(|py| py.check_signals());
        self.0.set(Instant::now());
        signals
    }
}

/// Does the work for each item, and looks for signals from time to time. What was done stays done if one comes, or if
/// an item is refused. Other threads of Python go on meanwhile.
pub fn each<I: Sync, T: Send>(
    py: Python<'_>,
    items: &[I],
    mut work: impl FnMut(&I) -> Result<T, living::Error> + Send,
) -> PyResult<Vec<T>> {
    let mut done = Vec::with_capacity(items.len());
    for some in items.chunks(LOOK) {
        let worked = py.detach(|| some.iter().try_for_each(|item| work(item).map(|made| done.push(made))));
        worked.map_err(|error| of_living(py, error))?;
        py.check_signals()?;
    }
    Ok(done)
}
