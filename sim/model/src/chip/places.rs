//! The places for engines on a chip.

/// Largest number of engines of a chip.
pub(super) const MOST: usize = 4;
