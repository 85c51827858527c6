//! The arguments of `incircle replay`.

use std::path::PathBuf;

use clap::Args;

use super::backend::BackendArguments;
use super::job::JobArguments;
use crate::formats::MeshFormat;
use crate::script::MOST_FRAMES;
use crate::values::whole_number;

/// The arguments of `incircle replay`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("results").args(["output", "answers", "film"]).required(true).multiple(true))]
pub struct ReplayArguments {
    /// File of commands, a row each: insert X Y, delete I, move I X Y, locate X Y, nearest X Y
    ///
    /// Two more are constrain I J and unconstrain C. I and J are numbers of insertions, and C is that of
    /// a constraint, all counted from 0. Empty rows are skipped, and so is all that follows a '#'. '-' is
    /// standard input.
    #[arg(verbatim_doc_comment)]
    pub script: PathBuf,
    /// File for the mesh at the end, in the format of its extension
    ///
    /// The mesh names each point by the number of its insertion. '-' is standard output and needs
    /// --format.
    #[arg(short, long, value_name = "MESH", verbatim_doc_comment)]
    pub output: Option<PathBuf>,
    /// Mesh format
    ///
    /// Without this option the extension of the file chooses the format.
    #[arg(long, value_enum, requires = "output")]
    pub format: Option<MeshFormat>,
    /// File for the answers, a row for each question; '-' is standard output
    ///
    /// locate: 'vertex I', 'edge I J', 'triangle I J K', 'outside I J' or 'none'. nearest: 'I' or
    /// 'none'.
    #[arg(long, value_name = "FILE", verbatim_doc_comment)]
    pub answers: Option<PathBuf>,
    /// File for a film of the mesh: an animated SVG, for up to 2000 points at a time
    #[arg(long, value_name = "FILE.svg")]
    pub film: Option<PathBuf>,
    /// Most frames of the film (default: 120)
    ///
    /// There are fewer if the script has fewer commands, or if the film would have more than 400,000
    /// triangles.
    #[arg(
        long,
        value_name = "N",
        value_parser = whole_number(1, MOST_FRAMES),
        requires = "film",
        verbatim_doc_comment
    )]
    pub frames: Option<u32>,
    #[command(flatten)]
    pub backend: BackendArguments,
    #[command(flatten)]
    pub job: JobArguments,
    /// Print a report of the run as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// Print only errors
    #[arg(short, long)]
    pub quiet: bool,
}
