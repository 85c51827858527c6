//! The division of a bound on the memory among the steps of a proof, and the room that its files take.

use crate::failure::Failure;

/// The least memory of a proof.
const LEAST: u64 = 32 << 20;
/// The bytes that the program itself takes, with the buffers of its files.
const PROGRAM: u64 = 16 << 20;
/// The most triangles of a strip that are kept in memory, for each four of its points. Triangles beyond go through files.
const TRIANGLES_OF_FOUR: u64 = 9;
/// The bytes of a point of a strip: 12 for itself, up to 8 to find it, and for each triangle 12 and 36 for its sides.
const POINT_BYTES: u64 = 20 + TRIANGLES_OF_FOUR * 48 / 4;
/// The least and the most bytes of the buffer of a strip while triangles are dealt.
const BUFFER: std::ops::Range<u64> = 1 << 14..1 << 20;
/// The bytes of files for each triangle with corners in several strips.
const CROSSING_BYTES: u64 = 260;

/// The memory of each step, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// The memory beside the program itself.
    free: u64,
    /// The most points of a strip.
    pub strip: usize,
    /// The most triangles of a strip that are in memory at once.
    pub triangles: usize,
}

impl Budget {
    /// Divides a memory.
    ///
    /// # Errors
    /// Less than 32 MiB are too little for any set.
    pub fn of(memory: u64) -> Result<Self, Failure> {
        if memory < LEAST {
            return Err(Failure::usage(format!(
                "--memory {memory} is less than the {LEAST} bytes that a proof takes at least: give 32M or more"
            )));
        }
        let free = memory - PROGRAM;
        // Numbers of the sides of a strip have 32 bits.
        let strip = (free / 2 / POINT_BYTES).min(1 << 28);
        Ok(Self { free, strip: strip as usize, triangles: (strip * TRIANGLES_OF_FOUR / 4) as usize })
    }

    /// A memory of `free` bytes with strips of so many points and triangles.
    #[cfg(test)]
    pub fn narrow(free: u64, strip: usize, triangles: usize) -> Self {
        Self { free, strip, triangles }
    }

    /// A share of the memory: `1 / parts` of it.
    pub fn share(&self, parts: u64) -> u64 {
        self.free / parts
    }

    /// The bytes of the buffer of one of so many strips.
    ///
    /// # Errors
    /// The memory does not hold the buffers of all strips.
    pub fn buffer(&self, strips: usize, points: u64) -> Result<u64, Failure> {
        let share = self.free / 8 / strips.max(1) as u64;
        if share < BUFFER.start {
            // The number of strips falls as the memory grows, so the square of the memory counts.
            let product = u128::from(points) * u128::from(POINT_BYTES * 2 * 8 * BUFFER.start);
            let needed = (product.isqrt() as u64 + PROGRAM + (1 << 20)).div_ceil(1 << 20);
            return Err(Failure::usage(format!(
                "{points} points are too many for this --memory, because the buffers of {strips} strips do not fit it: \
                 give {needed}M or more"
            )));
        }
        Ok(share.min(BUFFER.end))
    }

    /// The bytes of all files for a set of so many points, if they are spread evenly and the mesh has as many triangles
    /// as it should.
    pub fn disk(&self, points: u64, is_unordered: bool) -> u64 {
        let strips = points.div_ceil(self.strip as u64).max(1);
        // A line through evenly spread points crosses `64 / (3 pi^2) sqrt(n) = 2.2 sqrt(n)` edges.
        let border = 3 * points.isqrt();
        let crossing = ((strips - 1) * border).min(2 * points);
        let mesh = if is_unordered { 24 * points } else { 0 };
        // Points and triangles are in files once they do not fit the memory; points are sorted before triangles come.
        (mesh + points * 32).max(mesh + points * (20 + 24) + crossing * CROSSING_BYTES)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_step_fits_the_memory() {
        for memory in [LEAST, 100 << 20, 1 << 30, 1 << 40] {
            let budget = Budget::of(memory).expect("enough");
            let strip = budget.strip as u64 * 20 + budget.triangles as u64 * 48;
            // While edges are checked: the strip, the buffers of all strips, two streams, duplicates and the hull.
            let others = budget.share(8) * 2 + budget.share(16) * 3;
            assert!(PROGRAM + strip + others <= memory, "{budget:?}");
        }
        assert!(Budget::of(LEAST - 1).is_err_and(|failure| failure.message.contains("give 32M")));
    }

    #[test]
    fn a_memory_that_is_too_small_is_told_by_the_one_that_is_not() {
        let points = 4_294_967_294u64;
        let buffer = |memory: u64| {
            let budget = Budget::of(memory).expect("enough for some set");
            budget.buffer(points.div_ceil(budget.strip as u64) as usize, points)
        };
        let refused = buffer(100 << 20).expect_err("too many strips").message;
        let told = refused.rsplit("give ").next().and_then(|end| end.split('M').next()).map(str::parse);
        let told: u64 = told.and_then(Result::ok).expect("a number of mebibytes");
        assert!((300..500).contains(&told), "{refused}");
        assert!(buffer(told << 20).is_ok(), "{refused}");
    }

    #[test]
    fn files_take_about_44_bytes_a_point() {
        let budget = Budget::of(1 << 30).expect("enough");
        assert_eq!(budget.disk(1000, false), 44_000);
        assert_eq!(budget.disk(1000, true), 68_000);
        assert_eq!(budget.disk(1_000_000_000, false) / 1_000_000_000, 49);
    }
}
