//! What bounds a job: time, points, bits of a coordinate.

use std::time::{Duration, Instant};

use incircle_protocol::{MAX_COORD_BITS, MIN_COORD_BITS};

use crate::error::Error;

/// Coordinate bits must be possible.
pub(crate) fn check_coord_bits(coord_bits: u32) -> Result<(), Error> {
    if (MIN_COORD_BITS..=MAX_COORD_BITS).contains(&coord_bits) {
        Ok(())
    } else {
        Err(Error::CoordBits(coord_bits))
    }
}

/// Until when a job may run, and how long that was at its start.
#[derive(Clone, Copy)]
pub(crate) struct Limit {
    deadline: Instant,
    timeout: Duration,
}

impl Limit {
    /// From now on for `timeout`, or for a year if that is longer: no clock overflows.
    pub(crate) fn of(timeout: Duration) -> Self {
        const YEAR: Duration = Duration::from_secs(365 * 24 * 3600);
        let timeout = timeout.min(YEAR);
        Self { deadline: Instant::now() + timeout, timeout }
    }

    /// Until when.
    pub(crate) fn deadline(self) -> Instant {
        self.deadline
    }

    /// How long that was at the start.
    pub(crate) fn timeout(self) -> Duration {
        self.timeout
    }

    /// For so much longer.
    pub(crate) fn longer(self, time: Duration) -> Self {
        let more = Self::of(time).timeout;
        Self { deadline: self.deadline + more, timeout: self.timeout + more }
    }

    /// An error once the deadline has passed.
    pub(crate) fn check(&self, device: &str, during: &'static str) -> Result<(), Error> {
        if Instant::now() <= self.deadline {
            return Ok(());
        }
        Err(Error::Timeout { device: device.to_owned(), during, timeout: self.timeout })
    }
}
