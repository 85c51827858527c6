//! The file formats, a file each, which reads and writes its format.

mod array;
mod blocks;
pub mod csv;
pub mod csv_pairs;
mod csv_rows;
pub mod curve;
pub mod edge;
pub mod ele;
pub mod geojson;
pub mod geojson_ring;
pub mod json;
mod json_text;
pub mod lidar;
mod mesh_view;
pub mod node;
pub mod npy;
pub mod npy_writer;
pub mod npz;
pub mod obj;
mod pieces;
mod plan;
pub mod ply;
mod ply_writer;
pub mod poly;
mod selection;
mod set;
pub mod svg;
mod triangle;
pub mod vtk;
pub mod wkt;
pub mod xyz;

use std::io::{self, Write};

use clap::ValueEnum;

use crate::failure::Failure;
use crate::input::Input;
use crate::points::PointTable;

pub use mesh_view::MeshView;
pub use pieces::{Take, TakeTriangle};
pub use plan::{PlanTable, Ring};
pub use selection::{Bounds, Selection};
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
    /// Shewchuk's Triangle, .poly: points and constraints
    Poly,
    /// Vertices of a Wavefront OBJ
    Obj,
    /// Vertices of a PLY, ascii or binary
    Ply,
    /// Points of GeoJSON
    Geojson,
    /// The list `points` of a JSON mesh, or GeoJSON
    Json,
    /// LAS, LAZ or COPC, from laser scanners
    Las,
    /// An array of NumPy, of shape (n, 2) or (n, 3)
    Npy,
    /// An archive of arrays of NumPy; see --array
    Npz,
    /// Points of WKT (well-known text)
    Wkt,
}

impl PointFormat {
    /// The format of files with this extension.
    pub fn of_extension(extension: &str) -> Option<Self> {
        Some(match extension.to_ascii_lowercase().as_str() {
            "csv" | "tsv" => Self::Csv,
            "xyz" => Self::Xyz,
            "node" => Self::Node,
            "poly" => Self::Poly,
            "obj" => Self::Obj,
            "ply" => Self::Ply,
            "geojson" => Self::Geojson,
            "json" => Self::Json,
            "las" | "laz" => Self::Las,
            "npy" => Self::Npy,
            "npz" => Self::Npz,
            "wkt" => Self::Wkt,
            _ => return None,
        })
    }

    /// The names of all formats, for a message.
    pub fn names() -> String {
        names_of(Self::value_variants().iter())
    }

    /// Reads the selected points of an input. Every wrong value is refused with its place, and more points than the
    /// memory of the input holds are refused while they are read.
    pub fn read(self, mut input: Input, selection: &Selection) -> Result<PointTable, Failure> {
        let memory = input.memory();
        match self {
            Self::Csv => csv::read_valued_points(&some_bytes(input)?, selection.value.as_deref(), memory),
            Self::Xyz => xyz::read_points(&some_bytes(input)?, memory),
            Self::Node => node::read_points(&some_bytes(input)?, memory),
            Self::Poly => Err(Failure::usage(
                "a .poly file has constraints, which only 'triangulate' and 'verify' take, from one file: give its \
                 .node file",
            )),
            Self::Obj => obj::read_points(&some_bytes(input)?, memory),
            Self::Ply => ply::read_points(&some_bytes(input)?, memory),
            Self::Geojson => geojson::read_points(&some_bytes(input)?, memory),
            Self::Json => json::read_points(&some_bytes(input)?, memory),
            Self::Las => lidar::read_points(input, selection),
            Self::Npy => npy::read_points(array::Source::of_input(&mut input)),
            Self::Npz => npz::read_points(input, selection.array.as_deref()),
            Self::Wkt => wkt::read_points(&some_bytes(input)?, memory),
        }
    }
}

impl PointFormat {
    /// Calls `take` with the coordinates of the selected points, in pieces. The memory holds one piece of CSV, XYZ, LAS
    /// and LAZ, and of an array that is not packed; all points of other files are one piece.
    ///
    /// # Errors
    /// As for [`read`](Self::read); a coordinate has no exact value that tiles take; or `take` fails.
    pub fn read_pieces(self, input: Input, selection: &Selection, take: Take<'_>) -> Result<(), Failure> {
        match self {
            Self::Csv => csv::read_pieces(input.without_end(), selection.value.as_deref(), take),
            Self::Xyz => xyz::read_pieces(input.without_end(), take),
            Self::Las => lidar::read_pieces(input, selection, take),
            Self::Npy => npy::read_pieces(input, take),
            _ => {
                let table = self.read(input, selection)?;
                table.check_exact()?;
                take(table.coordinates())
            }
        }
    }

    /// The most points that an input can have, as far as that is known without reading points: by the header of an
    /// array or a LAS file, and by the rows of a text. `None` for other formats, for packed inputs, and for headers
    /// that promise more points than the file has bytes.
    pub fn most_points(self, input: Input) -> Option<u64> {
        let bytes = input.size();
        match self {
            _ if bytes == 0 => None,
            Self::Csv | Self::Xyz => blocks::count_rows(input.without_end()).ok(),
            Self::Las => lidar::count_points(input).ok().filter(|&points| points <= bytes),
            Self::Npy => npy::count_points(input).ok(),
            _ => None,
        }
    }

    /// Whether files of the format are texts with a row for each point.
    pub fn has_rows(self) -> bool {
        matches!(self, Self::Csv | Self::Xyz)
    }

