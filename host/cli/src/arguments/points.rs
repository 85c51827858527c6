//! The arguments that say which points are read, and onto which grid they are laid.

use clap::Args;
use incircle::Quantize;

use crate::failure::Failure;
use crate::formats::{Bounds, PointFormat, Selection};
use crate::values::{bounds_from, class_from, quantize_from, whole_number};

/// The format of a file of points, and which of its points are read.
#[derive(Clone, Debug, Args)]
pub struct ReadArguments {
    /// Point format
    ///
    /// Without this option the extension of the file chooses the format.
    #[arg(long, value_enum)]
    pub from: Option<PointFormat>,
    /// Take only LiDAR points of these classes, such as 2,9: whole numbers from 0 to 255
    ///
    /// The option is for LAS, LAZ and COPC. Class 2 is ground. Indices in the mesh count the points
    /// that were taken, in the order of the file.
    #[arg(
        long = "class",
        value_name = "CLASSES",
        value_delimiter = ',',
        value_parser = class_from,
        verbatim_doc_comment
    )]
    pub classes: Vec<u8>,
    /// Take only LiDAR points in this rectangle, edges included: 'X0,Y0,X1,Y1'
    ///
    /// The option is for LAS, LAZ and COPC. The numbers are coordinates of the file, the lowest x
    /// and y first. Indices in the mesh count the points that were taken, in the order of the file.
    #[arg(
        long,
        value_name = "RECTANGLE",
        value_parser = bounds_from,
        allow_hyphen_values = true,
        verbatim_doc_comment
    )]
    pub bounds: Option<Bounds>,
    /// Array of points in an .npz archive (default: the only array)
    #[arg(long, value_name = "NAME")]
    pub array: Option<String>,
}

impl ReadArguments {
    /// The arguments that read a whole file in the format of its extension.
    pub fn of_whole_file() -> Self {
        Self { from: None, classes: Vec::new(), bounds: None, array: None }
    }

    /// The points that the arguments select from a file of this format. An option that the format does not have is
    /// refused.
    pub fn selection(&self, format: PointFormat) -> Result<Selection, Failure> {
        let is_lidar = self.bounds.is_some() || !self.classes.is_empty();
        if is_lidar && format != PointFormat::Las {
            let option = if self.bounds.is_some() { "--bounds" } else { "--class" };
            return Err(Failure::usage(format!(
                "{option} selects points of LAS, LAZ and COPC files only: leave {option} out, and select the points of \
                 this file with another program"
            )));
        }
        if self.array.is_some() && format != PointFormat::Npz {
            return Err(Failure::usage("--array names an array of an .npz archive: leave it out for other formats"));
        }
        Ok(Selection { array: self.array.clone(), classes: self.classes.clone(), bounds: self.bounds, value: None })
    }
}

/// The grid onto which points are laid.
#[derive(Clone, Copy, Debug, Args)]
pub struct GridArguments {
    /// Bits of a coordinate of the grid of --quantize, 8 to 31 (default: 31, or 16 for a core)
    ///
    /// The grid is 0 to 2^BITS - 1. More bits round less. The back ends 'cpu' and 'model' take up
    /// to 31, a core 16.
    #[arg(long, value_name = "BITS", value_parser = whole_number(8, 31), verbatim_doc_comment)]
    pub coord_bits: Option<u32>,
    /// Round the points onto a grid: 'fit', 'SCALE' or 'SCALE,X0,Y0'
    ///
    /// 'fit' scales the bounding box to fill the grid, both axes alike. 'SCALE,X0,Y0' computes
    /// (x - X0) * SCALE and (y - Y0) * SCALE; 'SCALE' alone takes 0 for X0 and Y0.
    /// Without this option the points are triangulated as they stand in the file, and points that
    /// the back end cannot hold are an error.
    #[arg(
        long,
        value_name = "HOW",
        value_parser = quantize_from,
        allow_hyphen_values = true,
        verbatim_doc_comment
    )]
    pub quantize: Option<Quantize>,
}

impl GridArguments {
    /// The arguments. `--coord-bits` without `--quantize` is refused.
    pub fn checked(&self) -> Result<Self, Failure> {
        if self.coord_bits.is_some() && self.quantize.is_none() {
            return Err(Failure::usage(
                "--coord-bits sizes the grid of --quantize: give --quantize fit as well, or leave --coord-bits out",
            ));
        }
        Ok(*self)
    }
}
