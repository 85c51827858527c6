//! Points and a clip of the caller on one grid.
#![allow(unsafe_code)] // pointers of the caller

use std::ffi::c_void;

use incircle::voronoi::Clip;
use incircle::{GridSet, GridSetError, PlanePoint, Quantize, MAX_POINTS};

use crate::border::{copied, look_for_memory};
use crate::status::{Failure, Outcome, INCIRCLE_ARGUMENT, INCIRCLE_CAPACITY, INCIRCLE_INPUT};

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

/// The corners of a clip of the caller, and how many of them each ring has if there are several.
pub(crate) struct Border {
    pub corners: *const c_void,
    pub corner_count: usize,
    counts: Vec<usize>,
}

impl Border {
    /// A clip without holes.
    pub fn of_corners(corners: *const c_void, corner_count: usize) -> Self {
        Self { corners, corner_count, counts: Vec::new() }
    }

    /// A clip of several rings, whose corners lie one behind the other.
    ///
    /// # Safety
    /// A pointer to counts that is not null has as many of them.
    pub unsafe fn of_rings(corners: *const c_void, counts: *const usize, ring_count: usize) -> Outcome<Self> {
        // SAFETY: the caller promises the counts.
        let counts: Vec<usize> = unsafe { copied(counts.cast(), ring_count, "ring_counts") }?;
        let corner_count = counts.iter().fold(0, |sum: usize, &count| sum.saturating_add(count));
        if corner_count > MAX_POINTS {
            let text = format!("the rings have {corner_count} corners, but a clip has at most {MAX_POINTS}");
            return Err(Failure::new(INCIRCLE_CAPACITY, text));
        }
        Ok(Self { corners, corner_count, counts })
    }

    /// The clip that these corners of a set make.
    pub fn clip(&self, set: &GridSet) -> Outcome<Clip> {
        let clip = if self.counts.is_empty() { set.clip() } else { set.clip_with_holes(&self.counts) };
        Ok(clip?)
    }
}

/// Points and the corners of a clip on one grid with spare bits.
///
/// # Safety
/// Both pointers are null, or have as many points.
pub(crate) unsafe fn laid<P: PlanePoint>(
    (points, count): (*const c_void, usize),
    border: &Border,
    spare: u32,
    quantize: u32,
) -> Outcome<GridSet> {
    let how = how(quantize)?;
    // SAFETY: the caller promises the points.
    let (points, corners) =
        unsafe { (copied::<P>(points, count, "points")?, copied::<P>(border.corners, border.corner_count, "clip")?) };
    if corners.len() == 1 && border.counts.is_empty() {
        return Err(Failure::new(INCIRCLE_INPUT, "the clip has 1 corner: give two of a rectangle, or three or more"));
    }
    look_for_memory((points.len() + corners.len()) * BYTES_OF_A_CELL)?;
    Ok(GridSet::of(&points, &corners, spare, how)?)
}
