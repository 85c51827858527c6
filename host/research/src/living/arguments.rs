//! The command line of the comparison.

use clap::Args;

/// Arguments of `living`.
#[derive(Clone, Debug, Args)]
pub struct LivingArguments {
    /// Points at the beginning
    #[arg(short, value_name = "N", default_value_t = 1_000_000, value_parser = clap::value_parser!(u32).range(3..))]
    pub n: u32,
    /// Commands of each kind
    #[arg(long, value_name = "N", default_value_t = 250_000)]
    pub commands: u32,
    /// Commands that are timed together before it is the next library's turn
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub block: u32,
    /// Take points of a grid of 31 bits, which are integers for us and doubles for the others, instead of doubles
    #[arg(long)]
    pub grid: bool,
    /// Leave CGAL out, also where it is installed: its program takes half a minute to compile
    #[arg(long)]
    pub without_cgal: bool,
    /// Seed; one seed gives the same points and commands on every machine
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
}
