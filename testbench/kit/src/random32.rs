//! Random numbers below bounds of 32 bits.

use super::random::SplitMix64;

/// The numbers of [`SplitMix64`], brought below a bound of 32 bits by their remainder. The state is public, and the
/// seeds in many tests were chosen for these numbers.
#[derive(Clone, Debug)]
pub struct Random32(pub u64);

impl Random32 {
    /// Returns a number from 0 to `bound - 1`.
    ///
    /// # Panics
    /// Panics if `bound` is 0.
    pub fn below(&mut self, bound: u32) -> u32 {
        let mut random = SplitMix64::new(self.0);
        let word = random.next_u64();
        self.0 = random.state();
        (word % u64::from(bound)) as u32
    }

    /// Returns one of the items.
    ///
    /// # Panics
    /// Panics if there are no items.
    pub fn pick<T: Copy>(&mut self, items: &[T]) -> T {
        items[self.below(items.len() as u32) as usize]
    }

    /// Puts the items into random order.
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for end in (1..items.len()).rev() {
            items.swap(end, self.below(end as u32 + 1) as usize);
        }
    }
}
