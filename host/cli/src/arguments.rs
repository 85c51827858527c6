//! The arguments of the command.

use std::num::NonZeroU32;
use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Parser, Subcommand, ValueEnum};
use incircle::serial::Address;
use incircle::{DeviceAddress, Options, Order, ProgressListener, Quantize};
use incircle_testkit::Distribution;

use crate::failure::{failure_of, Failure};
use crate::formats::{MeshFormat, PointFormat};
use crate::values::{
    backend_parser, distribution_parser, mhz_from, order_parser, port_from, quantize_from, readable_format_parser,
    seconds_from,
};

/// Exact Delaunay triangulation: one canonical answer, in software or hardware
#[derive(Debug, Parser)]
#[command(name = "incircle", version, after_help = EXIT_CODES)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 ok, 1 verification failed, 2 usage, 3 bad input, 4 device not found or no \
permission, 5 link error, 6 device error or timeout, 7 capacity, 130 interrupted.";

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Triangulate a file of points
    Triangulate(TriangulateArguments),
    /// Check that the triangles of a mesh are the canonical Delaunay triangulation of its points
    ///
    /// Only the triangles are checked, as indices into POINTS: whatever else the mesh file holds (vertices of OBJ and PLY;
    /// points, hull and duplicates of JSON) is not compared.
    Verify(VerifyArguments),
    /// Make a set of points
    Generate(GenerateArguments),
    /// Measure a back end on generated sets: a table with a row per set
    ///
    /// For a core: clock cycles per insertion and the time they take at --mhz, triangles visited by walks and conflict tests (both per
    /// insertion), attempts given up, priorities taken, root retries; how much of the insertion its ports were busy (visits
    /// issued, records written, commits at work, locks released); and how many cycles an insertion took. Median and
    /// 99th percentile are upper bounds, at most an eighth above the true value. For a board also the time of a job as a line over its points,
    /// t = c + m n, fitted to four sizes of each set. For the software model: host time, the best of three runs.
    Bench(BenchArguments),
    /// Say what a back end is
    Info(InfoArguments),
    /// List the serial ports and the PCIe cards, and say who is there
    Devices(DevicesArguments),
    /// Print a completion script for a shell
    Completions(CompletionsArguments),
}

/// How coordinates come onto the grid.
#[derive(Debug, Args)]
pub struct GridArguments {
    /// Bits of a coordinate: points lie on the grid 0 to 2^BITS - 1 (default: 16)
    #[arg(long, value_name = "BITS", value_parser = clap::value_parser!(u32).range(8..=31))]
    pub coord_bits: Option<u32>,
    /// Lay the points onto the grid: 'fit' (the bounding box fills it, one scale), or 'SCALE' or 'SCALE,X0,Y0' for
    /// (x - X0) * SCALE; integers on the grid are untouched without it, others are fitted
    #[arg(long, value_name = "HOW", value_parser = quantize_from, allow_hyphen_values = true)]
    pub quantize: Option<Quantize>,
}

/// Which device works.
#[derive(Clone, Debug, Args)]
pub struct BackendArguments {
    /// Who triangulates: 'cpu', the fast engine on the processor; 'model', the software model of the core; 'clock', its model clock by
    /// clock; 'sim', the core's Verilog in Verilator (needs a build with `--features sim`); 'serial:PORT', a board, such as
    /// serial:/dev/ttyUSB0 or serial:/dev/ttyUSB0?baud=12000000; 'pcie:N', the card N in a PCIe slot, or pcie:DIR. Choices follow a question
    /// mark: cpu?threads=2, model?coord-bits=20&capacity=5000, clock?config=full (default: 'triangulate' takes 'cpu', or 'model' if --order or
    /// --contexts is given; others take 'model')
    #[arg(long, value_parser = backend_parser())]
    pub backend: Option<DeviceAddress>,
    /// Threads of the back end 'cpu' (default: as many as there are processors, fewer for small sets)
    #[arg(long, value_name = "N")]
    pub threads: Option<NonZeroU32>,
    /// Configuration of the core, for 'clock' and 'sim' (default: the smallest that holds the points)
    #[arg(long, value_enum)]
    pub config: Option<ConfigName>,
}

impl BackendArguments {
    /// The back end asked for, or else this one.
    pub fn or(&self, default: &str) -> Result<DeviceAddress, Failure> {
        let default = || default.parse().map_err(|error| failure_of(&error));
        self.backend.clone().map_or_else(default, Ok)
    }
}

/// How the device works.
#[derive(Debug, Args)]
pub struct JobArguments {
    /// Contexts that work, that is insertions in flight at once: it changes the time, never the mesh (default: all that the
    /// back end has)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub contexts: Option<u32>,
    /// Order in which points are inserted: it changes the time, never the mesh (default: brio-hilbert)
    #[arg(long, value_parser = order_parser())]
    pub order: Option<Order>,
    /// Seconds that the device may take
    #[arg(long, value_name = "SECONDS", value_parser = seconds_from)]
    pub timeout: Option<Duration>,
}

impl JobArguments {
    /// The order asked for, or else the best.
    pub fn order(&self) -> Order {
        self.order.unwrap_or_default()
    }

    /// The choices for a job, of which this listener hears how far it is.
    pub fn options<'a>(&self, listener: ProgressListener<'a>) -> Options<'a> {
        Options::default().timeout(self.timeout).order(self.order()).contexts(self.contexts).progress(listener)
    }

    /// What is asked of a job makes sense only for devices that insert one point after the other.
    pub fn wants_insertion(&self) -> bool {
        self.order.is_some() || self.contexts.is_some()
    }
}

