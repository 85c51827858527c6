//! The random generator of the faults. `testbench/kit` has a generator for tests; this one is separate because the
//! product must not depend on the test bench, and because a seed in a fault specification stands for one sequence of
//! faults, which changes to the tests' generator must not alter.

/// A generator of pseudo-random numbers: xorshift followed by a multiplication.
#[derive(Clone, Debug)]
pub(crate) struct Random(u64);

impl Random {
    /// The generator of this seed. The seed is mixed, so that neighbouring seeds give unrelated sequences.
    pub(crate) fn new(seed: u64) -> Self {
        let mut mixed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        Self((mixed ^ (mixed >> 31)) | 1)
    }

    /// A random number of 32 bits.
    pub(crate) fn bits(&mut self) -> u32 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 32) as u32
    }

    /// A random number below `limit`; 0 if `limit` is 0.
    pub(crate) fn below(&mut self, limit: u32) -> u32 {
        ((u64::from(self.bits()) * u64::from(limit)) >> 32) as u32
    }

    /// True with this probability. Probabilities are resolved to 2^-53.
    pub(crate) fn happens(&mut self, probability: f64) -> bool {
        if probability <= 0.0 {
            return false;
        }
        let high = u64::from(self.bits()) << 21;
        let low = u64::from(self.bits()) >> 11;
        ((high | low) as f64) < probability * (1_u64 << 53) as f64
    }

    /// Number of trials that fail before the next success, for trials that succeed with this probability.
    pub(crate) fn wait(&mut self, probability: f64) -> u64 {
        if probability <= 0.0 {
            return u64::MAX;
        }
        if probability >= 1.0 {
            return 0;
        }
        let chance = (f64::from(self.bits()) + 0.5) / 4_294_967_296.0;
        // A tiny probability gives a number beyond the range; the conversion then yields the largest number.
        (chance.ln() / (-probability).ln_1p()) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chances_are_as_asked() {
        let mut random = Random::new(1);
        let often = (0..100_000).filter(|_| random.happens(0.25)).count();
        assert!((24_000..26_000).contains(&often), "{often}");
        assert!(!(0..1000).any(|_| random.happens(0.0)));
        assert!((0..1000).all(|_| random.happens(1.0)));
        let mean = (0..100_000).map(|_| random.wait(0.01)).sum::<u64>() / 100_000;
        assert!((95..103).contains(&mean), "{mean}");
        assert_eq!((random.wait(0.0), random.wait(1.0)), (u64::MAX, 0));
        assert!((0..1000).all(|_| random.below(7) < 7));
        assert_ne!(Random::new(1).bits(), Random::new(2).bits());
    }
}
