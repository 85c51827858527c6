//! Random numbers that are the same on every machine.

/// The generator SplitMix64: one 64-bit word of state, every seed good.
///
/// Source: G. L. Steele Jr., D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
#[derive(Clone, Debug)]
pub struct SplitMix64 {
    state: u64,
}

impl SplitMix64 {
    /// Starts the sequence of this seed.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// Returns the seed of the numbers that are still to come.
    pub fn state(&self) -> u64 {
        self.state
    }

    /// Returns the next 64 bits.
    pub fn next_u64(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.state;
        mixed = (mixed ^ mixed >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    /// Returns a number from 0 to `bound - 1`, or 0 if `bound` is 0. The bias is less than `bound` / 2^64.
    pub fn below(&mut self, bound: u64) -> u64 {
        let wide = u128::from(self.next_u64()) * u128::from(bound);
        (wide >> 64) as u64
    }

    /// Returns a number from 0 to `bound - 1` in 32 bits, as [`Self::below`] does.
    pub fn below_u32(&mut self, bound: u32) -> u32 {
        self.below(bound.into()) as u32
    }

    /// Returns a number of `bits` bits, from 1 to 64.
    pub fn bits(&mut self, bits: u32) -> u64 {
        self.next_u64() >> (u64::BITS - bits)
    }

    /// Returns true once in `times`, by chance.
    pub fn once_in(&mut self, times: u64) -> bool {
        self.below(times) == 0
    }

    /// Returns one of the items, each with equal chance.
    ///
    /// # Panics
    /// Panics if there are no items.
    pub fn pick<T: Copy>(&mut self, items: &[T]) -> T {
        items[self.below(items.len() as u64) as usize]
    }

    /// Returns points of the square `[0, side)`, each place with equal chance, as any type that pairs
    /// of coordinates turn into.
    pub fn points<P: From<[u32; 2]>>(&mut self, count: usize, side: u32) -> Vec<P> {
        (0..count).map(|_| P::from([self.below_u32(side), self.below_u32(side)])).collect()
    }

    /// Returns a number in `[0, 1)`, a multiple of 2^-53.
    pub fn unit(&mut self) -> f64 {
        const STEP: f64 = 1.0 / (1u64 << 53) as f64;
        (self.next_u64() >> 11) as f64 * STEP
    }

    /// Returns two independent numbers of the standard normal distribution, by the transform of Box and Muller, 1958.
    pub fn normal_pair(&mut self) -> [f64; 2] {
        let radius = libm::sqrt(-2.0 * libm::log(1.0 - self.unit()));
        let angle = std::f64::consts::TAU * self.unit();
        [radius * libm::cos(angle), radius * libm::sin(angle)]
    }

    /// Puts the items into random order, by the shuffle of Fisher and Yates.
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            let other = self.below(last as u64 + 1) as usize;
            items.swap(last, other);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_those_of_the_published_generator() {
        let mut random = SplitMix64::new(1_234_567);
        let words: Vec<u64> = (0..3).map(|_| random.next_u64()).collect();
        let published = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
        assert_eq!(words, published);
    }

    #[test]
    fn the_state_is_the_seed_of_what_comes() {
        let mut random = SplitMix64::new(5);
        random.next_u64();
        assert_eq!(SplitMix64::new(random.state()).next_u64(), random.next_u64());
    }

    #[test]
    fn numbers_stay_below_their_bound() {
        let mut random = SplitMix64::new(2);
        assert!((0..1000).all(|_| random.below(7) < 7 && random.below_u32(3) < 3));
        assert_eq!((random.below(0), random.below_u32(1)), (0, 0));
        assert!((0..1000).all(|_| random.bits(3) < 8 && random.once_in(1)));
        assert_eq!(random.pick(&[5]), 5);
        let points: Vec<[u32; 2]> = random.points(100, 4);
        assert!(points.len() == 100 && points.iter().flatten().all(|&value| value < 4));
    }

    #[test]
    fn shuffling_keeps_every_item() {
        let mut items: Vec<u32> = (0..100).collect();
        SplitMix64::new(3).shuffle(&mut items);
        assert_ne!(items, (0..100).collect::<Vec<_>>());
        items.sort_unstable();
        assert_eq!(items, (0..100).collect::<Vec<_>>());
    }
}
