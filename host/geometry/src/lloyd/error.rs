//! The reasons why points cannot be relaxed.

use super::density::DensityError;
use crate::{cpu, voronoi};

/// The reasons why points cannot be relaxed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The points have no mesh.
    #[error(transparent)]
    Mesh(#[from] cpu::Error),
    /// The points or the clip have no cells.
    #[error(transparent)]
    Cells(#[from] voronoi::Error),
    /// The density is that of another clip.
    #[error(transparent)]
    Density(#[from] DensityError),
}
