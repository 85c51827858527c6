//! The clock of the caller, which times the line.

/// A clock that counts milliseconds.
///
/// Every closure that returns milliseconds is a clock.
pub trait Clock {
    /// Milliseconds since any moment, modulo 2^32. The driver asks again at least once in 24 days.
    fn milliseconds(&mut self) -> u32;

    /// Called again and again while the driver waits for a byte. An implementation may sleep until the next interrupt,
    /// or feed a watchdog, but must return within a few milliseconds. Does nothing unless overridden.
    fn idle(&mut self) {}
}

impl<F: FnMut() -> u32> Clock for F {
    fn milliseconds(&mut self) -> u32 {
        self()
    }
}

/// Whether the clock has reached a moment less than 2^31 milliseconds away.
pub(crate) const fn has_come(moment: u32, now: u32) -> bool {
    now.wrapping_sub(moment) < 1 << 31
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_come_also_where_the_clock_wraps() {
        assert!(has_come(5, 5) && has_come(5, 6) && !has_come(6, 5));
        assert!(has_come(u32::MAX, 2) && !has_come(2, u32::MAX));
    }
}
