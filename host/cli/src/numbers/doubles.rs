//! Sets in doubles between -1 and 1 that keep the shape of the set and use all 53 bits of their mantissas.
//!
//! Additions, products, quotients and square roots are rounded alike on every machine; no other function is used.

use incircle_testkit::{Distribution, SplitMix64};

/// Bits of the grid on which a set is made before it turns into doubles.
pub const GRID_BITS: u32 = 31;

/// The last coordinate of that grid.
const LAST: f64 = ((1u64 << GRID_BITS) - 1) as f64;
/// Half a step of that grid, for sets whose shape counts. The mantissa of pi uses all its bits. A step that is a short
/// binary fraction would make short binary fractions of all coordinates.
const HALF_STEP: f64 = std::f64::consts::FRAC_PI_4 / (1u64 << GRID_BITS) as f64;

/// A set in doubles.
#[derive(Clone, Copy, Debug)]
pub struct DoubleSet {
    distribution: Distribution,
    /// The seed of the random places in the cells.
    seed: u64,
}

impl DoubleSet {
    /// The set of this distribution and seed.
    pub fn new(distribution: Distribution, seed: u64) -> Self {
        Self { distribution, seed: SplitMix64::new(seed).next_u64() }
    }

    /// The coordinates of a point of the grid. They depend on the point, the set and the seed, but not on the order of
    /// the points.
    pub fn place(&self, point: [u32; 2]) -> [f64; 2] {
        match self.distribution {
            Distribution::Lattice | Distribution::RotatedLattice | Distribution::Box => point.map(spread),
            Distribution::Circle => on_circle(point.map(spread)),
            Distribution::Parabola => {
                let x = f64::from(point[0]) * HALF_STEP;
                [x, x * x]
            }
            Distribution::ParabolaInward => {
                let x = (LAST - f64::from(point[0])) * HALF_STEP;
                // Zero minus x, because -x would be -0 at the vertex.
                [0.0 - x, x * x]
            }
            Distribution::TwoChains => on_chain(spread(point[0]), f64::from(point[1]) > LAST / 2.0),
            Distribution::Uniform
            | Distribution::Normal
            | Distribution::Kuzmin
            | Distribution::Line
            | Distribution::Checkers
            | Distribution::Clusters
            | Distribution::Spiral => self.in_cell(point),
        }
    }

    /// A random place of the cell of the grid above and right of the point.
    fn in_cell(&self, [x, y]: [u32; 2]) -> [f64; 2] {
        let cell = u64::from(x) << 32 | u64::from(y);
        let mut random = SplitMix64::new(self.seed ^ cell);
        let half = f64::from(1u32 << (GRID_BITS - 1));
        [x, y].map(|value| (f64::from(value) - half + random.unit()) / half)
    }
}

/// The double nearest to a coordinate of the grid, counted from the middle of the grid.
fn spread(value: u32) -> f64 {
    (2.0 * f64::from(value) - LAST) * HALF_STEP
}

/// The place on the unit circle in the direction of `[x, y]`, within two units in the last place.
fn on_circle([x, y]: [f64; 2]) -> [f64; 2] {
    let length = (x * x + y * y).sqrt();
    [x / length, y / length]
}

/// The place at x on one of two parabolas that bulge towards each other.
fn on_chain(x: f64, is_upper: bool) -> [f64; 2] {
    let distance = 0.25 + 0.5 * (x * x);
    [x, if is_upper { distance } else { -distance }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::generate;

    fn set(distribution: Distribution) -> Vec<[f64; 2]> {
        let points = generate(distribution, 1000, GRID_BITS, 5).expect("the bits are possible");
        points.into_iter().map(|point| DoubleSet::new(distribution, 5).place(point)).collect()
    }

    /// FNV-1a over the bits of the coordinates, which shows a change in any of them.
    fn fingerprint(points: &[[f64; 2]]) -> u64 {
        let bytes = points.iter().flatten().flat_map(|value| value.to_bits().to_le_bytes());
        bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    }

    #[test]
    fn most_coordinates_need_more_bits_than_the_grid_has() {
        for &distribution in Distribution::all() {
            let points = set(distribution);
            assert!(points.iter().flatten().all(|value| (-1.0..=1.0).contains(value)), "{distribution}");
            let long = points.iter().flatten().filter(|value| value.to_bits().trailing_zeros() < 12).count();
            assert!(long > 1800, "{distribution}: {long}");
        }
    }

    #[test]
    fn shapes_are_kept_to_the_last_places() {
        for [x, y] in set(Distribution::Circle) {
            assert!((x * x + y * y - 1.0).abs() < 1e-15, "{x} {y}");
        }
        assert!(set(Distribution::Parabola).iter().all(|&[x, y]| y == x * x && x >= 0.0));
        assert!(set(Distribution::ParabolaInward).iter().all(|&[x, y]| y == x * x && x <= 0.0));
        assert!(set(Distribution::TwoChains).iter().all(|&[x, y]| y.abs() == 0.25 + 0.5 * (x * x)));
        let upper = set(Distribution::TwoChains).iter().filter(|[_, y]| *y > 0.0).count();
        assert_eq!(upper, 500);
        let distinct = |axis: usize| {
            let mut values: Vec<u64> = set(Distribution::Lattice).iter().map(|point| point[axis].to_bits()).collect();
            values.sort_unstable();
            values.dedup();
            values.len()
        };
        assert_eq!([distinct(0), distinct(1)], [32, 32]);
    }

    #[test]
    fn the_points_are_those_of_every_machine() {
        let found = Distribution::all().iter().map(|&distribution| (distribution, fingerprint(&set(distribution))));
        let golden = [
            (Distribution::Uniform, 0x6690_4cf4_4c9c_0f8d),
            (Distribution::Normal, 0xf9a9_ffcb_0df9_0277),
            (Distribution::Kuzmin, 0x373b_bc61_798e_fc49),
            (Distribution::Line, 0x7db5_d38b_67f5_2f53),
            (Distribution::Checkers, 0xbd72_28d9_95a4_df85),
            (Distribution::Lattice, 0x548f_006a_3b44_92cc),
            (Distribution::RotatedLattice, 0x9b53_d65e_6b8a_c9b7),
            (Distribution::Circle, 0x6d9f_97f6_c54c_cb77),
            (Distribution::Clusters, 0x622b_03f7_1da6_62d5),
            (Distribution::Parabola, 0x908b_d788_cc3c_53b7),
            (Distribution::ParabolaInward, 0x8cd9_dcc7_c37d_f137),
            (Distribution::TwoChains, 0x84e4_b5da_12d6_4f8d),
            (Distribution::Spiral, 0xb045_01e6_14d7_f937),
            (Distribution::Box, 0x9b0e_020a_489e_9cc5),
        ];
        assert_eq!(found.collect::<Vec<_>>(), golden);
    }
}
