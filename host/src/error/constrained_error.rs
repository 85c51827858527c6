//! The error of a job with constraints.

use incircle_geometry::constraints;

use super::Error;

/// Why points and constraints have no mesh.
///
/// ```
/// use incircle::constraints::{Error, Plan};
/// use incircle::{ConstrainedError, Device, Options};
///
/// // The diagonals of a square cross where there is no point.
/// let (points, diagonals) = ([[0, 0], [8, 0], [8, 8], [0, 8]], [[0, 2], [1, 3]]);
/// let mut device = Device::open("cpu")?;
/// let refused = device.session()?.triangulate_constrained(&points, &Plan::new(&diagonals), &Options::default());
/// assert!(matches!(refused, Err(ConstrainedError::Plan(Error::Crossing { constraints: [0, 1], .. }))));
/// # Ok::<(), incircle::Error>(())
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ConstrainedError {
    /// The points have no mesh, or the device failed.
    #[error(transparent)]
    Job(#[from] Error),
    /// The constraints or the domain have no mesh.
    #[error(transparent)]
    Plan(#[from] constraints::Error),
}
