//! The form in which writers get a mesh.

/// A mesh with the coordinates of its input file, for writers.
#[derive(Clone, Copy, Debug)]
pub struct MeshView<'a> {
    /// All input points, with the coordinates of the input file.
    pub points: &'a [[f64; 2]],
    /// Counter-clockwise triples of indices into `points`.
    pub triangles: &'a [[u32; 3]],
    /// The hull, counter-clockwise; without triangles the distinct points along their line.
    pub hull: &'a [u32],
    /// Pairs of a duplicate and the lowest index at the same place.
    pub duplicates: &'a [[u32; 2]],
}

impl MeshView<'_> {
    /// The coordinates of a vertex. A vertex that does not exist, which no mesh of the library has, is at the origin.
    pub fn position(&self, vertex: u32) -> [f64; 2] {
        self.points.get(vertex as usize).copied().unwrap_or_default()
    }
}
