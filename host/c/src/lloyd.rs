//! Points spread evenly by Lloyd's relaxation.
#![allow(unsafe_code)] // functions that C calls

use std::ffi::c_void;
use std::num::NonZeroUsize;

use incircle::lloyd::{relax, relax_weighted, Density, End, Relaxed, Stop};
use incircle::voronoi::{self, Clip};
use incircle::{GridSetError, MAX_POINTS};

use crate::border::{copied, exclusive, give, look_for_memory, shared};
use crate::grid::{laid, Border};
use crate::mesh::of_type;
use crate::status::{guarded, Failure, Outcome, INCIRCLE_ARGUMENT, INCIRCLE_BUFFER};
use crate::status::{INCIRCLE_CAPACITY, INCIRCLE_CHOICE, INCIRCLE_INPUT};

/// All steps of a relaxation were done.
pub const INCIRCLE_ITERATIONS: u32 = 0;
/// No point moved in the last step of a relaxation.
pub const INCIRCLE_STILL: u32 = 1;
/// A state of a relaxation came again.
pub const INCIRCLE_CYCLE: u32 = 2;

/// Bits below the lattice that a relaxation needs for places between the points.
const SPARE_BITS: u32 = 8;
/// The bytes that a pixel of a density takes, with the copy that it is made of.
const BYTES_OF_A_PIXEL: usize = 20;

/// The choices for a relaxation. Set all to 0 and `size` to `sizeof(incircle_relaxation)` first.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incircle_relaxation {
    /// The size of this structure in bytes.
    pub size: usize,
    /// The most steps, 1 or more. A relaxation ends earlier if no point moves.
    pub iterations: u32,
    /// 1 to end also when a state comes again; else 0.
    pub until_still: u32,
    /// The most threads; 0 for one a processor.
    pub threads: u32,
    /// `INCIRCLE_EXACT`, or `INCIRCLE_QUANTIZE` to round onto a grid of 23 bits first.
    pub quantize: u32,
    /// x and y of the corners of the region to fill, in the type of numbers of the points: two opposite ones of a
    /// rectangle, or three or more of a simple polygon. Null stands for the smallest rectangle around the points.
    pub clip: *const c_void,
    /// The number of these corners.
    pub corner_count: usize,
    /// How many of the corners each ring has, if the clip is a polygon with holes: that around the polygon, then those
    /// of the holes, as for `incircle_diagram_new_with_holes`. Null stands for a clip without holes.
    pub ring_counts: *const usize,
    /// The number of rings, or 0.
    pub ring_count: usize,
    /// How densely points are to lie: `rows` rows of `columns` weights, stretched over the smallest rectangle around
    /// the clip, with the first row at the largest y as in images. A point moves to the centre of mass of its cell.
    /// Null stands for the same weight everywhere.
    pub density: *const u16,
    /// Weights in a row.
    pub columns: usize,
    /// Rows of weights.
    pub rows: usize,
}

/// The outcome of a relaxation.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incircle_relaxed {
    /// The steps that were done.
    pub iterations: u32,
    /// The reason why the relaxation ended: `INCIRCLE_ITERATIONS`, `INCIRCLE_STILL` or `INCIRCLE_CYCLE`.
    pub end: u32,
    /// The number of points that moved in the last step.
    pub moved: usize,
    /// The farthest that `INCIRCLE_QUANTIZE` moved a point along an axis; 0 if nothing was rounded.
    pub largest_error: f64,
}

