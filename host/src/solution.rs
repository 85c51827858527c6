//! What a session gives: the mesh, and what the job says about itself.

use std::ops::Deref;

use incircle_geometry::Mesh;

use crate::report::Report;

/// The mesh of a job and its report. Fields and methods of the mesh can be used as if they were here.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Solution {
    /// The canonical Delaunay triangulation.
    pub mesh: Mesh,
    /// Counts, times, device.
    pub report: Report,
}

impl Deref for Solution {
    type Target = Mesh;

    fn deref(&self) -> &Mesh {
        &self.mesh
    }
}
