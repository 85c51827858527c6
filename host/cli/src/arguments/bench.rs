//! The arguments of `incircle bench`.

use clap::Args;
use incircle_testkit::Distribution;

use super::backend::BackendArguments;
use super::job::JobArguments;
use crate::values::{distribution_parser, mhz_from, whole_number};

/// The arguments of `incircle bench`.
#[derive(Debug, Args)]
pub struct BenchArguments {
    /// Sets (default: the five distributions of the literature, and the lattice)
    #[arg(value_name = "SET", value_parser = distribution_parser())]
    pub sets: Vec<Distribution>,
    /// Points of a set, including duplicates, which are then removed
    #[arg(
        short,
        value_name = "N",
        default_value_t = 4096,
        value_parser = whole_number(1, u32::MAX),
        allow_negative_numbers = true
    )]
    pub n: u32,
    /// Triangulate JOBS generated sets, 1 to 1,000,000, each with its own seed, as one batch
    ///
    /// The time runs from the first word sent to the last triangle received. The default core is
    /// `--config full`. All sets together have at most 67,108,864 points.
    #[arg(
        long,
        value_name = "JOBS",
        value_parser = whole_number(1, 1_000_000),
        allow_negative_numbers = true,
        verbatim_doc_comment
    )]
    pub batch: Option<u32>,
    /// Bits of a coordinate, 1 to 31 (default: 16)
    #[arg(long, value_name = "BITS", value_parser = whole_number(1, 31), allow_negative_numbers = true)]
    pub coord_bits: Option<u32>,
    /// Seed; one seed gives the same points on every machine
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    #[command(flatten)]
    pub backend: BackendArguments,
    #[command(flatten)]
    pub job: JobArguments,
    /// Clock frequency in MHz for times (default: the board's, or 125)
    ///
    /// Cycles are counted; the frequency is assumed.
    #[arg(long, value_parser = mhz_from, allow_negative_numbers = true)]
    pub mhz: Option<f64>,
    /// Print all rows as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
}