/// Spreads `count` points evenly: each step moves every point to the centroid of its Voronoi cell inside the clip of
/// the choices. `points` has x and y of each, in the type of numbers `number`, such as `INCIRCLE_F64`. `places` gets
/// the new place of each point, in their order; the places are the same bytes on every machine and with any number of
/// threads. `relaxed` says what was done, and may be null.
///
/// Points and clip must lie on a lattice of up to 23 bits, or are rounded onto one by `INCIRCLE_QUANTIZE`. The status
/// is `INCIRCLE_INPUT` for points and clips that `incircle_diagram_new` refuses, for a rectangle around the points that
/// has no area, for rings whose corners are not `corner_count`, and for a density without weights or whose weights are
/// all 0. `places` has room for `room` points; with less room than points the status is `INCIRCLE_BUFFER`.
///
/// # Safety
/// The pointers of the choices are as described there, and the others point to what is said above.
#[no_mangle]
pub unsafe extern "C" fn incircle_lloyd(
    points: *const c_void,
    count: usize,
    number: u32,
    choices: *const incircle_relaxation,
    places: *mut [f64; 2],
    room: usize,
    relaxed: *mut incircle_relaxed,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        let choices = unsafe { shared(choices, "choices") }?;
        let stop = checked(choices)?;
        if room < count {
            let text = format!("the buffer has room for {room} items, but there are {count}: give a larger one");
            return Err(Failure::new(INCIRCLE_BUFFER, text));
        }
        // SAFETY: the same.
        let border = unsafe { border_of(choices) }?;
        let quantize = choices.quantize;
        // SAFETY: the same.
        let set = of_type!(number, P => unsafe { laid::<P>((points, count), &border, SPARE_BITS, quantize) })?;
        let clip = border.clip(&set)?;
        // SAFETY: the same.
        let density = unsafe { density_of(choices, &clip) }?;
        let (threads, most) = (NonZeroUsize::new(choices.threads as usize), std::thread::available_parallelism().ok());
        let threads = threads.or(most).unwrap_or(NonZeroUsize::MIN);
        let start = set.points().to_vec();
        let relaxed_points = match density {
            None => relax(start, &clip, stop, threads),
            Some(density) => relax_weighted(start, &clip, &density, stop, threads),
        };
        let Relaxed { points, iterations, moved, end } = relaxed_points.map_err(GridSetError::from)?;
        let found: Vec<[f64; 2]> = points.iter().map(|&point| set.restore(point)).collect();
        if count > 0 {
            // SAFETY: the same.
            unsafe { exclusive(places, "places") }?;
        }
        // SAFETY: the same; there is room, and a null pointer gets no places.
        unsafe { give(&found, places, room, &mut 0) }?;
        if !relaxed.is_null() {
            let largest_error = set.quantization().map_or(0.0, |quantization| quantization.largest_error);
            let end = number_of(end);
            // SAFETY: the same.
            *unsafe { exclusive(relaxed, "relaxed") }? = incircle_relaxed { iterations, end, moved, largest_error };
        }
        Ok(())
    })
}

/// The corners of the region to fill.
///
/// # Safety
/// The pointers of the choices are as described there.
unsafe fn border_of(choices: &incircle_relaxation) -> Outcome<Border> {
    let &incircle_relaxation { clip, corner_count, ring_counts, ring_count, .. } = choices;
    if ring_counts.is_null() && ring_count == 0 {
        return Ok(Border::of_corners(clip, corner_count));
    }
    // SAFETY: the caller promises the counts.
    let border = unsafe { Border::of_rings(clip, ring_counts, ring_count) }?;
    if border.corner_count != corner_count || ring_count == 0 {
        let counts = voronoi::Error::RingCounts { have: border.corner_count, corners: corner_count };
        return Err(GridSetError::from(counts).into());
    }
    Ok(border)
}

/// The density over a clip; `None` if there are no weights.
///
/// # Safety
/// The pointers of the choices are as described there.
unsafe fn density_of(choices: &incircle_relaxation, clip: &Clip) -> Outcome<Option<Density>> {
    let &incircle_relaxation { density, columns, rows, .. } = choices;
    if density.is_null() && columns == 0 && rows == 0 {
        return Ok(None);
    }
    let pixels = columns.checked_mul(rows).filter(|&pixels| pixels <= MAX_POINTS);
    let pixels = pixels.ok_or_else(|| {
        let text = format!("{rows} rows of {columns} weights are too many: give at most {MAX_POINTS} weights");
        Failure::new(INCIRCLE_CAPACITY, text)
    })?;
    look_for_memory(pixels * BYTES_OF_A_PIXEL)?;
    // SAFETY: the caller promises the weights.
    let weights: Vec<u16> = unsafe { copied(density.cast(), pixels, "density") }?;
    let density = Density::over(clip, columns, &weights);
    density.map(Some).map_err(|error| Failure::new(INCIRCLE_INPUT, error.to_string()))
}

fn number_of(end: End) -> u32 {
    match end {
        End::Iterations => INCIRCLE_ITERATIONS,
        End::Still => INCIRCLE_STILL,
        End::Cycle => INCIRCLE_CYCLE,
    }
}

/// When a relaxation with these choices ends.
fn checked(choices: &incircle_relaxation) -> Outcome<Stop> {
    let known = size_of::<incircle_relaxation>();
    if choices.size != known {
        let text = format!(
            "the choices have {} bytes, but this library knows choices of {known}: set `size` to \
             sizeof(incircle_relaxation), and use the header of the library",
            choices.size
        );
        return Err(Failure::new(INCIRCLE_ARGUMENT, text));
    }
    if choices.until_still > 1 {
        let text = format!("until_still is {}: give 0 or 1", choices.until_still);
        return Err(Failure::new(INCIRCLE_ARGUMENT, text));
    }
    if choices.iterations == 0 {
        return Err(Failure::new(INCIRCLE_CHOICE, "0 iterations are not possible: choose 1 or more"));
    }
    Ok(Stop { iterations: choices.iterations, when_still: choices.until_still == 1 })
}
