//! What becomes of a job.

use super::report::Report;
use incircle_geometry::Point;
use incircle_geometry::{Duplicate, Mesh};

/// A mesh, and how it came about.
///
/// Meshes of one set of points are equal, on whatever device; the reports are not, since they have times.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Solution {
    /// The mesh.
    pub mesh: Mesh,
    /// Counts, times, device.
    pub report: Report,
}

/// A solution without the points, which the caller keeps.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) hull: Vec<u32>,
    pub(crate) duplicates: Vec<Duplicate>,
    pub(crate) report: Report,
}

impl Answer {
    /// The solution for these points, in whose report the counts are those of the mesh.
    pub(crate) fn with(self, points: Vec<Point>) -> Solution {
        let Self { triangles, hull, duplicates, report } = self;
        Solution::of(Mesh::new(points, triangles, hull, duplicates), report)
    }
}

impl Solution {
    /// A mesh, and a report whose counts are those of the mesh.
    pub(crate) fn of(mesh: Mesh, report: Report) -> Self {
        let report = Report {
            points: mesh.points.len(),
            distinct: mesh.points.len() - mesh.duplicates.len(),
            duplicates: mesh.duplicates.len(),
            triangles: mesh.triangles.len(),
            hull: mesh.hull.len(),
            collinear: mesh.is_collinear(),
            ..report
        };
        Self { mesh, report }
    }
}
