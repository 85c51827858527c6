//! The mesh that lives.
#![allow(unsafe_code)] // functions that C calls

use std::ffi::c_void;

use incircle::living::{Location, Triangulation};
use incircle::PlanePoint;

use crate::answers::Questions;
use crate::border::{copied, exclusive, give, look_for_memory, place, shared};
use crate::mesh::{boxed, incircle_mesh, of_type};
use crate::status::{guarded, Failure, Outcome};

/// The place is none: there are no triangles and it lies on no edge, or a coordinate is NaN or infinite.
pub const INCIRCLE_NONE: u32 = 0;
/// The place has a point.
pub const INCIRCLE_VERTEX: u32 = 1;
/// The place lies in an edge.
pub const INCIRCLE_EDGE: u32 = 2;
/// The place lies in a triangle.
pub const INCIRCLE_TRIANGLE: u32 = 3;
/// The place lies outside the hull.
pub const INCIRCLE_OUTSIDE: u32 = 4;

/// No index.
pub const INCIRCLE_EMPTY: u32 = u32::MAX;

/// The most bytes a point that a new triangulation needs while it is made.
const BYTES_OF_A_POINT: usize = 400;
/// After so many insertions the memory for the growth of all lists is looked for again.
const LOOK: u32 = 1024;

/// What a place is, and the vertices there.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incircle_location {
    /// `INCIRCLE_NONE`, `INCIRCLE_VERTEX`, `INCIRCLE_EDGE`, `INCIRCLE_TRIANGLE` or `INCIRCLE_OUTSIDE`.
    pub kind: u32,
    /// The vertices there, and `INCIRCLE_EMPTY` where there are fewer than three. Those of a triangle are
    /// counter-clockwise. Outside the hull they are the first hull edge, counter-clockwise, that is visible.
    pub vertices: [u32; 3],
}

/// A triangulation in any type of numbers. Each place of the caller is a pointer to two coordinates.
pub(crate) trait Living: Questions {
    /// # Safety
    /// The pointer is null, or points to two coordinates; so in all functions.
    unsafe fn insert(&mut self, place: *const c_void) -> Outcome<u32>;
    fn delete(&mut self, index: u32) -> Outcome;
    unsafe fn move_to(&mut self, index: u32, place: *const c_void) -> Outcome;
    unsafe fn move_all(&mut self, places: *const c_void, count: usize) -> Outcome;
    unsafe fn locate(&self, place: *const c_void) -> Outcome<incircle_location>;
    unsafe fn nearest(&self, place: *const c_void) -> Outcome<u32>;
    fn neighbors(&self, index: u32) -> Outcome<Vec<u32>>;
    fn indices(&self) -> Vec<u32>;
    fn len(&self) -> usize;
    fn mesh(&self) -> *mut incircle_mesh;
}

impl<P: PlanePoint + Send + Sync + 'static> Living for Triangulation<P> {
    unsafe fn insert(&mut self, at: *const c_void) -> Outcome<u32> {
        if self.next_index().is_multiple_of(LOOK) {
            // A list that doubles needs twice its bytes while it is copied, and all lists may double in turn.
            look_for_memory(2 * self.bytes() + LOOK as usize * BYTES_OF_A_POINT)?;
        }
        // SAFETY: as above.
        Ok(Triangulation::insert(self, unsafe { place(at) }?)?)
    }

    fn delete(&mut self, index: u32) -> Outcome {
        Ok(Triangulation::delete(self, index)?)
    }

    unsafe fn move_to(&mut self, index: u32, at: *const c_void) -> Outcome {
        // SAFETY: as above.
        Ok(Triangulation::move_to(self, index, unsafe { place(at) }?)?)
    }

    unsafe fn move_all(&mut self, places: *const c_void, count: usize) -> Outcome {
        look_for_memory(Triangulation::len(self) * BYTES_OF_A_POINT)?;
        // SAFETY: as above.
        Ok(Triangulation::move_all(self, &unsafe { copied::<P>(places, count, "places") }?)?)
    }

    unsafe fn locate(&self, at: *const c_void) -> Outcome<incircle_location> {
        // SAFETY: as above.
        let (kind, vertices) = match Triangulation::locate(self, unsafe { place(at) }?) {
            Location::None => (INCIRCLE_NONE, [INCIRCLE_EMPTY; 3]),
            Location::Vertex(a) => (INCIRCLE_VERTEX, [a, INCIRCLE_EMPTY, INCIRCLE_EMPTY]),
            Location::Edge([a, b]) => (INCIRCLE_EDGE, [a, b, INCIRCLE_EMPTY]),
            Location::Triangle(corners) => (INCIRCLE_TRIANGLE, corners),
            Location::Outside([a, b]) => (INCIRCLE_OUTSIDE, [a, b, INCIRCLE_EMPTY]),
        };
        Ok(incircle_location { kind, vertices })
    }

    unsafe fn nearest(&self, at: *const c_void) -> Outcome<u32> {
        // SAFETY: as above.
        Ok(Triangulation::nearest(self, unsafe { place(at) }?).unwrap_or(INCIRCLE_EMPTY))
    }

    fn neighbors(&self, index: u32) -> Outcome<Vec<u32>> {
        Ok(Triangulation::neighbors(self, index)?.collect())
    }

    fn indices(&self) -> Vec<u32> {
        Triangulation::indices(self)
    }

    fn len(&self) -> usize {
        Triangulation::len(self)
    }

    fn mesh(&self) -> *mut incircle_mesh {
        boxed(Triangulation::mesh(self))
    }
}

