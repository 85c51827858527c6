//! The result of a job.

use super::report::Report;
use incircle_geometry::Point;
use incircle_geometry::{Duplicate, Mesh};

/// The result of a job: the mesh, and a report on how it came about.
///
/// Compare meshes, not solutions: the meshes of one set of points are equal on every device, but reports differ, since
/// they have times. Programs that need only the mesh take it out: `session.triangulate(&points)?.mesh`.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Solution<P = Point> {
    /// The Delaunay triangulation of the points.
    pub mesh: Mesh<P>,
    /// Counts, times, and the device that did the job.
    pub report: Report,
}

impl<P> Default for Solution<P> {
    fn default() -> Self {
        Self { mesh: Mesh::default(), report: Report::default() }
    }
}

/// The parts of a solution without the points, which the caller of the back end keeps until the job is done.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) hull: Vec<u32>,
    pub(crate) duplicates: Vec<Duplicate>,
    pub(crate) report: Report,
}

impl Answer {
    /// The solution for these points, with the counts of the mesh in its report.
    pub(crate) fn with<P>(self, points: Vec<P>) -> Solution<P> {
        let Self { triangles, hull, duplicates, report } = self;
        Solution::of(Mesh::new(points, triangles, hull, duplicates), report)
    }
}

impl<P> Solution<P> {
    /// The same solution for points of another type at the same places.
    pub(crate) fn with_points<Q>(self, points: Vec<Q>) -> Solution<Q> {
        let Mesh { triangles, hull, duplicates, .. } = self.mesh;
        Solution { mesh: Mesh::new(points, triangles, hull, duplicates), report: self.report }
    }

    /// A solution of `mesh` and `report`. The counts in the report are replaced by those of the mesh.
    pub(crate) fn of(mesh: Mesh<P>, report: Report) -> Self {
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
