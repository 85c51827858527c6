//! The arguments of `tracks`.

use clap::Args;

/// Arguments of `tracks`.
#[derive(Clone, Debug, Args)]
pub struct TracksArguments {
    /// Features
    #[arg(short, value_name = "N", default_value_t = 4000, value_parser = clap::value_parser!(u32).range(16..=8000))]
    pub n: u32,
    /// Frames
    #[arg(long, value_name = "N", default_value_t = 20)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    pub frames: u32,
    /// Places whose triangles are asked for in each frame
    #[arg(long, value_name = "N", default_value_t = 2000)]
    #[arg(value_parser = clap::value_parser!(u32).range(..=1_000_000))]
    pub places: u32,
    /// Contexts of the core
    #[arg(short = 'k', long, value_name = "N", default_value_t = 16)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=24))]
    pub contexts: u32,
    /// Seed; one seed gives the same features on every machine
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
}
