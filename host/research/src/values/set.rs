//! Points with heights, and the places at which values are asked.

use incircle_geometry::{order, Point};
use incircle_testkit::SplitMix64;

/// Bits of a coordinate.
pub(super) const BITS: u32 = 24;

/// A hilly surface on random points, and random places.
pub(super) struct Set {
    pub points: Vec<[f64; 2]>,
    pub heights: Vec<f64>,
    /// The places in the order in which they were drawn.
    pub random: Vec<[f64; 2]>,
    /// The same places along the Hilbert curve.
    pub sorted: Vec<[f64; 2]>,
}

impl Set {
    pub(super) fn new(points: usize, places: usize, seed: u64) -> Self {
        let mut random = SplitMix64::new(seed);
        let mut draw = |count: usize| -> Vec<Point> {
            (0..count).map(|_| Point::new(random.bits(BITS) as u32, random.bits(BITS) as u32)).collect()
        };
        let (points, places) = (draw(points), draw(places));
        let double = |point: &Point| [f64::from(point.x), f64::from(point.y)];
        let sorted = order::hilbert(&places).into_iter().map(|index| double(&places[index as usize])).collect();
        let points: Vec<[f64; 2]> = points.iter().map(double).collect();
        let heights = points.iter().map(|&[x, y]| (x / 3e5).sin() + (y / 5e5).cos()).collect();
        Self { points, heights, random: places.iter().map(double).collect(), sorted }
    }
}
