//! Point sets by name: the distributions of the literature, and the hard cases.
//!
//! Every set is a list of exactly `n` points with integer coordinates in `[0, 2^bits)`, and depends on nothing but its
//! name, `n`, `bits` and the seed: the random numbers are SplitMix64 and the elementary functions those of `libm`, so
//! all machines give the same points. Points may fall together; where a definition has room for fewer distinct points
//! than asked for, they do. Sets with a fixed shape are shuffled, so that the seed chooses their order.

mod grid;
mod sampled;
mod shaped;

use std::fmt;
use std::str::FromStr;

use crate::random::SplitMix64;
use grid::Grid;

pub use grid::{GenerateError, BITS};

/// The sets that can be generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Distribution {
    /// Every grid point alike.
    Uniform,
    /// Gaussian around the centre.
    Normal,
    /// Kuzmin's disc, crowded in the centre with long tails.
    Kuzmin,
    /// Crowded towards a vertical line.
    Line,
    /// A chequered board, 7/8 of the points on black squares.
    Checkers,
    /// Points of a square lattice.
    Lattice,
    /// A square lattice, turned by an exact rotation.
    RotatedLattice,
    /// Points close to a circle.
    Circle,
    /// Points in Gaussian clusters.
    Clusters,
    /// Points on a parabola.
    Parabola,
    /// The parabola mirrored, with the vertex where a Hilbert curve ends.
    ParabolaInward,
    /// Two convex chains that face each other.
    TwoChains,
    /// Points on a spiral.
    Spiral,
    /// All points of a small box, each about four times.
    Box,
}

/// Each distribution with its name and what it is, in a few words.
const NAMED: [(Distribution, &str, &str); 14] = [
    (Distribution::Uniform, "uniform", "Every grid point alike"),
    (Distribution::Normal, "normal", "Gaussian around the centre"),
    (Distribution::Kuzmin, "kuzmin", "Kuzmin's disc, crowded in the centre with long tails"),
    (Distribution::Line, "line", "Crowded towards a vertical line"),
    (Distribution::Checkers, "checkers", "A chequered board, 7/8 of the points on black squares"),
    (Distribution::Lattice, "lattice", "A square lattice"),
    (Distribution::RotatedLattice, "rotated-lattice", "A square lattice, turned by an exact rotation"),
    (Distribution::Circle, "circle", "Near a circle"),
    (Distribution::Clusters, "clusters", "Gaussian clusters"),
    (Distribution::Parabola, "parabola", "On a parabola"),
    (Distribution::ParabolaInward, "parabola-inward", "The same, with the vertex where a Hilbert curve ends"),
    (Distribution::TwoChains, "two-chains", "Two convex chains that face each other"),
    (Distribution::Spiral, "spiral", "On a spiral"),
    (Distribution::Box, "box", "All points of a small box, each about four times"),
];

impl Distribution {
    /// All distributions, in the order of [`Distribution`].
    pub const ALL: [Self; NAMED.len()] = {
        let mut all = [Self::Uniform; NAMED.len()];
        let mut place = 0;
        while place < NAMED.len() {
            all[place] = NAMED[place].0;
            place += 1;
        }
        all
    };

    /// The five distributions of the literature.
    pub const LITERATURE: [Self; 5] = [Self::Uniform, Self::Normal, Self::Kuzmin, Self::Line, Self::Checkers];

    /// Returns all distributions.
    pub fn all() -> &'static [Self] {
        &Self::ALL
    }

    /// Name of the set on the command line: lower case, words joined by hyphens.
    pub fn name(self) -> &'static str {
        NAMED[self as usize].1
    }

    /// Description of the set in a few words.
    pub fn description(self) -> &'static str {
        NAMED[self as usize].2
    }
}

impl fmt::Display for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The error that no distribution has this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownName(pub String);

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = Distribution::ALL.map(Distribution::name).join(", ");
        write!(f, "there is no point set '{}': choose one of {names}", self.0)
    }
}

impl std::error::Error for UnknownName {}

impl FromStr for Distribution {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        let named = Self::ALL.into_iter().find(|distribution| distribution.name() == name);
        named.ok_or_else(|| UnknownName(name.to_owned()))
    }
}

/// Points of a set, one after the other.
pub type SetPoints = Box<dyn ExactSizeIterator<Item = [u32; 2]>>;

/// Exactly `n` points of a distribution on the grid `[0, 2^bits)` squared. O(n).
///
/// # Errors
/// `bits` outside [`BITS`], or no memory for `n` points.
pub fn generate(distribution: Distribution, n: usize, bits: u32, seed: u64) -> Result<Vec<[u32; 2]>, GenerateError> {
    let mut points = grid::room(n)?;
    points.extend(stream(distribution, n, bits, seed)?);
    Ok(points)
}

