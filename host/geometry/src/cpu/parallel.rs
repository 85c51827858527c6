//! Work on several threads, or without `std` on the caller's thread.

use alloc::vec::Vec;
#[cfg(feature = "std")]
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Applies `work` to all items and returns the results in the order of the items. The number of threads is that of the
/// items, the calling thread included. If the system will not start a thread, the threads that did
/// start share its work.
#[cfg(feature = "std")]
pub(crate) fn in_parallel<T: Send, R: Send>(items: impl Iterator<Item = T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    use std::panic::resume_unwind;
    use std::thread::Builder;

    let tasks: Vec<(usize, T)> = items.enumerate().collect();
    let threads = tasks.len();
    let tasks = Mutex::new(tasks);
    let next = || lock(&tasks).pop();
    let work = || core::iter::from_fn(next).map(|(place, item)| (place, work(item))).collect::<Vec<_>>();
    let mut results = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map_while(|_| Builder::new().spawn_scoped(scope, work).ok()).collect();
        let mut results = work();
        for other in others {
            results.extend(other.join().unwrap_or_else(|panic| resume_unwind(panic)));
        }
        results
    });
    results.sort_unstable_by_key(|(place, _)| *place);
    results.into_iter().map(|(_, result)| result).collect()
}

/// Applies `work` to all items, one after the other, and returns the results in the order of the items.
#[cfg(not(feature = "std"))]
pub(crate) fn in_parallel<T: Send, R: Send>(items: impl Iterator<Item = T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    items.map(work).collect()
}

/// Locks a mutex, even if a thread panicked with it. A panic of one thread ends the whole work, so nobody sees what
/// that thread left in the mutex.
#[cfg(feature = "std")]
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
