//! The arguments of `incircle tile` and its verbs.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Subcommand};

use super::backend::BackendArguments;
use super::points::ReadArguments;
use crate::formats::MeshFormat;
use crate::help;
use crate::values::{bytes_from, seconds_from, whole_number};

/// The arguments of `incircle tile`.
#[derive(Debug, Args)]
pub struct TileArguments {
    /// The verb with its arguments.
    #[command(subcommand)]
    pub command: TileCommand,
}

/// The verbs of `incircle tile`.
#[derive(Debug, Subcommand)]
pub enum TileCommand {
    /// Cut a set into tiles, with one file for each
    #[command(after_help = help::SPLIT, after_long_help = help::SPLIT_LONG)]
    Split(SplitArguments),
    /// Triangulate one tile
    #[command(after_help = help::LOCAL, after_long_help = help::LOCAL_LONG)]
    Local(LocalArguments),
    /// Join all tiles to one mesh
    #[command(after_help = help::JOIN, after_long_help = help::JOIN_LONG)]
    Join(JoinArguments),
}

/// The arguments of `incircle tile split`.
#[derive(Debug, Args)]
pub struct SplitArguments {
    /// Files of points, which are one set: the points are numbered in this order
    ///
    /// The points must lie on a common lattice of up to 32 bits. The memory holds a piece of an
    /// .npy, CSV, XYZ, LAS or LAZ file, and all of any other file, one file at a time.
    #[arg(required = true, value_name = "POINTS", verbatim_doc_comment)]
    pub inputs: Vec<PathBuf>,
    /// Most points of a tile
    ///
    /// A tile takes about 130 bytes of memory for each point while it is triangulated. Only points
    /// at one place may be more.
    #[arg(long, value_name = "N", value_parser = whole_number(1, 500_000_000), verbatim_doc_comment)]
    pub points: u32,
    /// Folder for the tiles, which is made if it does not exist
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    #[command(flatten)]
    pub read: ReadArguments,
    /// Print a report as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// Print only errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// The arguments of `incircle tile local`.
#[derive(Debug, Args)]
pub struct LocalArguments {
    /// Folder of the tiles, and the number of the tile, from 0 on: 'DIR/K'
    #[arg(value_name = "DIR/K")]
    pub tile: PathBuf,
    #[command(flatten)]
    pub backend: BackendArguments,
    /// Seconds that the tile may take (default: 60, and 0.002 for each point)
    #[arg(long, value_name = "SECONDS", value_parser = seconds_from)]
    pub timeout: Option<Duration>,
    /// Print a report as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// Print only errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// The arguments of `incircle tile join`.
#[derive(Debug, Args)]
pub struct JoinArguments {
    /// Folder of the tiles
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// File for the mesh, in the format of its extension
    ///
    /// '-' is standard output and needs --format. Formats other than npy, csv and ele read the
    /// points again, and the memory must hold points and mesh.
    #[arg(short, long, value_name = "MESH", verbatim_doc_comment)]
    pub output: PathBuf,
    /// Mesh format
    ///
    /// Without this option the extension of the file chooses the format.
    #[arg(long, value_enum)]
    pub format: Option<MeshFormat>,
    /// Write the triangles in the order of the tiles, which needs no sort: npy, csv and ele only
    #[arg(long)]
    pub unordered: bool,
    /// Memory for triangles, such as 1G; borders come on top, and the rest is in the folder of the tiles
    #[arg(long, value_name = "BYTES", value_parser = bytes_from, default_value = "256M")]
    pub memory: u64,
    #[command(flatten)]
    pub read: ReadArguments,
    /// Print a report as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// Print only errors
    #[arg(short, long)]
    pub quiet: bool,
}
