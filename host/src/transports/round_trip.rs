//! The time that the host waits for news of a device before it polls.

use std::time::Duration;

/// The times of a link before any was measured, and their bounds.
#[derive(Clone, Copy, Debug)]
pub(super) struct TripBounds {
    /// Round trip that is assumed before one is measured.
    pub first_trip: Duration,
    /// Least time beyond the mean round trip before the host polls.
    pub least_slack: Duration,
    /// Longest time between two polls, well below the silence after which a device forgets the session.
    pub poll_every: Duration,
}

/// Estimates how long an answer may take, by the mean and the spread of the round trips measured, as TCP does.
#[derive(Debug)]
pub(super) struct RoundTrip {
    bounds: TripBounds,
    mean: Option<Duration>,
    spread: Duration,
    /// Number of polls since the last progress.
    asked: u32,
}

impl RoundTrip {
    pub fn new(bounds: TripBounds) -> Self {
        Self { bounds, mean: None, spread: Duration::ZERO, asked: 0 }
    }

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
        self.mean.unwrap_or(self.bounds.first_trip)
    }

    /// Time without news, after the line is free, until the host polls. `frame` is the time of the longest frame on the
    /// line. With each poll that brings no progress the time doubles.
    pub fn patience(&self, frame: Duration) -> Duration {
        let once = self.mean() + (self.spread * 4).max(self.bounds.least_slack) + frame;
        once.saturating_mul(1 << self.asked.min(10)).min(self.bounds.poll_every)
    }

    /// The mean round trip, or `least` if that is longer, which doubles with each poll that brings no progress: how
    /// long to wait for something that is sure to come.
    pub fn repeated(&self, least: Duration) -> Duration {
        self.mean().max(least).saturating_mul(1 << self.asked.min(10)).min(self.bounds.poll_every)
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
        let ms = Duration::from_millis(1);
        let mut trips = RoundTrip::new(TripBounds { first_trip: 30 * ms, least_slack: 4 * ms, poll_every: 500 * ms });
        assert_eq!(trips.mean(), 30 * ms);
        (0..100).for_each(|_| trips.measured(2 * ms));
        assert_eq!(trips.mean(), 2 * ms);
        let patience = trips.patience(ms);
        assert!(patience >= 7 * ms && patience < 8 * ms, "{patience:?}");
        trips.lengthen();
        assert_eq!(trips.patience(ms), 2 * patience);
        (0..100).for_each(|_| trips.lengthen());
        assert_eq!(trips.patience(ms), 500 * ms);
        trips.shorten();
        assert_eq!(trips.patience(ms), patience);
    }
}
