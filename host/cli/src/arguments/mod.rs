//! The arguments of the command.

mod backend;
mod generate;
mod interpolate;
mod job;
mod lloyd;
mod plan;
mod points;
mod replay;
mod tile;
mod voronoi;

use std::net::SocketAddrV4;
use std::path::{Path, PathBuf};

use clap::{Args, Parser, Subcommand};
use incircle::serial::Address;
use incircle_testkit::Distribution;

use crate::failure::Failure;
use crate::formats::MeshFormat;
use crate::help;
use crate::values::{
    bytes_from, distribution_parser, mhz_from, network_from, port_from, readable_format_parser, whole_number,
};

pub use backend::{BackendArguments, ConfigName};
pub use generate::GenerateArguments;
pub use interpolate::{InterpolateArguments, MethodName, OutsideName, ValueFormat};
pub use job::JobArguments;
pub use lloyd::LloydArguments;
pub use plan::{Crossings, PlanArguments};
pub use points::{GridArguments, ReadArguments};
pub use replay::ReplayArguments;
pub use tile::{JoinArguments, LocalArguments, SplitArguments, TileArguments, TileCommand};
pub use voronoi::{Rectangle, VoronoiArguments};

/// Exact Delaunay triangulation: one canonical answer, in software or hardware
#[derive(Debug, Parser)]
#[command(name = "incircle", version, after_help = help::ALL, after_long_help = help::ALL_LONG)]
pub struct Cli {
    /// The subcommand with its arguments.
    #[command(subcommand)]
    pub command: Command,
}

