//! Input files: their bytes, their names, their formats.

use std::io::Read;
use std::path::Path;

use crate::failure::{printable, Failure};
use crate::formats::{extension, MeshFormat, PointFormat};
use crate::points::PointTable;

/// Whether the path is `-`, which stands for standard input or output.
pub fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Reads all points of a file or of standard input. The format is `from`, or else the one of the extension, or
/// CSV for standard input.
pub fn read_points(path: &Path, from: Option<PointFormat>) -> Result<PointTable, Failure> {
    let format = match from {
        Some(format) => format,
        None if is_standard(path) => PointFormat::Csv,
        None => PointFormat::of_extension(extension(path)).ok_or_else(|| {
            let name = name(path);
            Failure::usage(format!(
                "{name}: the extension names no format of points: add --from csv, xyz, node, obj, ply, geojson or json"
            ))
        })?,
    };
    let bytes = read_bytes(path)?;
    format.read(&bytes).map_err(|failure| failure.in_file(name(path)))
}

/// Reads the triangles of a mesh file. The format is `format`, or else the one of the extension.
pub fn read_mesh(path: &Path, format: Option<MeshFormat>) -> Result<Vec<[u32; 3]>, Failure> {
    let format = format.or_else(|| MeshFormat::of_extension(extension(path)));
    let format = format.ok_or_else(|| {
        let (name, why) = (name(path), no_format(path));
        Failure::usage(format!("{name}: {why}: add --format ele, obj, ply, json or csv"))
    })?;
    let bytes = read_bytes(path)?;
    format.read(&bytes).map_err(|failure| failure.in_file(name(path)))
}

/// The reason why a mesh of this name needs `--format`, for a message.
pub fn no_format(path: &Path) -> &'static str {
    if is_standard(path) {
        "a mesh that has no file name needs a format"
    } else {
        "the extension names no format of meshes"
    }
}

/// The name of a file for messages.
pub fn name(path: &Path) -> String {
    if is_standard(path) {
        "standard input".to_owned()
    } else {
        printable(&path.display().to_string())
    }
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let result = if is_standard(path) {
        let mut bytes = Vec::new();
        std::io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes)
    } else {
        std::fs::read(path)
    };
    result.map_err(|error| Failure::input(format!("{} cannot be read: {error}", name(path))))
}
