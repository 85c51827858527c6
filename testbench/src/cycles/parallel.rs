//! Work on many items at a time.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::Mutex;

use super::MeasureError;

/// Applies `work` to all items, on all processors, and returns the results in the order of the items.
pub(super) fn in_parallel<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(&T) -> Result<R, MeasureError> + Sync,
) -> Result<Vec<R>, MeasureError> {
    let at = AtomicUsize::new(0);
    let done = Mutex::new(Vec::with_capacity(items.len()));
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| loop {
                let place = at.fetch_add(1, Ordering::Relaxed);
                let Some(item) = items.get(place) else {
                    return;
                };
                let result = work(item);
                if let Ok(mut done) = done.lock() {
                    done.push((place, result));
                }
            });
        }
    });
    let mut results = done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    results.sort_by_key(|(place, _)| *place);
    results.into_iter().map(|(_, result)| result).collect()
}
