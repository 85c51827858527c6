//! When bytes are off the line, and how long to wait for an answer.

use std::time::Duration;

/// Bits of a byte on the line: start, eight, stop.
const BITS: u64 = 10;
/// Round trip assumed before one was measured: a USB adapter with its default latency takes 16 ms.
const FIRST_TRIP: Duration = Duration::from_millis(30);
/// Least time beyond the mean round trip before the host asks.
const LEAST_SLACK: Duration = Duration::from_millis(4);
/// Longest time between two questions: well below the silence after which a device forgets.
pub(super) const POLL_EVERY: Duration = Duration::from_millis(500);

/// The line towards the device: how long its bytes take.
#[derive(Debug)]
pub(super) struct Line {
    rate: u32,
    free_at: Duration,
}

impl Line {
    pub fn new(rate: u32) -> Self {
        Self { rate, free_at: Duration::ZERO }
    }

    pub fn rate(&self) -> u32 {
        self.rate
    }

    /// Changes the rate; what was under way counts as sent.
    pub fn set_rate(&mut self, rate: u32, now: Duration) {
        *self = Self { rate, free_at: now };
    }

    /// Time that so many bytes take.
    pub fn time_of(&self, bytes: usize) -> Duration {
        let bits = (bytes as u64).saturating_mul(BITS);
        Duration::from_nanos(bits.saturating_mul(1_000_000_000) / u64::from(self.rate.max(1)))
    }

    /// Bytes were handed out: they are off the line at the time returned.
    pub fn carry(&mut self, bytes: usize, now: Duration) -> Duration {
        self.free_at = self.free_at.max(now) + self.time_of(bytes);
        self.free_at
    }

    /// When all bytes are off the line.
    pub fn free_at(&self) -> Duration {
        self.free_at
    }

    /// Time for which the line is occupied from now on.
    pub fn ahead(&self, now: Duration) -> Duration {
        self.free_at.saturating_sub(now)
    }
}

/// How long an answer may take: mean and spread of the round trips measured, as TCP does it.
#[derive(Debug, Default)]
pub(super) struct RoundTrip {
    mean: Option<Duration>,
    spread: Duration,
    /// Times the host asked without hearing of progress.
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

    /// The mean, or what is assumed.
    pub fn mean(&self) -> Duration {
        self.mean.unwrap_or(FIRST_TRIP)
    }

    /// Time without news, after the line is free, until the host asks; `frame` is what the longest frame takes.
    pub fn patience(&self, frame: Duration) -> Duration {
        let slack = (self.spread * 4).max(LEAST_SLACK);
        let once = self.mean() + slack + frame;
        once.saturating_mul(1 << self.asked.min(10)).min(POLL_EVERY)
    }

    /// The host asked: it waits longer for the next time.
    pub fn lengthen(&mut self) {
        self.asked = self.asked.saturating_add(1);
    }

    /// There was progress.
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
