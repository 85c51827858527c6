//! Values between points.
#![allow(unsafe_code)] // functions that C calls

use std::num::NonZeroUsize;

use incircle::interpolate::{Method, Outside, Surface};

use crate::border::{copied, exclusive, give, look_for_memory, shared};
use crate::status::{guarded, Failure, INCIRCLE_ARGUMENT, INCIRCLE_INPUT};

/// The plane through the corners of the triangle around a place.
pub const INCIRCLE_LINEAR: u32 = 0;
/// Natural neighbours, weighted by lengths of edges over distances.
pub const INCIRCLE_LAPLACE: u32 = 1;
/// Natural neighbours, weighted by areas.
pub const INCIRCLE_SIBSON: u32 = 2;

/// Outside the hull, there is no value: the result is NaN.
pub const INCIRCLE_NAN: u32 = 0;
/// Outside the hull, the value is that of the nearest point.
pub const INCIRCLE_NEAREST: u32 = 1;

/// The most bytes a point that a surface needs while it is made.
const BYTES_OF_A_POINT: usize = 700;
/// The most bytes a place that values need while they are worked out.
const BYTES_OF_A_PLACE: usize = 60;

/// Points with a value each, made ready for values elsewhere. Several threads may ask one at a time.
#[allow(non_camel_case_types)]
pub struct incircle_surface {
    points: Vec<[f64; 2]>,
    surface: Surface,
}

/// The contour lines of a level. Several threads may read them at a time.
#[allow(non_camel_case_types)]
pub struct incircle_contours {
    places: Vec<[f64; 2]>,
    starts: Vec<usize>,
    closed: Vec<u8>,
}

/// Makes the surface of `count` points, x and y of each, with a value each. Of points at one place, the lowest index
/// has the value. `surface` becomes a surface that must be freed, or null if the call fails.
///
/// The status is `INCIRCLE_INPUT` for a coordinate or value that is NaN or infinite, and for points without a triangle.
///
/// # Safety
/// `points` points to `count` pairs, `values` to as many numbers, and `surface` to a pointer that may be written.
#[no_mangle]
pub unsafe extern "C" fn incircle_surface_new(
    points: *const [f64; 2],
    values: *const f64,
    count: usize,
    surface: *mut *mut incircle_surface,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        let out = unsafe { exclusive(surface, "surface") }?;
        *out = std::ptr::null_mut();
        // SAFETY: the same.
        let points = unsafe { copied::<[f64; 2]>(points.cast(), count, "points") }?;
        // SAFETY: the same.
        let values = unsafe { copied::<f64>(values.cast(), count, "values") }?;
        if let Some(point) = values.iter().position(|value| !value.is_finite()) {
            let value = values[point];
            let text =
                format!("the value of point {point} is {value}, which is not a finite number: correct the point");
            return Err(Failure::new(INCIRCLE_INPUT, text));
        }
        look_for_memory(count * BYTES_OF_A_POINT)?;
        let mesh = incircle::triangulate(&points)?;
        let surface = Surface::new(&points, &mesh.triangles, &values);
        let surface = surface.map_err(|error| Failure::new(INCIRCLE_INPUT, error.to_string()))?;
        *out = Box::into_raw(Box::new(incircle_surface { points, surface }));
        Ok(())
    })
}