    /// Whether files of the format may hold constraints.
    pub fn may_constrain(self) -> bool {
        matches!(self, Self::Poly | Self::Geojson | Self::Json | Self::Wkt)
    }

    /// Reads the points and the constraints of an input. `beside` reads the points of a .poly file that has none of
    /// its own. Formats without constraints are an error.
    pub fn read_plan(
        self,
        input: Input,
        beside: &dyn Fn() -> Result<(PointTable, u32), Failure>,
    ) -> Result<PlanTable, Failure> {
        let memory = input.memory();
        match self {
            Self::Poly => poly::read_plan(&some_bytes(input)?, memory, beside),
            Self::Geojson => geojson::read_plan(&some_bytes(input)?, memory),
            Self::Json => json::read_plan(&some_bytes(input)?, memory),
            Self::Wkt => wkt::read_plan(&some_bytes(input)?, memory),
            _ => Err(Failure::usage("files of this format hold no constraints")),
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
    /// PLY, binary: doubles, little endian
    PlyBinary,
    /// Legacy VTK, ascii
    Vtk,
    /// GeoJSON with a polygon for each triangle
    Geojson,
    /// Points, triangles, hull and duplicates
    Json,
    /// Rows `a,b,c`
    Csv,
    /// An array of NumPy, of shape (m, 3) and type u4
    Npy,
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
            "npy" => Self::Npy,
            "svg" => Self::Svg,
            _ => return None,
        })
    }

    /// The names of the formats for which `is_named` holds, for a message.
    pub fn names(is_named: impl Fn(Self) -> bool) -> String {
        names_of(Self::value_variants().iter().filter(|format| is_named(**format)))
    }

    /// Whether a mesh can be read back from the format.
    pub fn is_readable(self) -> bool {
        !matches!(self, Self::Vtk | Self::Geojson | Self::Svg)
    }

    /// Refuses points whose coordinates the format would change.
    pub fn check_points(self, points: &PointTable) -> Result<(), Failure> {
        match self {
            Self::PlyBinary => ply_writer::check_binary(points),
            _ => Ok(()),
        }
    }

    /// Writes a mesh in this format.
    pub fn write(self, mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Ele => ele::write_mesh(mesh, out),
            Self::Obj => obj::write_mesh(mesh, out),
            Self::Ply => ply_writer::write_ascii(mesh, out),
            Self::PlyBinary => ply_writer::write_binary(mesh, out),
            Self::Vtk => vtk::write_mesh(mesh, out),
            Self::Geojson => geojson::write_mesh(mesh, out),
            Self::Json => json::write_mesh(mesh, out),
            Self::Csv => csv::write_mesh(mesh, out),
            Self::Npy => npy_writer::write_mesh(mesh, out),
            Self::Svg => svg::write_mesh(mesh, out),
        }
    }

    /// Whether the triangles of a mesh can be written and read one after the other.
    pub fn is_streamed(self) -> bool {
        matches!(self, Self::Npy | Self::Csv | Self::Ele)
    }

    /// Calls `take` with the triangles of a mesh as they stand in the file, which is read in pieces. `open` opens the
    /// file, twice for ELE. Only formats that [are streamed](Self::is_streamed) can be read so.
    ///
    /// # Errors
    /// As for [`read`](Self::read), or `take` fails.
    pub fn each_triangle(
        self,
        open: &dyn Fn() -> Result<Input, Failure>,
        take: TakeTriangle<'_>,
    ) -> Result<(), Failure> {
        match self {
            Self::Npy => npy::each_triangle(open()?, take),
            Self::Csv => csv::each_triangle(open()?, take),
            Self::Ele => ele::each_triangle(open()?, ele::base(open()?)?, take),
            _ => Err(Failure::usage("a mesh of this format is read as a whole: write npy, csv or ele")),
        }
    }

    /// Reads the triangles of a mesh as they stand in the file. Only their form is checked.
    pub fn read(self, mut input: Input) -> Result<Vec<[u32; 3]>, Failure> {
        let memory = input.memory();
        match self {
            Self::Ele => ele::read_mesh(&input.into_bytes()?, memory),
            Self::Obj => obj::read_mesh(&input.into_bytes()?, memory),
            Self::Ply | Self::PlyBinary => ply::read_mesh(&input.into_bytes()?, memory),
            Self::Json => json::read_mesh(&input.into_bytes()?, memory),
            Self::Csv => csv::read_mesh(&input.into_bytes()?, memory),
            Self::Npy => npy::read_mesh(array::Source::of_input(&mut input)),
            Self::Vtk | Self::Geojson | Self::Svg => {
                let readable = Self::names(Self::is_readable);
                Err(Failure::usage(format!("a mesh can be read back only from {readable}: write one of them")))
            }
        }
    }
}

/// All bytes of an input of points. An input without a byte is refused, because a failed download or a command that
/// ended early leaves such a file more often than somebody means a set without points.
fn some_bytes(input: Input) -> Result<Vec<u8>, Failure> {
    let bytes = input.into_bytes()?;
    if bytes.is_empty() {
        return Err(pieces::no_byte());
    }
    Ok(bytes)
}

/// The names of formats as a list, such as `csv, xyz or node`.
fn names_of<'a, F: ValueEnum + 'a>(formats: impl Iterator<Item = &'a F>) -> String {
    let names: Vec<_> = formats.filter_map(F::to_possible_value).map(|value| value.get_name().to_owned()).collect();
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} or {last}", others.join(", ")),
        None => String::new(),
    }
}
