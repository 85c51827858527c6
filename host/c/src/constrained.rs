//! Constraints and domains.
#![allow(unsafe_code)] // functions that C calls

use std::ffi::c_void;

use incircle::constraints::{constrain, Constrained, Domain, Plan};
use incircle::verify::verify_constrained;
use incircle::{Mesh, PlanePoint};

use crate::border::{copied, exclusive, give, look_for_memory, shared};
use crate::mesh::{incircle_mesh, AnyMesh};
use crate::status::{guarded, Failure, Outcome};
use crate::status::{INCIRCLE_ARGUMENT, INCIRCLE_CHOICE, INCIRCLE_INPUT, INCIRCLE_WRONG_MESH};

/// All triangles of the hull.
pub const INCIRCLE_ALL: u32 = 0;
/// The triangles that constraints separate from the outside of the hull and from all holes.
pub const INCIRCLE_HOLES: u32 = 1;
/// The triangles that an odd number of rings of constraints surround.
pub const INCIRCLE_EVEN_ODD: u32 = 2;
/// The triangles around which the rings of constraints run a number of times that is not zero.
pub const INCIRCLE_NON_ZERO: u32 = 3;

/// The most bytes a point and a constraint that a constrained mesh needs while it is made or checked.
const BYTES_OF_A_PLAN: usize = 600;

/// Constraints and the domain that is wanted. Set all to 0 and `size` to `sizeof(incircle_plan)` first.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incircle_plan {
    /// The size of this structure in bytes.
    pub size: usize,
    /// Edges that must be in the mesh: the indices of both ends of each. They may overlap, touch and pass through
    /// points, but not cross elsewhere.
    pub constraints: *const [u32; 2],
    /// The number of constraints.
    pub constraint_count: usize,
    /// The number of constraints at the end that bound nothing: they are edges, but no parts of rings.
    pub lines: usize,
    /// The triangles that are wanted: `INCIRCLE_ALL`, `INCIRCLE_HOLES`, `INCIRCLE_EVEN_ODD` or `INCIRCLE_NON_ZERO`.
    pub domain: u32,
    /// x and y of a place in each hole of `INCIRCLE_HOLES`, in the type of numbers of the mesh.
    pub holes: *const c_void,
    /// The number of holes.
    pub hole_count: usize,
    /// x and y of a place in each region whose number is wanted, in the type of numbers of the mesh.
    pub regions: *const c_void,
    /// The number of these places.
    pub region_count: usize,
}

/// The triangles of a domain in the canonical mesh with constraints. Several threads may read one at a time.
#[allow(non_camel_case_types)]
pub struct incircle_constrained {
    made: Constrained,
    /// Points, hull and duplicates of a mesh without triangles, if points and constraints were one job.
    pub(crate) own: Option<Box<dyn AnyMesh + Send + Sync>>,
    /// The constraints of piece `k` are those from `starts[k]` to `starts[k + 1]`.
    starts: Vec<usize>,
    constraints: Vec<u32>,
}

impl incircle_constrained {
    /// A constrained mesh on its way to the caller.
    pub(crate) fn boxed(made: Constrained, own: Option<Box<dyn AnyMesh + Send + Sync>>) -> *mut Self {
        let mut starts = vec![0];
        let mut constraints = Vec::new();
        for (_, some) in made.pieces.iter() {
            constraints.extend_from_slice(some);
            starts.push(constraints.len());
        }
        Box::into_raw(Box::new(Self { made, own, starts, constraints }))
    }
}

/// A plan with its lists in our memory.
pub(crate) struct Copied<P> {
    constraints: Vec<[u32; 2]>,
    lines: usize,
    domain: Domain,
    holes: Vec<P>,
    regions: Vec<P>,
}

impl<P: Copy> Copied<P> {
    /// # Safety
    /// The pointers of the plan are as described there.
    pub(crate) unsafe fn of(plan: &incircle_plan) -> Outcome<Self> {
        let known = size_of::<incircle_plan>();
        if plan.size != known {
            let text = format!(
                "the plan has {} bytes, but this library knows plans of {known}: set `size` to \
                 sizeof(incircle_plan), and use the header of the library",
                plan.size
            );
            return Err(Failure::new(INCIRCLE_ARGUMENT, text));
        }
        let Some(&domain) = Domain::ALL.get(plan.domain as usize) else {
            let text = format!("{} is not the number of a domain: give 0 to 3, such as INCIRCLE_ALL", plan.domain);
            return Err(Failure::new(INCIRCLE_ARGUMENT, text));
        };
        if plan.lines > plan.constraint_count {
            let (lines, count) = (plan.lines, plan.constraint_count);
            let text = format!("{lines} of {count} constraints cannot be lines: give 0 to {count}");
            return Err(Failure::new(INCIRCLE_CHOICE, text));
        }
        // SAFETY: the caller promises the lists.
        unsafe {
            Ok(Self {
                constraints: copied(plan.constraints.cast(), plan.constraint_count, "constraints")?,
                lines: plan.lines,
                domain,
                holes: copied(plan.holes, plan.hole_count, "holes")?,
                regions: copied(plan.regions, plan.region_count, "regions")?,
            })
        }
    }

    /// Looks whether there is memory for a constrained mesh of `points` points.
    pub(crate) fn look_for_memory(&self, points: usize) -> Outcome {
        look_for_memory((points + self.constraints.len()) * BYTES_OF_A_PLAN)
    }

    pub(crate) fn plan(&self) -> Plan<'_, P> {
        let Self { constraints, lines, domain, holes, regions } = self;
        Plan { constraints, lines: *lines, domain: *domain, holes, regions }
    }
}

