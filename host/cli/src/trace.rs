//! The waveform that a run of the back end `sim` writes.

use std::path::Path;

/// A waveform to write.
#[cfg_attr(not(feature = "sim"), expect(dead_code, reason = "only the simulated core writes waveforms"))]
#[derive(Clone, Copy, Debug)]
pub struct Trace<'a> {
    /// File for the waveform.
    pub path: &'a Path,
    /// Number of the job that the waveform shows, from 1; without it the waveform shows all of them.
    pub job: Option<u64>,
}
