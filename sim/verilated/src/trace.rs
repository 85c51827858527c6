//! Waveforms of a model, in VCD files.
#![allow(unsafe_code)] // Calls into the C++ instance.

use std::ffi::CString;
use std::path::{Path, PathBuf};

use crate::model::Model;

/// The reason why no waveform can be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TraceError {
    /// The model was built without tracing.
    #[error("model {model} was built without tracing: build it with `trace(true)`")]
    NotBuilt {
        /// Name of the model.
        model: &'static str,
    },
    /// The file cannot be created.
    #[error(
        "cannot write the waveform {path}: check that its folder exists and can be written",
        path = .path.display()
    )]
    File {
        /// Path of the file.
        path: PathBuf,
    },
    /// Part of the waveform could not be written, usually because the disk is full.
    #[error("the waveform could not be written to its end: make room on the disk, or run a smaller job")]
    Lost,
}

impl Model {
    /// Writes a VCD waveform of all signals from now on, into a new file. A trace that was open ends.
    ///
    /// # Errors
    /// The model was built without tracing, or the file cannot be created.
    pub fn trace_to(&mut self, path: impl AsRef<Path>) -> Result<(), TraceError> {
        let path = path.as_ref();
        let open = self.description().trace_open.ok_or(TraceError::NotBuilt { model: self.description().name() })?;
        let failed = || TraceError::File { path: path.to_path_buf() };
        let name = CString::new(path.as_os_str().as_encoded_bytes()).map_err(|_| failed())?;
        // SAFETY: a live instance and a zero-terminated name that outlives the call.
        self.tracing = unsafe { open(self.handle(), name.as_ptr()) } != 0;
        if !self.tracing {
            return Err(failed());
        }
        self.dump_at(self.time());
        Ok(())
    }

    /// Whether a waveform is being written.
    pub fn is_tracing(&self) -> bool {
        self.tracing
    }

    /// Flushes the waveform so far into the file. Dropping the model does the same.
    ///
    /// # Errors
    /// Part of the waveform since the trace began could not be written, so the file cannot be trusted.
    pub fn trace_flush(&mut self) -> Result<(), TraceError> {
        if let (true, Some(flush)) = (self.tracing, self.description().trace_flush) {
            // SAFETY: a live instance whose trace is open.
            if unsafe { flush(self.handle()) } == 0 {
                return Err(TraceError::Lost);
            }
        }
        Ok(())
    }

    /// Ends the waveform, if one is open.
    pub fn trace_close(&mut self) {
        if let (true, Some(close)) = (self.tracing, self.description().trace_close) {
            // SAFETY: a live instance whose trace is open.
            unsafe { close(self.handle()) }
        }
        self.tracing = false;
    }
}
