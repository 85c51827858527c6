//! The record of a triangle or ghost triangle.

/// A triangle record. The vertices are counter-clockwise, and `n[k]` is the record across the edge opposite `v[k]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Record {
    /// Vertex ids. In a ghost triangle one of them is the infinite vertex.
    pub v: [u32; 3],
    /// Record ids of the neighbours.
    pub n: [u32; 3],
}

impl Record {
    /// The slot of the neighbour `id`. Since the mesh with its ghost triangles is a triangulated sphere, there is at
    /// most one such slot.
    #[inline]
    pub fn slot_of(&self, id: u32) -> usize {
        // The code has no branches. Neighbours differ from each other, and callers ask only for
        // ids that are neighbours.
        usize::from(self.n[1] == id) | usize::from(self.n[2] == id) << 1
    }

    /// The record with vertices and neighbours rotated so that slot `s` comes first.
    #[inline]
    pub fn rotated(&self, s: usize) -> Record {
        let turn = |c: [u32; 3]| match s {
            0 => c,
            1 => [c[1], c[2], c[0]],
            _ => [c[2], c[0], c[1]],
        };
        Record { v: turn(self.v), n: turn(self.n) }
    }
}
