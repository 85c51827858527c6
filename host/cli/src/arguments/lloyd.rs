//! The arguments of `incircle lloyd`.

use std::num::NonZeroU32;
use std::path::PathBuf;

use clap::Args;

use super::points::{GridArguments, ReadArguments};
use super::voronoi::{rectangle_from, Rectangle};
use crate::formats::SetFormat;
use crate::values::whole_number;

/// The arguments of `incircle lloyd`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("end").args(["iterations", "until_still"]).required(true))]
pub struct LloydArguments {
    /// Files of points, in the format of their extensions; '-' is CSV from standard input
    ///
    /// Several files are one set, whose points are numbered in this order.
    #[arg(required = true, value_name = "POINTS")]
    pub points: Vec<PathBuf>,
    /// File for the points at their new places, in their order: .csv, .xyz, .node or .npy
    #[arg(short, long, value_name = "POINTS")]
    pub output: PathBuf,
    /// Format of the new points
    ///
    /// Without this option the extension of the file chooses the format.
    #[arg(long, value_enum)]
    pub format: Option<SetFormat>,
    /// The most steps: in each, every point moves to the centroid of its cell
    #[arg(long, value_name = "N", value_parser = whole_number(1, 1_000_000))]
    pub iterations: Option<u32>,
    /// Do steps until no point moves, or points go round, at most 100,000
    #[arg(long)]
    pub until_still: bool,
    /// Clip the cells to this rectangle: two opposite corners 'X0,Y0,X1,Y1' (default: around the points)
    #[arg(
        long,
        value_name = "RECTANGLE",
        value_parser = rectangle_from,
        allow_hyphen_values = true,
        conflicts_with = "clip_to"
    )]
    pub clip: Option<Rectangle>,
    /// Clip the cells to the polygon in this file
    ///
    /// The file is GeoJSON with one polygon, perhaps with holes, or has the corners as points, in order.
    #[arg(long, value_name = "POLYGON", verbatim_doc_comment)]
    pub clip_to: Option<PathBuf>,
    /// Let points gather where this image is dark: a PNG, JPEG or PGM file
    ///
    /// The image is stretched over the smallest rectangle around the clip, its uppermost row at the largest y.
    #[arg(long, value_name = "IMAGE")]
    pub density: Option<PathBuf>,
    /// Threads (default: all processors); the places do not depend on them
    #[arg(long, value_name = "N")]
    pub threads: Option<NonZeroU32>,
    #[command(flatten)]
    pub read: ReadArguments,
    #[command(flatten)]
    pub grid: GridArguments,
    /// Print a report of the run as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// Print only errors
    #[arg(short, long)]
    pub quiet: bool,
}
