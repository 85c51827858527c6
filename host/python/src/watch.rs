//! Watching a job from Python: signals such as Ctrl-C, and a function that hears of the progress.

use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use incircle::{Progress, Stage};
use pyo3::prelude::*;

/// The interpreter is asked at most once in this time, because another thread may hold it.
const PAUSE: Duration = Duration::from_millis(20);

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
