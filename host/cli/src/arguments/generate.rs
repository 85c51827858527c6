//! The arguments of `incircle generate`.

use std::path::PathBuf;

use clap::Args;
use incircle::Order;

use crate::formats::SetFormat;
use crate::numbers::NumberKind;
use crate::values::{made_parser, order_parser, whole_number, Made};

/// The arguments of `incircle generate`.
#[derive(Debug, Args)]
pub struct GenerateArguments {
    /// Set of points, or script
    #[arg(value_parser = made_parser())]
    pub set: Made,
    /// Number of points; in a script, of those that live at a time
    ///
    /// A set has up to 4294967294 points, and with --order up to 536870911.
    #[arg(short, value_name = "N", value_parser = whole_number(0, u32::MAX - 1))]
    pub n: u32,
    /// Kind of numbers of the coordinates
    #[arg(long, value_enum, default_value_t = NumberKind::Whole)]
    pub numbers: NumberKind,
    /// Bits of a coordinate, counted in steps, 1 to 31 (default: 16; for decimal 28, for f32 24)
    ///
    /// --numbers f32 takes up to 24 bits. Doubles have no steps, so --numbers double refuses --bits.
    #[arg(long, value_parser = whole_number(1, 31), verbatim_doc_comment)]
    pub bits: Option<u32>,
    /// Seed; one seed gives the same points on every machine
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Frames of 'drift' and 'tracks' (default: 60)
    #[arg(long, value_name = "F", value_parser = whole_number(0, u32::MAX))]
    pub frames: Option<u32>,
    /// Commands of 'churn' (default: 20 for each point)
    #[arg(long, value_name = "C", value_parser = whole_number(0, u32::MAX))]
    pub commands: Option<u32>,
    /// Insertion order
    ///
    /// The file has the points in this order. Default: as generated.
    #[arg(long, value_parser = order_parser())]
    pub order: Option<Order>,
    /// File for the points: .csv, .xyz, .node or .npy; '-' is CSV on standard output
    ///
    /// With --order, a file .svg is a drawing of the order: a line from each point to the next. A
    /// script is text, in a file of any other name.
    #[arg(short, long, value_name = "POINTS", verbatim_doc_comment)]
    pub output: PathBuf,
    /// Point format
    ///
    /// Without this option the extension of the file chooses the format.
    #[arg(long, value_enum)]
    pub format: Option<SetFormat>,
}
