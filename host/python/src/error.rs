//! Errors of the library as exceptions of Python.

use incircle::{living, Error, ErrorKind};
use pyo3::prelude::*;

/// The exception `name` of the module `incircle._errors`, with a sentence. If the module has no such exception, the
/// error says so.
pub fn exception(py: Python<'_>, name: &str, sentence: &str) -> PyErr {
    let made = py.import("incircle._errors").and_then(|module| module.getattr(name)).and_then(|class| {
        let value = class.call1((sentence,))?;
        Ok(PyErr::from_value(value))
    });
    made.unwrap_or_else(|error| error)
}

/// The exception for input that cannot be used as it is.
pub fn bad_input(py: Python<'_>, sentence: &str) -> PyErr {
    exception(py, "InputError", sentence)
}

/// The exception for an error of a job.
pub fn of_job(py: Python<'_>, error: &Error) -> PyErr {
    let name = match error.kind() {
        ErrorKind::BadInput => "InputError",
        ErrorKind::BadChoice => "ChoiceError",
        ErrorKind::DeviceNotFound => "DeviceNotFoundError",
        ErrorKind::Link => "LinkError",
        ErrorKind::Device => "DeviceError",
        ErrorKind::Timeout => "DeviceTimeoutError",
        ErrorKind::Capacity => "CapacityError",
        ErrorKind::Cancelled => "Cancelled",
        _ => "Error",
    };
    exception(py, name, &error.to_string())
}

/// The exception for an error of a mesh that lives.
pub fn of_living(py: Python<'_>, error: living::Error) -> PyErr {
    let name = match error {
        living::Error::Deleted { .. } | living::Error::Unknown { .. } => "UnknownPointError",
        living::Error::TooManyPoints | living::Error::IndicesUsedUp => "CapacityError",
        _ => "InputError",
    };
    exception(py, name, &error.to_string())
}
