//! Calls of the system that do not return.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Calls of the system that were given up on.
static LEFT_BEHIND: AtomicUsize = AtomicUsize::new(0);

/// One more call is given up on.
pub(super) fn note_call() {
    LEFT_BEHIND.fetch_add(1, Ordering::Relaxed);
}

/// Calls of the system that had not returned when this process gave up on them, so far. Each has a thread that waits
/// for it, and keeps its card locked until it returns; a call to a sound driver returns after its own timeout, 10
/// seconds unless its module was loaded with another.
pub fn calls_left_behind() -> usize {
    LEFT_BEHIND.load(Ordering::Relaxed)
}
