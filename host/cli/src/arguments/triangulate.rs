//! The arguments of `incircle triangulate`.

use std::path::PathBuf;

use clap::Args;

use super::backend::BackendArguments;
use super::job::JobArguments;
use super::plan::PlanArguments;
use super::points::{GridArguments, ReadArguments};
use crate::formats::MeshFormat;
use crate::values::bytes_from;

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
