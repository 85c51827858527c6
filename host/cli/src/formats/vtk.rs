//! Legacy VTK, ascii: an unstructured grid of triangles, which can only be written.
//!
//! Source: "VTK file formats", version 3.0 of the legacy format.

use std::io::{self, Write};

use crate::formats::mesh_view::MeshView;

/// The number of the cell type triangle in VTK.
const VTK_TRIANGLE: u8 = 5;

/// Writes all input points, at height 0 if they have no z, and the triangles.
pub fn write_mesh(mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
    let triangles = mesh.triangles.len();
    writeln!(out, "# vtk DataFile Version 3.0")?;
    writeln!(out, "Delaunay triangulation by incircle")?;
    writeln!(out, "ASCII\nDATASET UNSTRUCTURED_GRID")?;
    writeln!(out, "POINTS {} double", mesh.points.len())?;
    for ([x, y], z) in mesh.positions() {
        writeln!(out, "{x} {y} {z}")?;
    }
    // A cell takes four numbers: the number of its corners and the corners.
    writeln!(out, "CELLS {triangles} {}", 4 * triangles)?;
    for [a, b, c] in mesh.triangles {
        writeln!(out, "3 {a} {b} {c}")?;
    }
    writeln!(out, "CELL_TYPES {triangles}")?;
    for _ in mesh.triangles {
        writeln!(out, "{VTK_TRIANGLE}")?;
    }
    Ok(())
}