/// The subcommands of the command.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Triangulate a file of points
    #[command(after_help = help::TRIANGULATE, after_long_help = help::TRIANGULATE_LONG)]
    Triangulate(Box<TriangulateArguments>),
    /// Check that a mesh is the canonical Delaunay triangulation of its points
    ///
    /// Only the triangles are checked, as indices into POINTS. Everything else in the mesh file is
    /// ignored: the vertices of OBJ and PLY; the points, hull and duplicates of JSON.
    /// If 'triangulate' had --quantize, --coord-bits, --class, --bounds or --array, give the same here.
    #[command(
        verbatim_doc_comment,
        override_usage = "incircle verify [OPTIONS] <POINTS>... <MESH>",
        after_help = help::VERIFY,
        after_long_help = help::VERIFY_LONG
    )]
    Verify(VerifyArguments),
    /// Make a set of points, or a script for 'replay'
    #[command(after_help = help::GENERATE, after_long_help = help::GENERATE_LONG)]
    Generate(GenerateArguments),
    /// Measure a back end on generated sets, with a row of a table for each set
    ///
    /// The columns of a core, in this order:
    /// - clock cycles per insertion, and the time of all insertions at --mhz;
    /// - triangles visited by walks, and conflict tests, both per insertion;
    /// - attempts aborted, priorities taken, and retries at a root, in all;
    /// - shares of the cycles in which visits were issued, records were written, commits worked,
    ///   and locks were released;
    /// - cycles of one insertion: least, median, 99th percentile, most. Median and percentile are
    ///   upper bounds, at most an eighth above the true value.
    ///
    /// For a board there is also the time of a job of n points as a line t = c + m n, fitted to four
    /// sizes of each set. For the back ends 'cpu' and 'model' the table has times on this machine,
    /// the best of three runs.
    #[command(verbatim_doc_comment, after_help = help::BENCH, after_long_help = help::BENCH_LONG)]
    Bench(BenchArguments),
    /// Triangulate a set in tiles over files: larger than the memory, or on many machines
    ///
    /// 'split' cuts the set into tiles, 'local' triangulates one of them, 'join' makes one mesh of
    /// all. The mesh is the one of 'triangulate', byte for byte.
    #[command(verbatim_doc_comment, after_help = help::TILE, after_long_help = help::TILE_LONG)]
    Tile(TileArguments),
    /// Carry out a script of changes and questions on a mesh that lives
    ///
    /// The back ends 'cpu' and 'model' make all changes and answer all questions. Any other only makes
    /// the mesh at the end, from the points that live then; the bytes are the same.
    #[command(verbatim_doc_comment, after_help = help::REPLAY, after_long_help = help::REPLAY_LONG)]
    Replay(ReplayArguments),
    /// Compute the Voronoi cells of a file of points, exactly
    ///
    /// The cell of a point is the region that is nearest to it. Cells are clipped to a rectangle or to
    /// a polygon; without one, JSON has unbounded cells with the directions of their rays, and the
    /// other formats clip to the smallest rectangle around the points. The points and the corners of
    /// the clip must lie on a lattice of up to 31 bits; --quantize fit rounds them onto one.
    #[command(verbatim_doc_comment, after_help = help::VORONOI, after_long_help = help::VORONOI_LONG)]
    Voronoi(VoronoiArguments),
    /// Work out values between points, such as heights: at places of a file, or on a grid
    ///
    /// The value of a point is its z, or a column of CSV that --value names. Values between points are
    /// linear on the triangles of the mesh, or means of the natural neighbours.
    #[command(verbatim_doc_comment, after_help = help::INTERPOLATE, after_long_help = help::INTERPOLATE_LONG)]
    Interpolate(InterpolateArguments),
    /// Spread points evenly: move each to the centroid of its Voronoi cell, again and again
    ///
    /// The result has the same bytes on every machine and with any number of threads. Points move on a
    /// finer lattice, so theirs must leave 8 of 31 bits spare; --quantize fit rounds them onto one.
    #[command(verbatim_doc_comment, after_help = help::LLOYD, after_long_help = help::LLOYD_LONG)]
    Lloyd(LloydArguments),
    /// Describe a back end: version, coordinates, capacity, contexts
    #[command(after_help = help::INFO, after_long_help = help::INFO_LONG)]
    Info(InfoArguments),
    /// List the serial ports and the PCIe cards of this machine, or the devices on the network
    #[command(after_help = help::DEVICES)]
    Devices(DevicesArguments),
    /// Print a completion script for a shell
    #[command(after_help = help::COMPLETIONS, after_long_help = help::COMPLETIONS_LONG)]
    Completions(CompletionsArguments),
    /// Print a page for 'man', of the command or of a subcommand
    #[command(after_help = help::MAN, after_long_help = help::MAN_LONG)]
    Man(ManArguments),
}

/// The arguments of `incircle triangulate`.
#[derive(Debug, Args)]
pub struct TriangulateArguments {
    /// Files of points, in the format of their extensions; '-' is CSV from standard input
    ///
    /// Several files are one set, whose points are numbered in this order.
    #[arg(required = true, value_name = "POINTS")]
    pub points: Vec<PathBuf>,
    /// File for the mesh, in the format of its extension
    ///
    /// '-' is standard output and needs --format.
    #[arg(short, long, value_name = "MESH")]
    pub output: PathBuf,
    /// Mesh format
    ///
    /// Without this option the extension of the file chooses the format.
    #[arg(long, value_enum)]
    pub format: Option<MeshFormat>,
    #[command(flatten)]
    pub read: ReadArguments,
    #[command(flatten)]
    pub grid: GridArguments,
    #[command(flatten)]
    pub backend: BackendArguments,
    #[command(flatten)]
    pub job: JobArguments,
    #[command(flatten)]
    pub plan: PlanArguments,
    /// Write the edges of the mesh into this file as well, in the format .edge of Shewchuk's Triangle
    ///
    /// The marker of an edge is 0, or one more than the number of a constraint that it is a piece of.
    #[arg(long, value_name = "FILE.edge")]
    pub edges: Option<PathBuf>,
    /// Write the neighbours of the triangles into this file as well, in the format .neigh
    #[arg(long, value_name = "FILE.neigh")]
    pub neighbors: Option<PathBuf>,
    #[command(flatten)]
    pub large: LargeArguments,
    /// Record a waveform of the back end 'sim' in this file, for small sets
    ///
    /// The file has every signal of the simulated core at every clock, so it is large and slow to
    /// write.
    #[arg(long, value_name = "FILE.vcd", verbatim_doc_comment)]
    pub trace: Option<PathBuf>,
    /// Record this job alone, the first being 1; a set in parts has several
    #[arg(long, value_name = "K", requires = "trace", value_parser = clap::value_parser!(u64).range(1..))]
    pub trace_job: Option<u64>,
    /// Print a report of the run as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// Print only errors
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Print times and counters as well
    #[arg(short, long)]
    pub verbose: bool,
}

