//! Limits of a job: its deadline, and the bits of a coordinate.

use std::time::{Duration, Instant};

use incircle_protocol::{MAX_COORD_BITS, MIN_COORD_BITS};

use crate::error::Error;

/// Refuses a number of coordinate bits outside 1 to 31.
pub(crate) fn check_coord_bits(coord_bits: u32) -> Result<(), Error> {
    if (MIN_COORD_BITS..=MAX_COORD_BITS).contains(&coord_bits) {
        Ok(())
    } else {
        Err(Error::CoordBits(coord_bits))
    }
}

/// The deadline of a job, with the time that it was given for messages.
#[derive(Clone, Copy)]
pub(crate) struct Limit {
    deadline: Instant,
    timeout: Duration,
    /// Time for jobs that were sent ahead, which the deadline includes.
    ahead: Duration,
}

impl Limit {
    /// A limit that ends `timeout` from now, or in a year if that is sooner: a longer one might overflow the clock.
    pub(crate) fn of(timeout: Duration) -> Self {
        const YEAR: Duration = Duration::from_secs(365 * 24 * 3600);
        let timeout = timeout.min(YEAR);
        Self { deadline: Instant::now() + timeout, timeout, ahead: Duration::ZERO }
    }

    pub(crate) fn deadline(self) -> Instant {
        self.deadline
    }

    /// The time from now to the deadline.
    pub(crate) fn time_left(self) -> Duration {
        self.deadline.saturating_duration_since(Instant::now())
    }

    /// The error of a device that did not finish `during` by the deadline.
    pub(crate) fn missed(self, device: String, during: &'static str) -> Error {
        Error::Timeout { device, during, timeout: self.timeout, ahead: self.ahead }
    }

    /// The same limit, later by the time of a job that was sent ahead.
    pub(crate) fn longer(self, time: Duration) -> Self {
        let more = Self::of(time).timeout;
        Self { deadline: self.deadline + more, ahead: self.ahead + more, ..self }
    }

    /// Fails with [`Error::Timeout`] once the deadline has passed.
    pub(crate) fn check(&self, device: &str, during: &'static str) -> Result<(), Error> {
        if Instant::now() <= self.deadline {
            return Ok(());
        }
        Err(self.missed(device.to_owned(), during))
    }
}
