//! The pace of simulated time: how fast it may run beside real time.

use std::time::{Duration, Instant};

/// Keeps simulated time from running faster than the service promises.
#[derive(Debug)]
pub(super) struct Pace {
    /// Smallest real time of a clock in nanoseconds.
    nanoseconds: f64,
    clock_hz: u32,
    /// Start of the current stretch of work without rest, and the number of clocks since then.
    stretch: Option<(Instant, u64)>,
    /// Number of clocks of all stretches, and the real time spent in them without sleep.
    clocks: u64,
    working: Duration,
    begun: Option<Instant>,
}

impl Pace {
    /// A pace at which real time passes at least `slow` times as fast as the time of a board with this clock.
    pub(super) fn new(slow: u32, clock_hz: u32) -> Self {
        let nanoseconds = f64::from(slow) * 1e9 / f64::from(clock_hz);
        Self { nanoseconds, clock_hz, stretch: None, clocks: 0, working: Duration::ZERO, begun: None }
    }

    /// Ends the current stretch: simulated time stands still.
    pub(super) fn rest(&mut self) {
        self.stretch = None;
    }

    /// Begins a slice of simulated time.
    pub(super) fn begin(&mut self) {
        let now = Instant::now();
        self.stretch.get_or_insert((now, 0));
        self.begun = Some(now);
    }

    /// Ends a slice of this many clocks, and returns how far simulated time is ahead. If it is behind, the delay is not
    /// caught up later, since the host has seen real time pass.
    pub(super) fn ahead(&mut self, clocks: u64) -> Option<Duration> {
        let now = Instant::now();
        self.clocks += clocks;
        self.working += self.begun.take().map_or(Duration::ZERO, |begun| now - begun);
        let (since, passed) = self.stretch.as_mut()?;
        *passed += clocks;
        let due = Duration::from_nanos((*passed as f64 * self.nanoseconds) as u64);
        let elapsed = now - *since;
        let ahead = due.checked_sub(elapsed);
        if ahead.is_none() {
            self.stretch = Some((now, 0));
        }
        ahead
    }

    /// Ratio of real time to simulated time if the board had never been held back.
    pub(super) fn slow_down(&self) -> Option<f64> {
        let simulated = self.clocks as f64 / f64::from(self.clock_hz);
        (self.clocks > 0).then(|| self.working.as_secs_f64() / simulated)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_that_runs_ahead_is_told_and_lost_time_is_forgotten() {
        let mut pace = Pace::new(1000, 1_000_000);
        assert_eq!(pace.slow_down(), None);
        pace.begin();
        let ahead = pace.ahead(1000).expect("a millisecond took no second");
        assert!(ahead > Duration::from_millis(900), "{ahead:?}");
        pace.rest();
        pace.begin();
        std::thread::sleep(Duration::from_millis(5));
        assert_eq!(pace.ahead(1), None);
        pace.begin();
        assert!(pace.ahead(100).is_some());
        assert!(pace.slow_down().is_some());
    }
}
