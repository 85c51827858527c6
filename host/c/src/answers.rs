//! The answers of the mesh that lives that are lists, for triangulations in any type of numbers.
#![allow(unsafe_code)] // pointers of the caller

use std::ffi::c_void;

use incircle::living::Triangulation;
use incircle::PlanePoint;

use crate::border::place;
use crate::status::Outcome;

/// The questions, for a triangulation in any type of numbers. Each place of the caller is a pointer to two coordinates.
pub(crate) trait Questions {
    /// # Safety
    /// The pointer is null, or points to two coordinates; so in all functions.
    unsafe fn k_nearest(&self, at: *const c_void, number: usize) -> Outcome<Vec<u32>>;
    unsafe fn within_circle(&self, center: *const c_void, radius: f64) -> Outcome<Vec<u32>>;
    unsafe fn within_rectangle(&self, corner: *const c_void, opposite: *const c_void) -> Outcome<Vec<u32>>;
    unsafe fn segment(&self, from: *const c_void, to: *const c_void) -> Outcome<Vec<[u32; 3]>>;
    fn star(&self, index: u32) -> Outcome<Vec<[u32; 3]>>;
}

impl<P: PlanePoint> Questions for Triangulation<P> {
    unsafe fn k_nearest(&self, at: *const c_void, number: usize) -> Outcome<Vec<u32>> {
        // SAFETY: as above.
        Ok(Self::k_nearest(self, unsafe { place(at) }?, number.min(self.len())))
    }

    unsafe fn within_circle(&self, center: *const c_void, radius: f64) -> Outcome<Vec<u32>> {
        // SAFETY: as above.
        Ok(Self::within_circle(self, unsafe { place(center) }?, radius))
    }

    unsafe fn within_rectangle(&self, corner: *const c_void, opposite: *const c_void) -> Outcome<Vec<u32>> {
        // SAFETY: as above.
        Ok(unsafe { Self::within_rectangle(self, place(corner)?, place(opposite)?) })
    }

    unsafe fn segment(&self, from: *const c_void, to: *const c_void) -> Outcome<Vec<[u32; 3]>> {
        // SAFETY: as above.
        Ok(unsafe { Self::segment(self, place(from)?, place(to)?) })
    }

    fn star(&self, index: u32) -> Outcome<Vec<[u32; 3]>> {
        Ok(Self::star(self, index)?.collect())
    }
}