/// The points of [`generate`], one after the other. Samples of a distribution take no memory for their points, but a
/// hundredth of that for clusters; sets with a fixed shape take all of it.
///
/// # Errors
/// Those of [`generate`].
pub fn stream(distribution: Distribution, n: usize, bits: u32, seed: u64) -> Result<SetPoints, GenerateError> {
    if !BITS.contains(&bits) {
        return Err(GenerateError::Bits(bits));
    }
    let grid = Grid { size: 1 << bits };
    let mut own = SplitMix64::new(seed);
    let random = &mut own;
    let draw = match distribution {
        Distribution::Uniform => sampled::uniform(grid),
        Distribution::Normal => sampled::normal(grid),
        Distribution::Kuzmin => sampled::kuzmin(grid),
        Distribution::Line => sampled::line(grid),
        Distribution::Checkers => sampled::checkers(grid),
        Distribution::Circle => sampled::circle(grid),
        Distribution::Clusters => sampled::clusters(n, grid, random)?,
        Distribution::Lattice => return listed(shaped::lattice(n, grid, random)),
        Distribution::RotatedLattice => return listed(shaped::rotated_lattice(n, grid, random)),
        Distribution::Parabola => return listed(shaped::parabola(n, grid, random)),
        Distribution::ParabolaInward => return listed(shaped::parabola_inward(n, grid, random)),
        Distribution::TwoChains => return listed(shaped::two_chains(n, grid, random)),
        Distribution::Spiral => return listed(shaped::spiral(n, grid, random)),
        Distribution::Box => return listed(shaped::filled_box(n, grid, random)),
    };
    Ok(Box::new(sampled::Drawn::new(n, own, draw)))
}

fn listed(points: grid::Points) -> Result<SetPoints, GenerateError> {
    Ok(Box::new(points?.into_iter()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FNV-1a over the coordinates, which shows a change in any bit of any point.
    fn fingerprint(points: &[[u32; 2]]) -> u64 {
        let bytes = points.iter().flatten().flat_map(|value| value.to_le_bytes());
        bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    }

    #[test]
    fn every_set_has_exactly_n_points_of_the_grid() {
        for &distribution in Distribution::all() {
            for (n, bits) in [(0, 8), (1, 1), (2, 31), (3, 4), (100, 3), (1000, 16), (1000, 31), (5000, 1)] {
                let points = generate(distribution, n, bits, 7).expect("the bits are possible");
                assert_eq!(points.len(), n, "{distribution} {n} {bits}");
                let inside = points.iter().flatten().all(|&value| u64::from(value) < 1 << bits);
                assert!(inside, "{distribution} {n} {bits}");
            }
        }
    }

    #[test]
    fn every_distribution_has_its_name() {
        for (place, distribution) in Distribution::ALL.into_iter().enumerate() {
            assert_eq!(NAMED[place].0 as usize, place);
            assert_eq!(distribution.name().parse(), Ok(distribution));
        }
        assert_eq!(Distribution::TwoChains.to_string(), "two-chains");
        let refused = "gauss".parse::<Distribution>().map_err(|error| error.to_string());
        assert!(refused.is_err_and(|error| error.contains("'gauss'") && error.contains("rotated-lattice")));
    }

    #[test]
    fn impossible_bits_are_refused() {
        assert_eq!(generate(Distribution::Uniform, 1, 0, 0), Err(GenerateError::Bits(0)));
        assert_eq!(generate(Distribution::Uniform, 1, 32, 0), Err(GenerateError::Bits(32)));
    }

    #[test]
    fn more_points_than_memory_are_refused() {
        for &distribution in Distribution::all() {
            let n = usize::MAX / 16;
            let refused = Err(GenerateError::Memory(n));
            if distribution == Distribution::Clusters {
                // The centres of clusters come first, so their allocation may fail before that of the points.
                assert!(generate(distribution, n, 16, 1).is_err());
            } else {
                assert_eq!(generate(distribution, n, 16, 1), refused, "{distribution}");
            }
        }
    }

    #[test]
    fn the_seed_matters_and_nothing_else() {
        for &distribution in Distribution::all() {
            let set = |seed| generate(distribution, 500, 16, seed).expect("the bits are possible");
            assert_eq!(set(1), set(1), "{distribution}");
            assert_ne!(set(1), set(2), "{distribution}");
        }
    }

    #[test]
    fn the_points_are_those_of_every_machine() {
        let golden = [
            (Distribution::Uniform, 0x5bf4_822a_a2ba_194c),
            (Distribution::Normal, 0x6b01_e4e3_4bf0_2852),
            (Distribution::Kuzmin, 0xbccd_e871_5f30_8ccb),
            (Distribution::Line, 0x5206_3189_6965_c706),
            (Distribution::Checkers, 0x84c7_e621_51a0_daa6),
            (Distribution::Lattice, 0xebff_db71_96c4_4819),
            (Distribution::RotatedLattice, 0xb41a_a2d8_9464_d5ef),
            (Distribution::Circle, 0x3d82_963c_351b_7ba5),
            (Distribution::Clusters, 0x17fd_9532_2e4d_5bdb),
            (Distribution::Parabola, 0x9dd9_7cf6_5e4f_2322),
            (Distribution::ParabolaInward, 0x6f83_6e40_2d28_e68e),
            (Distribution::TwoChains, 0x5710_cb7c_8bb8_6415),
            (Distribution::Spiral, 0xc204_e26f_90eb_aca4),
            (Distribution::Box, 0xdd99_a946_87f1_34e9),
        ];
        let found = Distribution::all().iter().map(|&distribution| {
            let points = generate(distribution, 1000, 16, 1).expect("the bits are possible");
            (distribution, fingerprint(&points))
        });
        assert_eq!(found.collect::<Vec<_>>(), golden);
    }

    #[test]
    fn distinct_points_are_many_where_the_shape_has_room() {
        for &distribution in Distribution::all() {
            let mut points = generate(distribution, 1000, 16, 1).expect("the bits are possible");
            points.sort_unstable();
            points.dedup();
            let expected = if distribution == Distribution::Box { 225..=256 } else { 950..=1000 };
            assert!(expected.contains(&points.len()), "{distribution}: {}", points.len());
        }
    }
}
