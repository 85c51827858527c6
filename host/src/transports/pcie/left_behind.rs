//! A count of system calls that do not return.

use std::sync::atomic::{AtomicUsize, Ordering};

/// System calls that had not returned when this process stopped waiting for them.
static LEFT_BEHIND: AtomicUsize = AtomicUsize::new(0);

/// Counts one more call that this process leaves behind.
pub(super) fn record_abandoned_call() {
    LEFT_BEHIND.fetch_add(1, Ordering::Relaxed);
}

/// Number of system calls, so far, that had not returned when this process stopped waiting for them.
///
/// Each has a thread that waits for it, and keeps its card locked until it returns. A call to a sound driver returns
/// after the driver's own timeout, 10 seconds unless its module was loaded with another.
pub fn calls_left_behind() -> usize {
    LEFT_BEHIND.load(Ordering::Relaxed)
}
