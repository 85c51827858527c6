//! Writing PLY: all input points, at height 0 if they have no z, and the triangles.
//!
//! The ascii form has the numbers of the input as they are. The binary form, little endian, has doubles, so whole
//! numbers that no double holds are refused before the work. A decimal is written as the nearest double, which is what
//! readers make of its text as well.

use std::io::{self, Write};

use crate::failure::Failure;
use crate::formats::mesh_view::MeshView;
use crate::number::Coordinate;
use crate::points::{PointTable, DOUBLES};

/// The name of the ascii form in the header.
const ASCII: &str = "ascii";

/// Writes the ascii form.
pub fn write_ascii(mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
    write_header(mesh, ASCII, out)?;
    for ([x, y], z) in mesh.positions() {
        writeln!(out, "{x} {y} {z}")?;
    }
    for [a, b, c] in mesh.triangles {
        writeln!(out, "3 {a} {b} {c}")?;
    }
    Ok(())
}

/// Writes the binary form.
pub fn write_binary(mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
    write_header(mesh, "binary_little_endian", out)?;
    let heights = mesh.points.heights();
    for (index, &[x, y]) in mesh.points.doubles().iter().enumerate() {
        let z = heights.get(index).copied().unwrap_or(0.0);
        out.write_all([x, y, z].map(f64::to_le_bytes).as_flattened())?;
    }
    for triangle in mesh.triangles {
        out.write_all(&[3])?;
        out.write_all(triangle.map(u32::to_le_bytes).as_flattened())?;
    }
    Ok(())
}

fn write_header(mesh: &MeshView<'_>, form: &str, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "ply\nformat {form} 1.0\ncomment Delaunay triangulation by incircle")?;
    if form == ASCII && mesh.points.needs_mark() {
        writeln!(out, "comment {DOUBLES}")?;
    }
    writeln!(out, "element vertex {}", mesh.points.len())?;
    writeln!(out, "property double x\nproperty double y\nproperty double z")?;
    writeln!(out, "element face {}", mesh.triangles.len())?;
    writeln!(out, "property list uchar int vertex_indices\nend_header")
}

/// Refuses whole numbers that no double equals, because the binary form would change them.
pub fn check_binary(points: &PointTable) -> Result<(), Failure> {
    for index in 0..points.len() {
        for axis in [0, 1] {
            let coordinate = points.coordinate(index, axis);
            if !is_kept(coordinate) {
                let place = points.place(index, axis);
                return Err(Failure::input(format!(
                    "{place}: {coordinate} is no double, and ply-binary holds doubles: choose a text format, such as \
                     ply or obj"
                )));
            }
        }
    }
    Ok(())
}

/// Whether a double equals the coordinate, or the coordinate is a decimal with a fraction, which may be rounded.
fn is_kept(coordinate: Coordinate) -> bool {
    match coordinate {
        Coordinate::Decimal { steps, digits: 0 } => steps as f64 as i128 == steps,
        Coordinate::Decimal { .. } | Coordinate::Double(_) => true,
    }
}
