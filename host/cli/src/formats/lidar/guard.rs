//! The last guard against damaged bytes: panics of the decoder.
//!
//! Arithmetic coding has no check sums. Every claim around the packed bytes is checked before they are decoded, but the
//! bytes themselves can be anything, and the decoder's tables have places that only damaged bytes reach. The decoder
//! panics there. Such a panic ends the reading of the file with a sentence, as any other damage does.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    static IS_GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Calls `work`; the result is `None` if `work` panics. The panic prints nothing.
///
/// A panic leaves everything that `work` was changing as it is at that moment, so the caller must not use it
/// afterwards.
pub fn guarded<T>(work: impl FnOnce() -> T) -> Option<T> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |about| {
            if !IS_GUARDED.get() {
                usual(about);
            }
        }));
    });
    let before = IS_GUARDED.replace(true);
    let result = panic::catch_unwind(AssertUnwindSafe(work));
    IS_GUARDED.set(before);
    result.ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_no_result() {
        assert_eq!(guarded(|| 7), Some(7));
        let numbers = [1, 2, 3];
        assert_eq!(guarded(|| numbers[std::hint::black_box(3)]), None);
        assert!(!IS_GUARDED.get());
    }
}
