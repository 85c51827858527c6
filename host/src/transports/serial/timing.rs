//! Timing of the line: when bytes are off it, and how long the host waits.

use std::time::Duration;

use crate::transports::round_trip::TripBounds;

/// Bits of a byte on the line, with start and stop bit.
const BITS: u64 = 10;
/// The times that the host waits. A USB adapter with its default latency takes 16 ms.
pub(super) const TRIP_BOUNDS: TripBounds = TripBounds {
    first_trip: Duration::from_millis(30),
    least_slack: Duration::from_millis(4),
    poll_every: Duration::from_millis(500),
};

/// The line to the device: the time that its bytes take.
#[derive(Debug)]
pub(super) struct Line {
    rate: u32,
    /// Time at which all bytes handed out are off the line.
    free_at: Duration,
}

impl Line {
    pub fn new(rate: u32) -> Self {
        Self { rate, free_at: Duration::ZERO }
    }

    pub fn rate(&self) -> u32 {
        self.rate
    }

    /// Changes the rate. Bytes under way count as sent.
    pub fn set_rate(&mut self, rate: u32, now: Duration) {
        *self = Self { rate, free_at: now };
    }

    /// Time that this many bytes take.
    pub fn time_of(&self, bytes: usize) -> Duration {
        let bits = (bytes as u64).saturating_mul(BITS);
        Duration::from_nanos(bits.saturating_mul(1_000_000_000) / u64::from(self.rate.max(1)))
    }

    /// Counts bytes that are handed out, and returns the time at which they are off the line.
    pub fn carry(&mut self, bytes: usize, now: Duration) -> Duration {
        self.free_at = self.free_at.max(now) + self.time_of(bytes);
        self.free_at
    }

    /// Time at which all bytes are off the line.
    pub fn free_at(&self) -> Duration {
        self.free_at
    }

    /// Time from now on for which the line is busy.
    pub fn ahead(&self, now: Duration) -> Duration {
        self.free_at.saturating_sub(now)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);

    #[test]
    fn bytes_take_ten_bits() {
        let mut line = Line::new(1_000_000);
        assert_eq!(line.carry(100, MS), 2 * MS);
        assert_eq!(line.carry(100, MS), 3 * MS);
        assert_eq!(line.ahead(MS), 2 * MS);
        assert_eq!(line.carry(100, 9 * MS), 10 * MS);
        line.set_rate(2_000_000, 9 * MS);
        assert_eq!((line.ahead(9 * MS), line.time_of(200)), (Duration::ZERO, MS));
    }
}
