//! Work on several threads; without `std`, on the one that there is.

use alloc::vec::Vec;
#[cfg(feature = "std")]
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The results of all items, in their order, worked out on as many threads as there are items, this one among them. If
/// the system will not start a thread, the threads that did start share its work.
#[cfg(feature = "std")]
pub(super) fn in_parallel<T: Send, R: Send>(items: impl Iterator<Item = T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
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

/// The results of all items, in their order.
#[cfg(not(feature = "std"))]
pub(super) fn in_parallel<T: Send, R: Send>(items: impl Iterator<Item = T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    items.map(work).collect()
}

/// A thread that panics ends the whole, so nobody sees what it left.
#[cfg(feature = "std")]
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
