//! The file formats, a file each, which reads and writes its format.

pub mod csv;
pub mod curve;
pub mod ele;
pub mod geojson;
pub mod json;
mod mesh_view;
pub mod node;
pub mod npy;
pub mod obj;
pub mod ply;
mod set;
pub mod svg;
mod triangle;
pub mod vtk;
pub mod xyz;

use std::io::{self, Write};

use clap::ValueEnum;

use crate::failure::Failure;
use crate::points::PointTable;

pub use mesh_view::MeshView;
pub use set::SetFormat;

/// Formats that points are read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PointFormat {
    /// Rows `x,y`, header optional
    Csv,
    /// Rows `x y [z]`
    Xyz,
    /// Shewchuk's Triangle, .node
    Node,
    /// Vertices of a Wavefront OBJ
    Obj,
    /// Vertices of a PLY, ascii or binary
    Ply,
    /// Points of GeoJSON
    Geojson,
    /// The list `points` of a JSON mesh, or GeoJSON
    Json,
}

impl PointFormat {
    /// The format of files with this extension.
    pub fn of_extension(extension: &str) -> Option<Self> {
        Some(match extension.to_ascii_lowercase().as_str() {
            "csv" | "tsv" => Self::Csv,
            "xyz" => Self::Xyz,
            "node" => Self::Node,
            "obj" => Self::Obj,
            "ply" => Self::Ply,
            "geojson" => Self::Geojson,
            "json" => Self::Json,
            _ => return None,
        })
    }

    /// Reads all points from the bytes of a file. Every wrong value is refused with its place.
    pub fn read(self, bytes: &[u8]) -> Result<PointTable, Failure> {
        match self {
            Self::Csv => csv::read_points(bytes),
            Self::Xyz => xyz::read_points(bytes),
            Self::Node => node::read_points(bytes),
            Self::Obj => obj::read_points(bytes),
            Self::Ply => ply::read_points(bytes),
            Self::Geojson => geojson::read_points(bytes),
            Self::Json => json::read_points(bytes),
        }
    }
}

/// Formats that meshes are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MeshFormat {
    /// Shewchuk's Triangle, .ele: `N 3 0`, then `id a b c`, counted from 0
    Ele,
    /// Wavefront OBJ
    Obj,
    /// PLY, ascii
    Ply,
    /// Legacy VTK, ascii
    Vtk,
    /// GeoJSON with a polygon for each triangle
    Geojson,
    /// Points, triangles, hull and duplicates
    Json,
    /// Rows `a,b,c`
    Csv,
    /// A picture
    Svg,
}

impl MeshFormat {
    /// The format of files with this extension.
    pub fn of_extension(extension: &str) -> Option<Self> {
        Some(match extension.to_ascii_lowercase().as_str() {
            "ele" => Self::Ele,
            "obj" => Self::Obj,
            "ply" => Self::Ply,
            "vtk" => Self::Vtk,
            "geojson" => Self::Geojson,
            "json" => Self::Json,
            "csv" => Self::Csv,
            "svg" => Self::Svg,
            _ => return None,
        })
    }

    /// Whether a mesh can be read back from the format.
    pub fn is_readable(self) -> bool {
        !matches!(self, Self::Vtk | Self::Geojson | Self::Svg)
    }

    /// Writes a mesh in this format.
    pub fn write(self, mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Ele => ele::write_mesh(mesh, out),
            Self::Obj => obj::write_mesh(mesh, out),
            Self::Ply => ply::write_mesh(mesh, out),
            Self::Vtk => vtk::write_mesh(mesh, out),
            Self::Geojson => geojson::write_mesh(mesh, out),
            Self::Json => json::write_mesh(mesh, out),
            Self::Csv => csv::write_mesh(mesh, out),
            Self::Svg => svg::write_mesh(mesh, out),
        }
    }

    /// Reads the triangles of a mesh as they stand in the file. Only their form is checked.
    pub fn read(self, bytes: &[u8]) -> Result<Vec<[u32; 3]>, Failure> {
        match self {
            Self::Ele => ele::read_mesh(bytes),
            Self::Obj => obj::read_mesh(bytes),
            Self::Ply => ply::read_mesh(bytes),
            Self::Json => json::read_mesh(bytes),
            Self::Csv => csv::read_mesh(bytes),
            Self::Vtk | Self::Geojson | Self::Svg => Err(Failure::usage(
                "a mesh can be read back from ele, obj, ply, json and csv only: write it in one of them",
            )),
        }
    }
}

/// The extension of a path; empty if there is none.
pub fn extension(path: &std::path::Path) -> &str {
    path.extension().and_then(|extension| extension.to_str()).unwrap_or_default()
}
