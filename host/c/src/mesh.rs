//! The mesh of a set of points.
#![allow(unsafe_code)] // functions that C calls

use std::ffi::{c_char, c_void, CString};
use std::num::NonZeroU32;
use std::ops::ControlFlow;

use incircle::constraints::Constrained;
use incircle::{Device, Mesh, Options, PlanePoint, Progress, Session};

use crate::border::{copied, exclusive, give, look_for_memory, shared, text};
use crate::constrained::{forced, incircle_plan, proved};
use crate::status::{guarded, Failure, Outcome};
use crate::status::{INCIRCLE_ARGUMENT, INCIRCLE_CHOICE, INCIRCLE_WRONG_MESH};

/// Coordinates are `double`.
pub const INCIRCLE_F64: u32 = 0;
/// Coordinates are `float`.
pub const INCIRCLE_F32: u32 = 1;
/// Coordinates are `int64_t`.
pub const INCIRCLE_I64: u32 = 2;
/// Coordinates are `int32_t`.
pub const INCIRCLE_I32: u32 = 3;
/// Coordinates are `uint32_t`.
pub const INCIRCLE_U32: u32 = 4;

/// The most bytes a point that a job needs beyond its points.
pub(crate) const BYTES_OF_A_JOB: usize = 200;
/// The most bytes a point that the adjacency needs.
const BYTES_OF_ADJACENCY: usize = 190 + 24;
/// Points of one command to a device. Between commands, progress is told.
const CHUNK: usize = 4096;

/// Something in one of the five types of numbers.
macro_rules! of_type {
    ($number:expr, $point:ident => $body:expr) => {
        match $number {
            $crate::INCIRCLE_F64 => {
                type $point = [f64; 2];
                $body
            }
            $crate::INCIRCLE_F32 => {
                type $point = [f32; 2];
                $body
            }
            $crate::INCIRCLE_I64 => {
                type $point = [i64; 2];
                $body
            }
            $crate::INCIRCLE_I32 => {
                type $point = [i32; 2];
                $body
            }
            $crate::INCIRCLE_U32 => {
                type $point = [u32; 2];
                $body
            }
            other => Err($crate::mesh::no_type(other)),
        }
    };
}
pub(crate) use of_type;

pub(crate) fn no_type(number: u32) -> Failure {
    Failure::new(INCIRCLE_ARGUMENT, format!("{number} is not the number of a type: give 0 to 4, such as INCIRCLE_F64"))
}

/// A mesh in any type of numbers.
pub(crate) trait AnyMesh {
    fn triangles(&self) -> &[[u32; 3]];
    fn hull(&self) -> &[u32];
    fn duplicates(&self) -> Vec<[u32; 2]>;
    fn halfedges(&self) -> Vec<u32>;
    fn points(&self) -> usize;
    fn verify(&self) -> Outcome;
    /// # Safety
    /// The pointers of the plan are as described there; so in both functions.
    unsafe fn constrain(&self, plan: &incircle_plan) -> Outcome<Constrained>;
    unsafe fn verify_plan(&self, triangles: &[[u32; 3]], plan: &incircle_plan) -> Outcome;
}

impl<P: PlanePoint> AnyMesh for Mesh<P> {
    fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    fn hull(&self) -> &[u32] {
        &self.hull
    }

    fn duplicates(&self) -> Vec<[u32; 2]> {
        self.duplicates.iter().map(|one| [one.index, one.of]).collect()
    }

    fn halfedges(&self) -> Vec<u32> {
        Mesh::halfedges(self)
    }

    fn points(&self) -> usize {
        self.points.len()
    }

    fn verify(&self) -> Outcome {
        Mesh::verify(self).map_err(|error| Failure::new(INCIRCLE_WRONG_MESH, error.to_string()))
    }

    unsafe fn constrain(&self, plan: &incircle_plan) -> Outcome<Constrained> {
        // SAFETY: the caller promises the plan.
        unsafe { forced(self, plan) }
    }

    unsafe fn verify_plan(&self, triangles: &[[u32; 3]], plan: &incircle_plan) -> Outcome {
        // SAFETY: the same.
        unsafe { proved(&self.points, triangles, plan) }
    }
}