/// Forces the constraints of a plan into a mesh.
///
/// # Safety
/// The pointers of the plan are as described there.
pub(crate) unsafe fn forced<P: PlanePoint>(mesh: &Mesh<P>, plan: &incircle_plan) -> Outcome<Constrained> {
    // SAFETY: the caller promises the plan.
    let copied = unsafe { Copied::of(plan) }?;
    copied.look_for_memory(mesh.points.len())?;
    constrain(mesh, &copied.plan()).map_err(|error| Failure::new(INCIRCLE_INPUT, error.to_string()))
}

/// Proves that triangles are those of a plan.
///
/// # Safety
/// The pointers of the plan are as described there.
pub(crate) unsafe fn proved<P: PlanePoint>(points: &[P], triangles: &[[u32; 3]], plan: &incircle_plan) -> Outcome {
    // SAFETY: the caller promises the plan.
    let copied = unsafe { Copied::of(plan) }?;
    copied.look_for_memory(points.len())?;
    let verified = verify_constrained(points, triangles, &copied.plan());
    verified.map(|_| ()).map_err(|error| Failure::new(INCIRCLE_WRONG_MESH, error.to_string()))
}

/// Forces constraints into a mesh and takes the triangles of a domain. The mesh stays as it is. `made` becomes a
/// constrained mesh that must be freed, or null if the call fails.
///
/// The status is `INCIRCLE_INPUT` for constraints that cross or name points that do not exist, a boundary that is not
/// closed, a hole or region outside the hull or on a constraint, and a domain without triangles.
///
/// # Safety
/// `mesh` is a mesh that is not freed, `plan` points to a plan whose pointers are as described there, and `made` to a
/// pointer that may be written.
#[no_mangle]
pub unsafe extern "C" fn incircle_constrain(
    mesh: *const incircle_mesh,
    plan: *const incircle_plan,
    made: *mut *mut incircle_constrained,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        let out = unsafe { exclusive(made, "made") }?;
        *out = std::ptr::null_mut();
        // SAFETY: the same.
        let made = unsafe { shared(mesh, "mesh")?.0.constrain(shared(plan, "plan")?) }?;
        *out = incircle_constrained::boxed(made, None);
        Ok(())
    })
}

/// The triangles of the domain: three indices each, in the form of `incircle_mesh_triangles`.
///
/// # Safety
/// `constrained` is one that is not freed; the rest is as for `incircle_mesh_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_constrained_triangles(
    constrained: *const incircle_constrained,
    buffer: *mut [u32; 3],
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(constrained, "constrained")?.made.triangles, buffer, room, count) })
}

/// The region of each triangle: a part of the domain that no constraint cuts. With `INCIRCLE_ALL` and without places of
/// regions, every triangle is in region 0.
///
/// # Safety
/// As for `incircle_constrained_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_constrained_regions(
    constrained: *const incircle_constrained,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(constrained, "constrained")?.made.regions, buffer, room, count) })
}

/// The region around each place of the plan's `regions`.
///
/// # Safety
/// As for `incircle_constrained_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_constrained_marked(
    constrained: *const incircle_constrained,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(constrained, "constrained")?.made.marked, buffer, room, count) })
}

/// The edges that constraints fix, also those outside the domain: two indices each, the smaller first, in sorted order.
///
/// # Safety
/// As for `incircle_constrained_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_constrained_pieces(
    constrained: *const incircle_constrained,
    buffer: *mut [u32; 2],
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(shared(constrained, "constrained")?.made.pieces.edges(), buffer, room, count) })
}

/// The place in `incircle_constrained_piece_constraints` at which the constraints of each piece begin. There is one
/// item more than pieces: the end of the last.
///
/// # Safety
/// As for `incircle_constrained_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_constrained_piece_starts(
    constrained: *const incircle_constrained,
    buffer: *mut usize,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(constrained, "constrained")?.starts, buffer, room, count) })
}

/// The numbers of the constraints that each piece belongs to, one piece behind the other.
///
/// # Safety
/// As for `incircle_constrained_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_constrained_piece_constraints(
    constrained: *const incircle_constrained,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&shared(constrained, "constrained")?.constraints, buffer, room, count) })
}

/// Proves with the independent validator that these are the triangles of the plan's domain in the canonical mesh of the
/// points of `mesh`. The status is `INCIRCLE_WRONG_MESH` if they are not. `mesh` may be null if `constrained` came from
/// `incircle_triangulate_constrained`, which keeps the points.
///
/// # Safety
/// The pointers are as for `incircle_constrain`, and `constrained` is one that is not freed.
#[no_mangle]
pub unsafe extern "C" fn incircle_constrained_verify(
    constrained: *const incircle_constrained,
    mesh: *const incircle_mesh,
    plan: *const incircle_plan,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        let constrained = unsafe { shared(constrained, "constrained") }?;
        let mesh = match &constrained.own {
            Some(own) if mesh.is_null() => own,
            // SAFETY: the same.
            _ => &unsafe { shared(mesh, "mesh") }?.0,
        };
        // SAFETY: the same.
        unsafe { mesh.verify_plan(&constrained.made.triangles, shared(plan, "plan")?) }
    })
}

/// Frees a constrained mesh. A null pointer is allowed.
///
/// # Safety
/// `constrained` is null, or one that is not freed, and is not used again.
#[no_mangle]
pub unsafe extern "C" fn incircle_constrained_free(constrained: *mut incircle_constrained) {
    if !constrained.is_null() {
        // SAFETY: it came from `boxed`, and nobody uses it any more.
        drop(unsafe { Box::from_raw(constrained) });
    }
}
