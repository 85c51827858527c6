//! The triangle record.

/// A triangle record: vertex ids counter-clockwise; `n[k]` is the record across the edge opposite `v[k]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Record {
    /// Vertex ids; one of them is the infinite vertex in a ghost.
    pub v: [u32; 3],
    /// Neighbour record ids.
    pub n: [u32; 3],
}

impl Record {
    /// The slot whose link equals `id`; the triangulation of a sphere has at most one.
    #[inline]
    pub fn slot_of(&self, id: u32) -> usize {
        // Branch-free: links differ, and the callers follow links that lead back.
        usize::from(self.n[1] == id) | usize::from(self.n[2] == id) << 1
    }

    /// Vertices and links rotated so that slot `s` comes first.
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