impl TriangulateArguments {
    /// Whether an option asks for constraints, a domain, or lists of edges or neighbours.
    pub fn asks_for_plan(&self) -> bool {
        self.plan.is_given() || self.edges.is_some() || self.neighbors.is_some()
    }
}

/// The choices for a set that is larger than the memory.
#[derive(Debug, Args)]
pub struct LargeArguments {
    /// Memory that the run may take, from 32M on, such as 300M or 2G: the set is cut into tiles
    ///
    /// The tiles and the triangles lie in files. The mesh is the same. The points must lie on a
    /// lattice of up to 32 bits, and the mesh is written as npy, csv or ele. Without this option a
    /// set of npy, csv, xyz or LiDAR files that does not fit the free memory is cut into tiles.
    #[arg(long, value_name = "BYTES", value_parser = bytes_from, verbatim_doc_comment)]
    pub memory: Option<u64>,
    /// Folder for the files of a set in tiles (default: the folder of the mesh)
    ///
    /// The files take about 25 bytes for each point of an even set.
    #[arg(long, value_name = "DIR")]
    pub scratch: Option<PathBuf>,
    /// Go on with the files of a run that did not end
    #[arg(long)]
    pub resume: bool,
    /// Write the triangles of a set in tiles as they come, which needs no sort: npy, csv and ele only
    #[arg(long)]
    pub unordered: bool,
}

impl LargeArguments {
    /// Whether an option says that the set is cut into tiles.
    pub fn is_wanted(&self) -> bool {
        self.memory.is_some() || self.scratch.is_some() || self.resume || self.unordered
    }
}

/// The arguments of `incircle verify`.
#[derive(Debug, Args)]
pub struct VerifyArguments {
    /// Files of points, and then the file of the mesh
    ///
    /// Several files of points are one set, as in 'triangulate'. Standard input is '-': points in
    /// CSV, or a mesh of the format that --format names.
    #[arg(required = true, value_name = "FILE", verbatim_doc_comment)]
    files: Vec<PathBuf>,
    /// POINTS is a script of 'replay': check the mesh of the points that live at its end
    #[arg(long, conflicts_with_all = ["from", "classes", "bounds", "array", "quantize", "coord_bits"])]
    pub script: bool,
    #[command(flatten)]
    pub read: ReadArguments,
    #[command(flatten)]
    pub plan: PlanArguments,
    /// Take the triangles in any order, as 'triangulate --unordered' writes them
    #[arg(long)]
    pub unordered: bool,
    /// Mesh format
    ///
    /// Without this option the extension of the file chooses the format.
    #[arg(long, value_parser = readable_format_parser())]
    pub format: Option<MeshFormat>,
    #[command(flatten)]
    pub grid: GridArguments,
    /// Memory that the check may take, from 32M on, such as 300M or 2G: the rest lies in files
    ///
    /// The first defect is the same. The points must lie on a lattice of up to 32 bits, and the mesh
    /// must be a file of npy, csv or ele. Constraints and scripts are checked in memory only.
    #[arg(
        long,
        value_name = "BYTES",
        value_parser = bytes_from,
        conflicts_with_all = ["script", "quantize", "coord_bits"],
        verbatim_doc_comment
    )]
    pub memory: Option<u64>,
    /// Folder for the files of a check with --memory (default: the folder of the mesh)
    ///
    /// They take about 44 bytes for each point of an even set, and have no names on Unix.
    #[arg(long, value_name = "DIR", requires = "memory")]
    pub scratch: Option<PathBuf>,
    /// Print the result as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// Print only errors
    #[arg(short, long)]
    pub quiet: bool,
}

