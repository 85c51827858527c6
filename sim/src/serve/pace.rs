//! Simulated time beside real time.

use std::time::{Duration, Instant};

/// Holds simulated time back.
#[derive(Debug)]
pub(super) struct Pace {
    /// Real time of a clock in nanoseconds, at least.
    nanoseconds: f64,
    clock_hz: u32,
    /// Since when the board has worked without rest, and the clocks since.
    stretch: Option<(Instant, u64)>,
    /// Clocks of all stretches, and the time spent in them without naps.
    clocks: u64,
    working: Duration,
    begun: Option<Instant>,
}

impl Pace {
    /// Real time passes at least `slow` times as fast as that of a board with this clock.
    pub(super) fn new(slow: u32, clock_hz: u32) -> Self {
        let nanoseconds = f64::from(slow) * 1e9 / f64::from(clock_hz);
        Self { nanoseconds, clock_hz, stretch: None, clocks: 0, working: Duration::ZERO, begun: None }
    }

    /// Time stands still.
    pub(super) fn rest(&mut self) {
        self.stretch = None;
    }

    /// A slice begins.
    pub(super) fn begin(&mut self) {
        let now = Instant::now();
        self.stretch.get_or_insert((now, 0));
        self.begun = Some(now);
    }

    /// A slice of so many clocks has ended: how far simulated time is ahead. Where it is behind, what is lost is not caught up, as the
    /// host's time has passed.
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

    /// Real time over simulated time if the board were never held back.
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
