//! The arguments of `incircle verify`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::plan::PlanArguments;
use super::points::{GridArguments, ReadArguments};
use crate::failure::Failure;
use crate::formats::MeshFormat;
use crate::values::{bytes_from, readable_format_parser};

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
    /// The files take about 44 bytes for each point of an even set, and have no names on Unix.
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