/// The values at `count` places, x and y of each, in their order. `method` is `INCIRCLE_LINEAR`, `INCIRCLE_LAPLACE` or
/// `INCIRCLE_SIBSON`, and `outside` is `INCIRCLE_NAN` or `INCIRCLE_NEAREST`. `threads` bounds the threads; 0 allows one
/// a processor. A place that is not finite has no value.
///
/// # Safety
/// `surface` is one that is not freed, `places` points to `count` pairs, and `values` to as many numbers that may be
/// written.
#[no_mangle]
pub unsafe extern "C" fn incircle_surface_values(
    surface: *const incircle_surface,
    method: u32,
    outside: u32,
    threads: u32,
    places: *const [f64; 2],
    count: usize,
    values: *mut f64,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        let surface = unsafe { shared(surface, "surface") }?;
        let refused = |text: String| Err(Failure::new(INCIRCLE_ARGUMENT, text));
        let method = match method {
            INCIRCLE_LINEAR => Method::Linear,
            INCIRCLE_LAPLACE => Method::Laplace,
            INCIRCLE_SIBSON => Method::Sibson,
            other => {
                return refused(format!("{other} is not the number of a method: give 0 to 2, such as INCIRCLE_LINEAR"))
            }
        };
        let outside = match outside {
            INCIRCLE_NAN => Outside::Nan,
            INCIRCLE_NEAREST => Outside::Nearest,
            other => return refused(format!("outside is {other}: give INCIRCLE_NAN or INCIRCLE_NEAREST")),
        };
        // SAFETY: the same.
        let places = unsafe { copied::<[f64; 2]>(places.cast(), count, "places") }?;
        look_for_memory(count * BYTES_OF_A_PLACE)?;
        let (threads, most) = (NonZeroUsize::new(threads as usize), std::thread::available_parallelism().ok());
        let found = surface.surface.values(method, outside, &places, threads.or(most).unwrap_or(NonZeroUsize::MIN));
        if count > 0 {
            // SAFETY: the same.
            unsafe { exclusive(values, "values") }?;
        }
        // SAFETY: the same; a null pointer gets no values.
        unsafe { give(&found, values, count, &mut 0) }
    })
}

/// Finds the contour lines of a level on the surface of `INCIRCLE_LINEAR`, with higher ground on their left. `contours`
/// becomes a list of lines that must be freed, or null if the call fails.
///
/// # Safety
/// `surface` is one that is not freed, and `contours` points to a pointer that may be written.
#[no_mangle]
pub unsafe extern "C" fn incircle_surface_contours(
    surface: *const incircle_surface,
    level: f64,
    contours: *mut *mut incircle_contours,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        let out = unsafe { exclusive(contours, "contours") }?;
        *out = std::ptr::null_mut();
        // SAFETY: the same.
        let surface = unsafe { shared(surface, "surface") }?;
        look_for_memory(surface.points.len() * BYTES_OF_A_POINT)?;
        let mut lines = incircle_contours { places: Vec::new(), starts: vec![0], closed: Vec::new() };
        for line in surface.surface.contours(level) {
            lines.places.extend(line.crossings.iter().map(|crossing| crossing.place(&surface.points)));
            lines.starts.push(lines.places.len());
            lines.closed.push(line.is_closed.into());
        }
        *out = Box::into_raw(Box::new(lines));
        Ok(())
    })
}

/// The places at which the lines cross edges, one line behind the other. A closed line does not repeat its first place.
///
/// # Safety
/// `contours` is one that is not freed; the rest is as for `incircle_mesh_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_contours_places(
    contours: *const incircle_contours,
    buffer: *mut [f64; 2],
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(contours, "contours")?.places, buffer, room, count) })
}

/// The place in `incircle_contours_places` at which each line begins. There is one item more than lines: the end of the
/// last.
///
/// # Safety
/// As for `incircle_contours_places`.
#[no_mangle]
pub unsafe extern "C" fn incircle_contours_starts(
    contours: *const incircle_contours,
    buffer: *mut usize,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(contours, "contours")?.starts, buffer, room, count) })
}

/// Whether each line is closed: 1, or 0 if it ends on the hull.
///
/// # Safety
/// As for `incircle_contours_places`.
#[no_mangle]
pub unsafe extern "C" fn incircle_contours_closed(
    contours: *const incircle_contours,
    buffer: *mut u8,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(contours, "contours")?.closed, buffer, room, count) })
}

/// Frees contour lines. A null pointer is allowed.
///
/// # Safety
/// `contours` is null, or one that is not freed, and is not used again.
#[no_mangle]
pub unsafe extern "C" fn incircle_contours_free(contours: *mut incircle_contours) {
    if !contours.is_null() {
        // SAFETY: it came from `incircle_surface_contours`, and nobody uses it any more.
        drop(unsafe { Box::from_raw(contours) });
    }
}

/// Frees a surface. A null pointer is allowed.
///
/// # Safety
/// `surface` is null, or one that is not freed, and is not used again.
#[no_mangle]
pub unsafe extern "C" fn incircle_surface_free(surface: *mut incircle_surface) {
    if !surface.is_null() {
        // SAFETY: it came from `incircle_surface_new`, and nobody uses it any more.
        drop(unsafe { Box::from_raw(surface) });
    }
}
