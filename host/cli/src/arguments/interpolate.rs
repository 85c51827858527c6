//! The arguments of `incircle interpolate`.

use std::num::NonZeroU32;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use incircle::interpolate::{Method, Outside};
use incircle::DeviceAddress;

use super::points::ReadArguments;
use crate::values::backend_parser;

/// A format of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ValueFormat {
    /// Rows x,y,value below a header, in the order of the places
    Csv,
    /// An array of NumPy: the values in the order of the places, or rows of a grid from the lowest y
    Npy,
    /// An ASCII grid of Esri, for --grid
    Asc,
    /// A GeoTIFF of doubles, for --grid
    Tif,
    /// Lines, for --contours
    Geojson,
}

impl ValueFormat {
    /// The format of files with this extension.
    pub fn of_extension(extension: &str) -> Option<Self> {
        Some(match extension.to_ascii_lowercase().as_str() {
            "csv" => Self::Csv,
            "npy" => Self::Npy,
            "asc" => Self::Asc,
            "tif" | "tiff" => Self::Tif,
            "geojson" => Self::Geojson,
            _ => return None,
        })
    }
}

/// How values between points are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// The plane through the corners of the triangle
    Linear,
    /// Natural neighbours, weighted by edge length over distance
    Laplace,
    /// Natural neighbours, weighted by area
    Sibson,
}

impl MethodName {
    /// The method of the library.
    pub fn method(self) -> Method {
        match self {
            Self::Linear => Method::Linear,
            Self::Laplace => Method::Laplace,
            Self::Sibson => Method::Sibson,
        }
    }
}

/// The value outside the hull of the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum OutsideName {
    /// Not a number
    Nan,
    /// The value of the nearest point
    Nearest,
}

impl OutsideName {
    /// The choice of the library.
    pub fn outside(self) -> Outside {
        match self {
            Self::Nan => Outside::Nan,
            Self::Nearest => Outside::Nearest,
        }
    }
}

/// The arguments of `incircle interpolate`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("places").args(["at", "grid", "contours"]).required(true))]
pub struct InterpolateArguments {
    /// File of points with values, in the format of its extension; '-' is CSV from standard input
    pub points: PathBuf,
    /// Column of a CSV file with the values: a name of its header, or a number from 1 on (default: z)
    #[arg(long, value_name = "COLUMN")]
    pub value: Option<String>,
    /// File of the places at which values are wanted, in the format of its extension
    #[arg(long, value_name = "PLACES")]
    pub at: Option<PathBuf>,
    /// Values at all multiples of this step within the box of the points
    #[arg(long, value_name = "STEP", allow_hyphen_values = true)]
    pub grid: Option<String>,
    /// Lines of equal value instead of values: one for each multiple of this step
    #[arg(long, value_name = "STEP", allow_hyphen_values = true, conflicts_with_all = ["method", "outside"])]
    pub contours: Option<String>,
    /// File for the values: .csv, .npy, .asc, .tif or .geojson; '-' is standard output and needs --format
    #[arg(short, long, value_name = "VALUES")]
    pub output: PathBuf,
    /// Format of the values
    ///
    /// Without this option the extension of the file chooses the format.
    #[arg(long, value_enum)]
    pub format: Option<ValueFormat>,
    /// How values between points are made
    #[arg(long, value_enum, default_value = "linear")]
    pub method: MethodName,
    /// The value outside the hull of the points
    #[arg(long, value_enum, default_value = "nan")]
    pub outside: OutsideName,
    /// Back end that says in which triangle each place lies: 'cpu' (default) or 'model'
    ///
    /// The values have the same bytes. A device serves --method linear alone, with points and places on
    /// a lattice that it takes.
    #[arg(long, value_parser = backend_parser(), verbatim_doc_comment)]
    pub backend: Option<DeviceAddress>,
    /// Threads (default: all processors); the values do not depend on them
    #[arg(long, value_name = "N")]
    pub threads: Option<NonZeroU32>,
    #[command(flatten)]
    pub read: ReadArguments,
    /// Print a report of the run as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// Print only errors
    #[arg(short, long)]
    pub quiet: bool,
}
