//! The random order of the classic randomized incremental construction.
//!
//! The expected number of changes of the mesh is O(n) for any set, but each point must be located from far away.
//! Source: Clarkson and Shor, *Applications of random sampling in computational geometry II*, 1989.

use alloc::vec::Vec;

use super::keys::{by_key, mix};
use crate::point::Point;

/// A random permutation of `0..points.len()`, which follows from the coordinates alone: the same set always gives the
/// same order. Equal points stay together, in input order. O(n).
pub fn random(points: &[Point]) -> Vec<u32> {
    by_key(points, |point| mix(u64::from(point.x) << 32 | u64::from(point.y)))
}

#[cfg(test)]
mod tests {
    use crate::order::random;
    use crate::point::Point;

    #[test]
    fn half_of_the_steps_of_a_line_lead_back() {
        let points: Vec<Point> = (0..1000).map(|k| Point::new(k, 5)).collect();
        let back = random(&points).windows(2).filter(|pair| pair[1] < pair[0]).count();
        assert!((400..600).contains(&back), "{back}");
    }
}