/// The mesh of a set of points. Several threads may read a mesh at a time.
#[allow(non_camel_case_types)]
pub struct incircle_mesh(pub(crate) Box<dyn AnyMesh + Send + Sync>);

/// A function that hears of the progress of a job: the stage, and the items done of all items of the stage. It is
/// called in the thread that asked for the job. A result other than 0 ends the job. No exception of C++ may leave it.
#[allow(non_camel_case_types)]
pub type incircle_progress =
    Option<extern "C" fn(user: *mut c_void, stage: *const c_char, done: usize, total: usize) -> i32>;

/// The choices for a job. Set all to 0 and `size` to `sizeof(incircle_options)` first.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incircle_options {
    /// The size of this structure in bytes.
    pub size: usize,
    /// The address of what does the job, such as `"model"`; null for the CPU triangulator.
    pub backend: *const c_char,
    /// The most threads of the CPU triangulator, 1 to 256; 0 for one a processor.
    pub threads: u32,
    /// The function that hears of the progress, or null.
    pub progress: incircle_progress,
    /// A pointer that every call of `progress` gets as its argument `user`.
    pub user: *mut c_void,
}

/// Triangulates `count` points. `points` has x and y of each, in the type of numbers `number`, such as `INCIRCLE_F64`.
/// `options` may be null. `mesh` becomes a mesh that must be freed, or null if the call fails.
///
/// The points are copied, so they need to live only for the call. The status is `INCIRCLE_INPUT` for a coordinate that
/// is NaN or infinite, and for points that the device cannot take.
///
/// # Safety
/// All pointers are null or point to what is said above.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulate(
    points: *const c_void,
    count: usize,
    number: u32,
    options: *const incircle_options,
    mesh: *mut *mut incircle_mesh,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        let out = unsafe { exclusive(mesh, "mesh") }?;
        *out = std::ptr::null_mut();
        // SAFETY: the same.
        let choices = unsafe { Choices::of(options) }?;
        let made = of_type!(number, P => {
            // SAFETY: the same.
            let points = unsafe { copied::<P>(points, count, "points") }?;
            choices.solve(points).map(boxed)
        })?;
        *out = made;
        Ok(())
    })
}

/// A mesh on its way to the caller.
pub(crate) fn boxed<P: PlanePoint + Send + Sync + 'static>(mesh: Mesh<P>) -> *mut incircle_mesh {
    Box::into_raw(Box::new(incircle_mesh(Box::new(mesh))))
}

/// The choices of the caller, checked.
pub(crate) struct Choices<'a> {
    backend: Option<&'a str>,
    threads: Option<NonZeroU32>,
    progress: incircle_progress,
    user: *mut c_void,
}

impl Choices<'_> {
    /// # Safety
    /// The pointer is null, or points to options whose pointers are as described there.
    pub(crate) unsafe fn of(options: *const incircle_options) -> Outcome<Self> {
        if options.is_null() {
            return Ok(Self { backend: None, threads: None, progress: None, user: std::ptr::null_mut() });
        }
        // SAFETY: the caller promises the options.
        let given = unsafe { shared(options, "options") }?;
        if given.size != size_of::<incircle_options>() {
            let text = format!(
                "the options have {} bytes, but this library knows options of {}: set `size` to \
                 sizeof(incircle_options), and use the header of the library",
                given.size,
                size_of::<incircle_options>()
            );
            return Err(Failure::new(INCIRCLE_ARGUMENT, text));
        }
        // SAFETY: the caller promises a text.
        let backend = unsafe { text(given.backend, "backend") }?;
        let threads = NonZeroU32::new(given.threads);
        if given.threads > 256 {
            let text = format!("{} threads are not possible: choose 1 to 256, or 0", given.threads);
            return Err(Failure::new(INCIRCLE_CHOICE, text));
        }
        if threads.is_some() && backend.is_some_and(|backend| backend != "cpu") {
            return Err(Failure::new(INCIRCLE_CHOICE, "threads are for the CPU triangulator: leave out the back end"));
        }
        Ok(Self { backend, threads, progress: given.progress, user: given.user })
    }

    fn solve<P: PlanePoint>(&self, points: Vec<P>) -> Outcome<Mesh<P>> {
        look_for_memory(points.len() * BYTES_OF_A_JOB)?;
        self.run(|session, options| Ok(session.triangulate_owned(points, options)?.mesh))
    }

    /// Does a job with the back end of the choices, which tells the progress.
    pub(crate) fn run<T>(&self, job: impl FnOnce(&mut Session<'_>, &Options<'_>) -> Outcome<T>) -> Outcome<T> {
        let mut device = match self.backend {
            None | Some("cpu") => Device::cpu(self.threads),
            Some(address) => Device::open(address)?,
        };
        let listener = |progress| self.tell(progress);
        let mut options = Options::default().insert_chunk(CHUNK);
        if self.progress.is_some() {
            options = options.progress(&listener);
        }
        let mut session = device.session()?;
        job(&mut session, &options)
    }

    fn tell(&self, Progress { stage, done, total }: Progress) -> ControlFlow<()> {
        let goes_on = self.progress.is_none_or(|progress| {
            let stage = CString::new(stage.name()).unwrap_or_default();
            progress(self.user, stage.as_ptr(), done, total) == 0
        });
        if goes_on {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    }
}