/// Arguments of `triangulate`.
#[derive(Debug, Args)]
pub struct TriangulateArguments {
    /// Points: csv, xyz, node, obj, ply, geojson or json; '-' is CSV from standard input
    pub points: PathBuf,
    /// The mesh: ele, obj, ply, vtk, geojson, json, csv or svg; '-' is standard output and needs --format
    #[arg(short, long, value_name = "MESH")]
    pub output: PathBuf,
    /// Format of the mesh (default: by extension)
    #[arg(long, value_enum)]
    pub format: Option<MeshFormat>,
    /// Format of the points (default: by extension)
    #[arg(long, value_enum)]
    pub from: Option<PointFormat>,
    #[command(flatten)]
    pub grid: GridArguments,
    #[command(flatten)]
    pub backend: BackendArguments,
    #[command(flatten)]
    pub job: JobArguments,
    /// Record every signal of the simulated core, clock by clock, in this waveform file: slow and large, for small sets
    #[arg(long, value_name = "FILE.vcd")]
    pub trace: Option<PathBuf>,
    /// Print one JSON object about the run on standard output
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Print times and counters
    #[arg(short, long)]
    pub verbose: bool,
}

/// Arguments of `verify`.
#[derive(Debug, Args)]
pub struct VerifyArguments {
    /// The points; '-' is CSV from standard input
    pub points: PathBuf,
    /// The mesh: ele, obj, ply, json or csv; '-' is standard input and needs --format
    pub mesh: PathBuf,
    /// Format of the points (default: by extension)
    #[arg(long, value_enum)]
    pub from: Option<PointFormat>,
    /// Format of the mesh (default: by extension)
    #[arg(long, value_parser = readable_format_parser())]
    pub format: Option<MeshFormat>,
    #[command(flatten)]
    pub grid: GridArguments,
    /// Print one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// Arguments of `generate`.
#[derive(Debug, Args)]
pub struct GenerateArguments {
    /// The set
    #[arg(value_parser = distribution_parser())]
    pub distribution: Distribution,
    /// Number of points, up to 536870911
    #[arg(short, value_name = "N")]
    pub n: u32,
    /// Bits of a coordinate
    #[arg(long, default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=31))]
    pub bits: u32,
    /// Seed: the same seed gives the same points on every machine
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Put the points into this order of insertion
    #[arg(long, value_parser = order_parser())]
    pub order: Option<Order>,
    /// The points: csv, xyz or node; '-' is CSV on standard output; svg, with --order, is a drawing of the order
    #[arg(short, long, value_name = "POINTS")]
    pub output: PathBuf,
}

/// Arguments of `bench`.
#[derive(Debug, Args)]
pub struct BenchArguments {
    /// The sets (default: the five distributions of the literature, and the lattice)
    #[arg(value_name = "SET", value_parser = distribution_parser())]
    pub sets: Vec<Distribution>,
    /// Points of a set; duplicates are removed before the device sees them
    #[arg(short, value_name = "N", default_value_t = 4096, value_parser = clap::value_parser!(u32).range(1..))]
    pub n: u32,
    /// Do so many jobs of such sets in one call, each with a seed of its own, and tell the time from the first word in to the last triangle
    /// out; a core is taken in the configuration full unless chosen. At most 67,108,864 points in all
    #[arg(long, value_name = "JOBS", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub batch: Option<u32>,
    /// Bits of a coordinate (default: 16)
    #[arg(long, value_name = "BITS", value_parser = clap::value_parser!(u32).range(1..=31))]
    pub coord_bits: Option<u32>,
    /// Seed of the sets: the same seed gives the same points on every machine
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    #[command(flatten)]
    pub backend: BackendArguments,
    #[command(flatten)]
    pub job: JobArguments,
    /// Clock frequency for which times are told, in MHz: cycles are counted, frequency is assumed (default: what a board says, or 125)
    #[arg(long, value_parser = mhz_from)]
    pub mhz: Option<f64>,
    /// Print one JSON object on standard output
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `info`.
#[derive(Debug, Args)]
pub struct InfoArguments {
    #[command(flatten)]
    pub backend: BackendArguments,
    /// The board at this serial port: the same as --backend serial:PORT
    #[arg(short, long, value_name = "PORT", value_parser = port_from, conflicts_with_all = ["backend", "config"])]
    pub port: Option<Address>,
}

/// Arguments of `devices`.
#[derive(Debug, Args)]
pub struct DevicesArguments {
    /// Ask at every port and card who is there. That sends a few bytes to whatever is connected to a port, for up to three seconds each,
    /// and resets a card that nobody uses
    #[arg(short, long)]
    pub greet: bool,
}

/// Arguments of `completions`.
#[derive(Debug, Args)]
pub struct CompletionsArguments {
    /// The shell
    #[arg(value_enum)]
    pub shell: clap_complete::Shell,
}

/// The named configurations of the core.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ConfigName {
    /// 8 points, 2 contexts
    Tiny,
    /// 1024 points, 4 contexts
    Small,
    /// 8192 points, 16 contexts
    Full,
    /// 16384 points, 24 contexts
    Large,
}

impl ConfigName {
    /// The configuration of this name.
    pub fn config(self) -> incircle_protocol::Config {
        match self {
            Self::Tiny => incircle_protocol::TINY,
            Self::Small => incircle_protocol::SMALL,
            Self::Full => incircle_protocol::FULL,
            Self::Large => incircle_protocol::LARGE,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_consistent() {
        use clap::CommandFactory;
        Cli::command().debug_assert();
    }

    #[test]
    fn every_configuration_has_its_name() {
        for name in ConfigName::value_variants() {
            let shown = name.to_possible_value().map(|value| value.get_name().to_owned());
            assert_eq!(shown.as_deref(), Some(name.config().name));
        }
    }
}
