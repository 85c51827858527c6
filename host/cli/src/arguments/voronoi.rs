//! The arguments of `incircle voronoi`.

use std::path::PathBuf;

use clap::Args;

use super::points::{GridArguments, ReadArguments};
use crate::cells::CellFormat;
use crate::number;

/// Two opposite corners of a rectangle, as four numbers in the text of the user.
#[derive(Clone, Debug)]
pub struct Rectangle(pub [String; 4]);

/// Parses two opposite corners of a rectangle. Numbers stay as they are written, because they count exactly.
pub(super) fn rectangle_from(text: &str) -> Result<Rectangle, String> {
    let numbers: Vec<String> = text.split(',').map(|part| part.trim().to_owned()).collect();
    let is_number = |part: &String| number::parse(part.as_bytes()).is_some_and(|it| it.nearest().value.is_finite());
    match <[String; 4]>::try_from(numbers) {
        Ok(numbers) if numbers.iter().all(is_number) => Ok(Rectangle(numbers)),
        _ => Err("give four numbers 'X0,Y0,X1,Y1': two opposite corners of a rectangle".to_owned()),
    }
}

/// The arguments of `incircle voronoi`.
#[derive(Debug, Args)]
pub struct VoronoiArguments {
    /// Files of points, in the format of their extensions; '-' is CSV from standard input
    ///
    /// Several files are one set, whose points are numbered in this order.
    #[arg(required = true, value_name = "POINTS")]
    pub points: Vec<PathBuf>,
    /// File for the cells: .geojson, .json or .svg; '-' is standard output and needs --format
    #[arg(short, long, value_name = "CELLS")]
    pub output: PathBuf,
    /// Format of the cells
    ///
    /// Without this option the extension of the file chooses the format.
    #[arg(long, value_enum)]
    pub format: Option<CellFormat>,
    /// Clip the cells to this rectangle: two opposite corners 'X0,Y0,X1,Y1'
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
