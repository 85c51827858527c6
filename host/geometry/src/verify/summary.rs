//! What the validator counted.

use alloc::vec::Vec;

/// What the validator counted in a right mesh.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct VerifySummary {
    /// Points given.
    pub points: usize,
    /// Distinct points.
    pub distinct: usize,
    /// Points that fell onto an earlier one.
    pub duplicates: usize,
    /// Triangles.
    pub triangles: usize,
    /// Edges, each counted once.
    pub edges: usize,
    /// Edges whose four points lie on one circle, decided by the tie rule.
    pub ties: usize,
    /// The hull in canonical form, as [`Mesh::hull`](crate::Mesh::hull).
    pub hull: Vec<u32>,
    /// All points on one line, or fewer than three distinct ones.
    pub collinear: bool,
}
