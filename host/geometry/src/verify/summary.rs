//! The counts of a mesh that the validator accepted.

use alloc::vec::Vec;

/// The counts of a mesh that [`verify`](fn@crate::verify) accepted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct VerifySummary {
    /// Number of points given.
    pub points: usize,
    /// Number of distinct points.
    pub distinct: usize,
    /// Number of points with the coordinates of an earlier one.
    pub duplicates: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// Number of edges, each counted once.
    pub edges: usize,
    /// Number of edges that the tie rule decides, because the four points of their two triangles lie on one circle.
    pub ties: usize,
    /// The hull in canonical form, as in [`Mesh::hull`](crate::Mesh::hull).
    pub hull: Vec<u32>,
    /// Whether there are fewer than three distinct points, or all lie on one line.
    pub collinear: bool,
}
