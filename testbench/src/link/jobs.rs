//! Jobs for the link.

use incircle::{Mesh, Point};
use incircle_testkit::SplitMix64;

/// Points of a job, the same for the same seed: some of them on one circle or twice.
pub fn random_points(count: usize, seed: u64) -> Vec<Point> {
    let mut random = SplitMix64::new(seed);
    // Few places for many points, every third time.
    let side = if seed.is_multiple_of(3) { 16 } else { 1 << 16 };
    random.points(count, side)
}

/// The two say the same, byte for byte.
pub fn is_one_mesh(one: &Mesh, other: &Mesh) -> bool {
    one == other
}
