//! The arguments of the command.

mod backend;
mod bench;
mod generate;
mod interpolate;
mod job;
mod lloyd;
mod plan;
mod points;
mod replay;
mod tile;
mod triangulate;
mod verify;
mod voronoi;

use std::net::SocketAddrV4;

use clap::{Args, Parser, Subcommand};
use incircle::serial::Address;

use crate::help;
use crate::values::{network_from, port_from};

pub use backend::{BackendArguments, ConfigName};
pub use bench::BenchArguments;
pub use generate::GenerateArguments;
pub use interpolate::{InterpolateArguments, MethodName, OutsideName, ValueFormat};
pub use job::JobArguments;
pub use lloyd::LloydArguments;
pub use plan::{Crossings, PlanArguments};
pub use points::{GridArguments, ReadArguments};
pub use replay::ReplayArguments;
pub use tile::{JoinArguments, LocalArguments, SplitArguments, TileArguments, TileCommand};
pub use triangulate::TriangulateArguments;
pub use verify::VerifyArguments;
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
    /// With the back ends 'model', 'clock' for a core of one engine, and 'sim', boards and cards whose
    /// core has runs, the device makes all changes and answers all questions. With any other the CPU does
    /// that, and the device makes the mesh at the end, from the points that live then; the bytes are the same.
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
