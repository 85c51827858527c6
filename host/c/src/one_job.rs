//! Points and constraints as one job.
#![allow(unsafe_code)] // functions that C calls

use std::ffi::c_void;

use incircle::constraints::Triangulated;
use incircle::{Mesh, PlanePoint};

use crate::border::{copied, exclusive, give, look_for_memory, shared};
use crate::constrained::{incircle_constrained, incircle_plan, Copied};
use crate::mesh::{incircle_options, of_type, AnyMesh, Choices, BYTES_OF_A_JOB};
use crate::status::{guarded, Failure, Outcome, INCIRCLE_CHOICE};

/// Triangulates `count` points with the constraints of a plan, and takes the triangles of a domain. `points` has x and
/// y of each, in the type of numbers `number`, such as `INCIRCLE_F64`. `options` may be null. `made` becomes a
/// constrained mesh that must be freed, or null if the call fails.
///
/// The triangles are those of `incircle_triangulate` and then `incircle_constrain`, byte for byte. This call takes less
/// time with the CPU triangulator, whose progress is told while constraints are forced, too. The statuses are those of
/// both functions. The points are copied, and kept for `incircle_constrained_verify`.
///
/// # Safety
/// All pointers are null or point to what is said above and in `incircle_plan`.
#[no_mangle]
pub unsafe extern "C" fn incircle_triangulate_constrained(
    points: *const c_void,
    count: usize,
    number: u32,
    options: *const incircle_options,
    plan: *const incircle_plan,
    made: *mut *mut incircle_constrained,
) -> i32 {
    guarded(|| {
        // SAFETY: the caller promises the pointers.
        let out = unsafe { exclusive(made, "made") }?;
        *out = std::ptr::null_mut();
        // SAFETY: the same.
        let (choices, plan) = unsafe { (Choices::of(options)?, shared(plan, "plan")?) };
        let made = of_type!(number, P => {
            // SAFETY: the same.
            let (points, plan) = unsafe { (copied::<P>(points, count, "points")?, Copied::of(plan)?) };
            solve(points, &plan, &choices)
        })?;
        *out = made;
        Ok(())
    })
}

fn solve<P: PlanePoint + Send + Sync + 'static>(
    points: Vec<P>,
    plan: &Copied<P>,
    choices: &Choices<'_>,
) -> Outcome<*mut incircle_constrained> {
    look_for_memory(points.len() * BYTES_OF_A_JOB)?;
    plan.look_for_memory(points.len())?;
    let found = choices.run(|session, options| Ok(session.triangulate_constrained(&points, &plan.plan(), options)?));
    let Triangulated { made, hull, duplicates, .. } = found?.0;
    let own = Mesh::new(points, Vec::new(), hull, duplicates);
    Ok(incircle_constrained::boxed(made, Some(Box::new(own))))
}

/// The mesh that keeps the hull and the duplicates of a job.
fn of_job(constrained: &incircle_constrained) -> Outcome<&(dyn AnyMesh + Send + Sync)> {
    constrained.own.as_deref().ok_or_else(|| {
        let text = "incircle_constrain leaves hull and duplicates in its mesh: ask incircle_mesh_hull or \
                    incircle_mesh_duplicates";
        Failure::new(INCIRCLE_CHOICE, text)
    })
}

/// The points on the hull of all points, as in `incircle_mesh_hull`. The status is `INCIRCLE_CHOICE` if `constrained`
/// came from `incircle_constrain`, whose mesh has them.
///
/// # Safety
/// As for `incircle_constrained_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_constrained_hull(
    constrained: *const incircle_constrained,
    buffer: *mut u32,
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(of_job(shared(constrained, "constrained")?)?.hull(), buffer, room, count) })
}

/// The points with the coordinates of an earlier one, as in `incircle_mesh_duplicates`. The status is `INCIRCLE_CHOICE`
/// if `constrained` came from `incircle_constrain`, whose mesh has them.
///
/// # Safety
/// As for `incircle_constrained_triangles`.
#[no_mangle]
pub unsafe extern "C" fn incircle_constrained_duplicates(
    constrained: *const incircle_constrained,
    buffer: *mut [u32; 2],
    room: usize,
    count: *mut usize,
) -> i32 {
    // SAFETY: the caller promises the pointers.
    guarded(|| unsafe { give(&of_job(shared(constrained, "constrained")?)?.duplicates(), buffer, room, count) })
}
