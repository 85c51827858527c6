//! The formats in which cells are written.

use clap::ValueEnum;

/// A format of Voronoi cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CellFormat {
    /// A feature for each cell, with its point, area and neighbours
    Geojson,
    /// Cells by the numbers of their Voronoi vertices, or clipped cells with their corners
    Json,
    /// A picture
    Svg,
}

impl CellFormat {
    /// The format of files with this extension.
    pub fn of_extension(extension: &str) -> Option<Self> {
        Some(match extension.to_ascii_lowercase().as_str() {
            "geojson" => Self::Geojson,
            "json" => Self::Json,
            "svg" => Self::Svg,
            _ => return None,
        })
    }
}
