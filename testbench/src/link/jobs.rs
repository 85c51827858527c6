//! Jobs for the link.

use incircle::{Mesh, Point};

/// Points of a job, the same for the same seed: some of them on one circle or twice.
pub fn random_points(count: usize, seed: u64) -> Vec<Point> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 32) as u32
    };
    // Few places for many points, every third time.
    let side = if seed.is_multiple_of(3) { 16 } else { 1 << 16 };
    (0..count).map(|_| Point { x: random() % side, y: random() % side }).collect()
}

/// The two say the same, byte for byte.
pub fn is_one_mesh(one: &Mesh, other: &Mesh) -> bool {
    one.triangles == other.triangles
        && one.hull == other.hull
        && one.duplicates == other.duplicates
        && one.points == other.points
}
