//! The command line.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Exact Delaunay triangulation of one set of points on many machines, by MPI
#[derive(Debug, Parser)]
#[command(name = "incircle-mpi", version)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Triangulate the points of all inputs together: mpirun -n 8 incircle-mpi triangulate pieces/*.npy -o mesh
    Triangulate(TriangulateArguments),
}

#[derive(Args, Debug)]
pub struct TriangulateArguments {
    /// Arrays of NumPy that are not packed. Their points are one set, numbered in the order of the inputs
    #[arg(required = true, value_name = "IN")]
    pub inputs: Vec<PathBuf>,
    /// The folder for the mesh, a file for each process: 0.npy, 1.npy and so on. It must be new or empty
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// About so many points in a tile. The mesh does not depend on it [default: 16 to 32 tiles for each process]
    #[arg(long, value_name = "N")]
    pub points: Option<NonZeroUsize>,
    /// Print a summary as JSON on standard output
    #[arg(long)]
    pub json: bool,
    /// Show no progress and no summary
    #[arg(short, long)]
    pub quiet: bool,
}
