//! What several tests share: a small generator of numbers, a core that is driven by command words, and the check of a mesh.

pub mod batches;
pub mod bench;
pub mod mesh_check;
pub mod sets;

use incircle_testkit::SplitMix64;

/// The kit's random numbers with bounds of 32 bits, by their remainder: the seeds of many tests stand for these numbers.
pub struct Random(pub u64);

impl Random {
    pub fn below(&mut self, bound: u32) -> u32 {
        let mut random = SplitMix64::new(self.0);
        let word = random.next_u64();
        self.0 = random.state();
        (word % u64::from(bound)) as u32
    }

    /// One of these.
    pub fn pick<T: Copy>(&mut self, items: &[T]) -> T {
        items[self.below(items.len() as u32) as usize]
    }

    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for end in (1..items.len()).rev() {
            items.swap(end, self.below(end as u32 + 1) as usize);
        }
    }
}
