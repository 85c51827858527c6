//! Timing of the line: when bytes are off it, and how long to wait for an answer.

use std::time::Duration;

/// Bits of a byte on the line, with start and stop bit.
const BITS: u64 = 10;
/// Round trip that is assumed before one is measured: a USB adapter with its default latency takes 16 ms.
const FIRST_TRIP: Duration = Duration::from_millis(30);
/// Least time beyond the mean round trip before the host polls.
const LEAST_SLACK: Duration = Duration::from_millis(4);
/// Longest time between two polls, well below the silence after which a device forgets the session.
pub(super) const POLL_EVERY: Duration = Duration::from_millis(500);

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

/// Estimates how long an answer may take, by the mean and the spread of the round trips measured, as TCP does.
#[derive(Debug, Default)]
pub(super) struct RoundTrip {
    mean: Option<Duration>,
    spread: Duration,
    /// Number of polls since the last progress.
    asked: u32,
}

impl RoundTrip {
    /// Takes a measured round trip of a frame that was sent once.
    pub fn measured(&mut self, trip: Duration) {
        match self.mean {
            None => (self.mean, self.spread) = (Some(trip), trip / 2),
            Some(mean) => {
                self.spread = (self.spread * 3 + mean.abs_diff(trip)) / 4;
                self.mean = Some((mean * 7 + trip) / 8);
            }
        }
    }

    /// The mean round trip, or an assumption before one was measured.
    pub fn mean(&self) -> Duration {
        self.mean.unwrap_or(FIRST_TRIP)
    }

    /// Time without news, after the line is free, until the host polls. `frame` is the time of the longest frame.
    pub fn patience(&self, frame: Duration) -> Duration {
        let slack = (self.spread * 4).max(LEAST_SLACK);
        let once = self.mean() + slack + frame;
        once.saturating_mul(1 << self.asked.min(10)).min(POLL_EVERY)
    }

    /// Makes the host wait longer before the next poll.
    pub fn lengthen(&mut self) {
        self.asked = self.asked.saturating_add(1);
    }

    /// Makes the host wait the usual time again, after progress.
    pub fn shorten(&mut self) {
        self.asked = 0;
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

    #[test]
    fn patience_follows_the_round_trips() {
        let mut trips = RoundTrip::default();
        for _ in 0..100 {
            trips.measured(2 * MS);
        }
        assert_eq!(trips.mean(), 2 * MS);
        let patience = trips.patience(MS);
        assert!(patience >= 7 * MS && patience < 8 * MS, "{patience:?}");
        trips.lengthen();
        assert_eq!(trips.patience(MS), 2 * patience);
        for _ in 0..100 {
            trips.lengthen();
        }
        assert_eq!(trips.patience(MS), POLL_EVERY);
        trips.shorten();
        assert_eq!(trips.patience(MS), patience);
    }
}
