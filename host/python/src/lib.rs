//! The compiled half of the Python package `incircle`.
//!
//! The Python half, in the folder `incircle`, is what users see: it checks shapes and types, and documents every call.
//! This half only takes arrays of five types of numbers, and gives arrays back. It raises the exceptions of
//! `incircle._errors`, by their names.

mod cells;
mod constrained;
mod coordinate;
mod error;
mod job;
mod living;
mod memory;
mod points;
mod surface;
mod watch;

use pyo3::prelude::*;

#[pymodule]
mod _native {
    #[pymodule_export]
    use super::cells::{spread, voronoi};
    #[pymodule_export]
    use super::constrained::{constrained, verify_plan};
    #[pymodule_export]
    use super::job::{halfedges, library, neighbors, triangulate, verify};
    #[pymodule_export]
    use super::living::Living;
    #[pymodule_export]
    use super::surface::Surface;
}