/// The triangles: three indices each, counter-clockwise, the smallest first, in sorted order.
///
/// As in all functions for lists, `count` becomes the number of items. With a null buffer nothing else is done; else
/// the buffer gets all items, or none and the status is `INCIRCLE_BUFFER`, if `room` items are not enough.
///
/// # Safety
/// `mesh` is a mesh that is not freed, `buffer` null or room for `room` items, and `count` may be written.
#[no_mangle]
pub unsafe extern "C" fn incircle_mesh_triangles(
    mesh: *const incircle_mesh,
    buffer: *mut [u32; 3],
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(shared(mesh, "mesh")?.0.triangles(), buffer, room, count) })
}

/// The points on the hull, counter-clockwise, those in the middle of a hull edge included. A mesh without triangles
/// lists all distinct points, in lexicographic order.
///
/// # Safety
/// As for `incircle_mesh_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_mesh_hull(
    mesh: *const incircle_mesh,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(shared(mesh, "mesh")?.0.hull(), buffer, room, count) })
}

/// The points with the coordinates of an earlier one: the index of each, and the lowest index at its place.
///
/// # Safety
/// As for `incircle_mesh_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_mesh_duplicates(
    mesh: *const incircle_mesh,
    buffer: *mut [u32; 2],
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(mesh, "mesh")?.0.duplicates(), buffer, room, count) })
}

/// The half-edges, three for each triangle. Half-edge `3 t + k` runs from vertex `k` of triangle `t` to the next one.
/// The item is the half-edge of the same edge in the other triangle, or `UINT32_MAX` on the hull.
///
/// # Safety
/// As for `incircle_mesh_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_mesh_halfedges(
    mesh: *const incircle_mesh,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        let mesh = unsafe { shared(mesh, "mesh") }?;
        if buffer.is_null() {
            // SAFETY: the same. The items are not computed where only their number matters.
            *unsafe { exclusive(count, "count") }? = 3 * mesh.0.triangles().len();
            return Ok(());
        }
        look_for_memory(mesh.0.points() * BYTES_OF_ADJACENCY)?;
        // SAFETY: the same.
        unsafe { give(&mesh.0.halfedges(), buffer, room, count) }
    })
}

/// Proves with the independent validator that this is the canonical mesh of its points. The status is
/// `INCIRCLE_WRONG_MESH` if it is not.
///
/// # Safety
/// `mesh` is a mesh that is not freed.
#[no_mangle]
pub unsafe extern "C" fn incircle_mesh_verify(mesh: *const incircle_mesh) -> i32 {
    // SAFETY: the caller promises the pointer.
    guarded(|| unsafe { shared(mesh, "mesh") }?.0.verify())
}

/// Frees a mesh. A null pointer is allowed.
///
/// # Safety
/// `mesh` is null, or a mesh that is not freed, and is not used again.
#[no_mangle]
pub unsafe extern "C" fn incircle_mesh_free(mesh: *mut incircle_mesh) {
    if !mesh.is_null() {
        // SAFETY: the mesh came from `boxed`, and nobody uses it any more.
        drop(unsafe { Box::from_raw(mesh) });
    }
}
