//! How long to wait for an answer on a local network.

use std::time::Duration;

/// Round trip that is assumed before one is measured.
const FIRST_TRIP: Duration = Duration::from_millis(2);
/// Least time beyond the mean round trip before the host polls.
const LEAST_SLACK: Duration = Duration::from_micros(500);
/// Longest time between two polls, far below the silence after which a device forgets the session.
const POLL_EVERY: Duration = Duration::from_millis(100);

/// Estimates how long an answer may take, by the mean and the spread of the round trips measured, as TCP does.
#[derive(Debug, Default)]
pub(super) struct RoundTrip {
    mean: Option<Duration>,
    spread: Duration,
    /// Number of polls since the last progress.
    asked: u32,
}

impl RoundTrip {
    /// Takes a measured round trip of a datagram that was sent once.
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

    /// Time without news until the host polls. With each poll that brings no progress the time doubles.
    pub fn patience(&self, silence: Duration) -> Duration {
        let once = self.mean() + (self.spread * 4).max(LEAST_SLACK);
        once.saturating_mul(1 << self.asked.min(10)).min(POLL_EVERY).min(silence / 8)
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

    #[test]
    fn patience_follows_the_round_trips() {
        let (us, silence) = (Duration::from_micros(1), Duration::from_secs(2));
        let mut trips = RoundTrip::default();
        (0..100).for_each(|_| trips.measured(200 * us));
        let patience = trips.patience(silence);
        assert!(patience >= 700 * us && patience < 800 * us, "{patience:?}");
        trips.lengthen();
        assert_eq!(trips.patience(silence), 2 * patience);
        (0..100).for_each(|_| trips.lengthen());
        assert_eq!(trips.patience(silence), POLL_EVERY);
        assert_eq!(trips.patience(silence / 10), silence / 80);
        trips.shorten();
        assert_eq!(trips.patience(silence), patience);
    }
}
