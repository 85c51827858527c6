//! Work on several threads.

use std::panic::resume_unwind;

/// The results of all items, in their order, each worked out on a thread of its own; a single one on this.
pub(super) fn in_parallel<T: Send, R: Send>(
    items: impl ExactSizeIterator<Item = T>,
    work: impl Fn(T) -> R + Sync,
) -> Vec<R> {
    if items.len() < 2 {
        return items.map(work).collect();
    }
    std::thread::scope(|scope| {
        let workers: Vec<_> = items.map(|item| scope.spawn(|| work(item))).collect();
        workers.into_iter().map(|worker| worker.join().unwrap_or_else(|panic| resume_unwind(panic))).collect()
    })
}
