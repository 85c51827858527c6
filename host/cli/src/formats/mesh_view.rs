//! Meshes as writers see them.

/// A mesh and the points it is of, as writers see it.
#[derive(Clone, Copy, Debug)]
pub struct MeshView<'a> {
    /// All input points, with the coordinates of the input file.
    pub points: &'a [[f64; 2]],
    /// Counter-clockwise triples of indices into `points`.
    pub triangles: &'a [[u32; 3]],
    /// The hull, counter-clockwise; without triangles the distinct points along their line.
    pub hull: &'a [u32],
    /// Pairs (duplicate, the lowest index with the same place).
    pub duplicates: &'a [[u32; 2]],
}

impl MeshView<'_> {
    /// The coordinates of a vertex. Vertices that do not exist (there are none in a mesh of the library) are the
    /// origin.
    pub fn position(&self, vertex: u32) -> [f64; 2] {
        self.points.get(vertex as usize).copied().unwrap_or_default()
    }
}
