//! The command line of the comparison.

use clap::Parser;

use super::points::Set;

/// Triangulators beside each other: nanoseconds per point, medians
#[derive(Debug, Parser)]
#[command(name = "peers")]
pub struct Arguments {
    /// The sets (default: the five distributions of the literature, the lattice, and the airports of the world)
    #[arg(long, value_name = "SET", value_delimiter = ',')]
    pub(super) dist: Vec<Set>,
    /// Numbers of points, each at least 3: not all peers take fewer
    #[arg(short, value_name = "N", value_delimiter = ',', default_values_t = [1000, 16_384, 65_536, 1_000_000],
        value_parser = clap::value_parser!(u32).range(3..))]
    pub(super) n: Vec<u32>,
    /// Bits of a coordinate
    #[arg(long, default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=31))]
    pub(super) bits: u32,
    /// Repetitions, each with fresh points (default: 3 to 101, fewer for more points)
    #[arg(long, value_name = "R")]
    pub(super) repetitions: Option<usize>,
    /// Seed of the first repetition
    #[arg(long, default_value_t = 1)]
    pub(super) seed: u64,
    /// Leave out what each does just before, untimed: other points of the same set, so that it finds memory at hand
    #[arg(long)]
    pub(super) cold: bool,
    /// Print one JSON object a line for each set and number of points
    #[arg(long)]
    pub(super) json: bool,
}
