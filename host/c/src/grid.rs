//! Points and a clip of the caller on one grid.
#![allow(unsafe_code)] // pointers of the caller

use std::ffi::c_void;

use incircle::{GridSet, GridSetError, PlanePoint, Quantize};

use crate::border::{copied, look_for_memory};
use crate::status::{Failure, Outcome, INCIRCLE_ARGUMENT, INCIRCLE_INPUT};

/// Points and clip are taken exactly: they must lie on a lattice of few enough bits.
pub const INCIRCLE_EXACT: u32 = 0;
/// Points and clip are rounded onto a grid.
pub const INCIRCLE_QUANTIZE: u32 = 1;

/// The most bytes a point that a diagram, or a step of a relaxation, needs.
const BYTES_OF_A_CELL: usize = 700;

impl From<GridSetError> for Failure {
    fn from(error: GridSetError) -> Self {
        match error {
            GridSetError::Points(error) => error.into(),
            error => Self::new(INCIRCLE_INPUT, error.to_string()),
        }
    }
}

/// The way in which points are laid onto a grid.
fn how(quantize: u32) -> Outcome<Option<Quantize>> {
    match quantize {
        INCIRCLE_EXACT => Ok(None),
        INCIRCLE_QUANTIZE => Ok(Some(Quantize::Fit)),
        other => {
            let text = format!("quantize is {other}: give INCIRCLE_EXACT or INCIRCLE_QUANTIZE");
            Err(Failure::new(INCIRCLE_ARGUMENT, text))
        }
    }
}

/// Points and the corners of a clip on one grid with spare bits.
///
/// # Safety
/// Both pointers are null, or have as many points.
pub(crate) unsafe fn laid<P: PlanePoint>(
    (points, count): (*const c_void, usize),
    (clip, corner_count): (*const c_void, usize),
    spare: u32,
    quantize: u32,
) -> Outcome<GridSet> {
    let how = how(quantize)?;
    // SAFETY: the caller promises the points.
    let (points, corners) =
        unsafe { (copied::<P>(points, count, "points")?, copied::<P>(clip, corner_count, "clip")?) };
    if corners.len() == 1 {
        return Err(Failure::new(INCIRCLE_INPUT, "the clip has 1 corner: give two of a rectangle, or three or more"));
    }
    look_for_memory((points.len() + corners.len()) * BYTES_OF_A_CELL)?;
    Ok(GridSet::of(&points, &corners, spare, how)?)
}
