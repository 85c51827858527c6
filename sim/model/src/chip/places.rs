//! The places for engines on a chip.

use incircle_protocol::ENGINES;

/// Most engines of a chip: the number of places for engines. A place without an engine does no job.
pub(super) const MOST: usize = ENGINES[ENGINES.len() - 1] as usize;

/// All places in turn, from the one behind `current` to `current` itself.
pub(super) fn in_turn(current: usize) -> impl Iterator<Item = usize> {
    (1..=MOST).map(move |step| (current + step) % MOST)
}
