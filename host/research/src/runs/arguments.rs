//! The arguments of `runs`.

use clap::Args;
use incircle_testkit::Distribution;

/// Arguments of `runs`.
#[derive(Clone, Debug, Args)]
pub struct RunsArguments {
    /// Points
    #[arg(short, value_name = "N", default_value_t = 8000, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub n: u32,
    /// Sets of points
    #[arg(value_name = "SET", default_values = ["uniform", "kuzmin", "lattice", "circle"])]
    pub sets: Vec<Distribution>,
    /// Contexts of the core
    #[arg(short = 'k', long, value_name = "N", default_value_t = 16)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=24))]
    pub contexts: u32,
    /// Items of a run, at most
    #[arg(long, value_name = "N", default_value_t = 8000)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    pub items: u32,
    /// Also count runs in random order
    #[arg(long)]
    pub random: bool,
    /// Count on the model of the blocks that the hardware has, instead of on that of the living engine: cycles alone
    #[arg(long)]
    pub hardware: bool,
    /// Repetitions of the deletions and insertions, to see that the cycles do not grow
    #[arg(long, value_name = "N", default_value_t = 1)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    pub rounds: u32,
    /// Seed; one seed gives the same points on every machine
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
}