impl VerifyArguments {
    /// The files of points, and the file of the mesh, which is the last one.
    ///
    /// # Errors
    /// There is only one file.
    pub fn files(&self) -> Result<(&[PathBuf], &Path), Failure> {
        match &self.files[..] {
            [points @ .., mesh] if !points.is_empty() => Ok((points, mesh)),
            _ => Err(Failure::usage("one file is given: give the files of points, and then the file of the mesh")),
        }
    }
}

/// The arguments of `incircle bench`.
#[derive(Debug, Args)]
pub struct BenchArguments {
    /// Sets (default: the five distributions of the literature, and the lattice)
    #[arg(value_name = "SET", value_parser = distribution_parser())]
    pub sets: Vec<Distribution>,
    /// Points of a set, including duplicates, which are then removed
    #[arg(short, value_name = "N", default_value_t = 4096, value_parser = whole_number(1, u32::MAX))]
    pub n: u32,
    /// Triangulate JOBS generated sets, each with its own seed, as one batch
    ///
    /// The time runs from the first word sent to the last triangle received. The default core is
    /// `--config full`. All sets together have at most 67,108,864 points.
    #[arg(
        long,
        value_name = "JOBS",
        value_parser = whole_number(1, 1_000_000),
        verbatim_doc_comment
    )]
    pub batch: Option<u32>,
    /// Bits of a coordinate, 1 to 31 (default: 16)
    #[arg(long, value_name = "BITS", value_parser = whole_number(1, 31))]
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
    #[arg(long, value_parser = mhz_from)]
    pub mhz: Option<f64>,
    /// Print all rows as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
}

/// The arguments of `incircle info`.
#[derive(Debug, Args)]
pub struct InfoArguments {
    #[command(flatten)]
    pub backend: BackendArguments,
    /// Board at this serial port, the same as --backend serial:PORT
    #[arg(short, long, value_name = "PORT", value_parser = port_from, conflicts_with_all = ["backend", "config"])]
    pub port: Option<Address>,
}

/// The arguments of `incircle devices`.
#[derive(Debug, Args)]
pub struct DevicesArguments {
    /// Ask at every port and card whether an incircle core is there
    ///
    /// The question sends a few bytes to whatever is connected to a port, takes up to four seconds
    /// for each port, and resets a card that nobody uses.
    #[arg(short, long, verbatim_doc_comment)]
    pub greet: bool,
    /// List the devices on the network instead: those that answer a greeting to all
    ///
    /// The greeting goes to 255.255.255.255, or to the address that is given: the broadcast address of another
    /// network, or a single device. It takes a second.
    #[arg(
        long,
        value_name = "ADDRESS[:PORT]",
        value_parser = network_from,
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "255.255.255.255",
        conflicts_with = "greet"
    )]
    pub network: Option<SocketAddrV4>,
}

/// The arguments of `incircle completions`.
#[derive(Debug, Args)]
pub struct CompletionsArguments {
    /// Shell
    #[arg(value_enum)]
    pub shell: clap_complete::Shell,
}

/// The arguments of `incircle man`.
#[derive(Debug, Args)]
pub struct ManArguments {
    /// Subcommand, such as 'triangulate' or 'tile split'; without one, the page of the whole command
    #[arg(value_name = "SUBCOMMAND")]
    pub path: Vec<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_consistent() {
        use clap::CommandFactory;
        Cli::command().debug_assert();
    }
}