/// A triangulation that can be asked and changed. While one thread changes it, no other may use it; several may ask.
#[allow(non_camel_case_types)]
pub struct incircle_triangulation(pub(crate) Box<dyn Living + Send + Sync>);

/// Makes the triangulation of `count` points, whose indices are their positions. `points` may be null if `count` is 0.
/// All coordinates that the triangulation takes have the type `number`, such as `INCIRCLE_F64`. `made` becomes a
/// triangulation that must be freed, or null if the call fails.
///
/// # Safety
/// `points` points to `count` pairs of numbers of that type, and `made` to a pointer that may be written.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_new(
    points: *const c_void,
    count: usize,
    number: u32,
    made: *mut *mut incircle_triangulation,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        let out = unsafe { exclusive(made, "made") }?;
        *out = std::ptr::null_mut();
        let living: Box<dyn Living + Send + Sync> = of_type!(number, P => {
            // SAFETY: the same.
            let points = unsafe { copied::<P>(points, count, "points") }?;
            look_for_memory(points.len() * BYTES_OF_A_POINT)?;
            Ok::<Box<dyn Living + Send + Sync>, Failure>(Box::new(Triangulation::from(points)?))
        })?;
        *out = Box::into_raw(Box::new(incircle_triangulation(living)));
        Ok(())
    })
}

/// Inserts the point at `place`, two coordinates, and gives its index. A point at the place of a living one is a
/// duplicate, and no error.
///
/// # Safety
/// `triangulation` is one that is not freed, `place` points to two coordinates of its type, and `index` may be written.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_insert(
    triangulation: *mut incircle_triangulation,
    place: *const c_void,
    index: *mut u32,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe {
        let index = exclusive(index, "index")?;
        *index = exclusive(triangulation, "triangulation")?.0.insert(place)?;
        Ok(())
    })
}

/// Deletes the point of an index. Other points at its place stay.
///
/// # Safety
/// `triangulation` is one that is not freed.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_delete(triangulation: *mut incircle_triangulation, index: u32) -> i32 {
    // SAFETY: the caller promises the pointer.
    guarded(|| unsafe { exclusive(triangulation, "triangulation") }?.0.delete(index))
}

/// Moves the point of an index to `place`. The point keeps its index.
///
/// # Safety
/// As for `incircle_triangulation_insert`.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_move(
    triangulation: *mut incircle_triangulation,
    index: u32,
    place: *const c_void,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { exclusive(triangulation, "triangulation")?.0.move_to(index, place) })
}

/// Moves all living points, given a place for each in the order of their indices. Short moves are quick.
///
/// # Safety
/// `triangulation` is one that is not freed, and `places` points to `count` pairs of coordinates of its type.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_move_all(
    triangulation: *mut incircle_triangulation,
    places: *const c_void,
    count: usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { exclusive(triangulation, "triangulation")?.0.move_all(places, count) })
}

/// Says what a place is: a vertex, in an edge, in a triangle, or outside the hull.
///
/// # Safety
/// `triangulation` is one that is not freed, `place` points to two coordinates of its type, and `location` may be
/// written.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_locate(
    triangulation: *const incircle_triangulation,
    place: *const c_void,
    location: *mut incircle_location,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe {
        *exclusive(location, "location")? = shared(triangulation, "triangulation")?.0.locate(place)?;
        Ok(())
    })
}

/// The index of the point nearest to a place; of points at the same distance the one with the smaller x, then y.
/// `INCIRCLE_EMPTY` if there are no points, or if a coordinate is NaN or infinite.
///
/// # Safety
/// As for `incircle_triangulation_locate`.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_nearest(
    triangulation: *const incircle_triangulation,
    place: *const c_void,
    index: *mut u32,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe {
        *exclusive(index, "index")? = shared(triangulation, "triangulation")?.0.nearest(place)?;
        Ok(())
    })
}

/// The vertices that have an edge to the place of a point, counter-clockwise.
///
/// # Safety
/// `triangulation` is one that is not freed; the rest is as for `incircle_mesh_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_neighbors(
    triangulation: *const incircle_triangulation,
    index: u32,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(triangulation, "triangulation")?.0.neighbors(index)?, buffer, room, count) })
}

/// The indices of all living points, in rising order.
///
/// # Safety
/// `triangulation` is one that is not freed; the rest is as for `incircle_mesh_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_indices(
    triangulation: *const incircle_triangulation,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(triangulation, "triangulation")?.0.indices(), buffer, room, count) })
}

/// The canonical mesh of the living points. Index `k` in the mesh is that of the point whose index is item `k` of
/// `incircle_triangulation_indices`. `mesh` becomes a mesh that must be freed, or null if the call fails.
///
/// # Safety
/// `triangulation` is one that is not freed, and `mesh` points to a pointer that may be written.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_mesh(
    triangulation: *const incircle_triangulation,
    mesh: *mut *mut incircle_mesh,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        let out = unsafe { exclusive(mesh, "mesh") }?;
        *out = std::ptr::null_mut();
        // SAFETY: the same.
        let living = &unsafe { shared(triangulation, "triangulation") }?.0;
        look_for_memory(living.len() * BYTES_OF_A_POINT)?;
        *out = living.mesh();
        Ok(())
    })
}

/// Frees a triangulation. A null pointer is allowed.
///
/// # Safety
/// `triangulation` is null, or one that is not freed, and is not used again.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulation_free(triangulation: *mut incircle_triangulation) {
    if !triangulation.is_null() {
        // SAFETY: it came from `incircle_triangulation_new`, and nobody uses it any more.
        drop(unsafe { Box::from_raw(triangulation) });
    }
}
