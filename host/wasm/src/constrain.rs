//! Forcing edges into a mesh, and triangulating the inside of polygons.
#![allow(unsafe_code)] // names of functions that JavaScript calls

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use incircle_geometry::constraints::{triangulate, Domain, Plan};
use incircle_geometry::pages::has_room;

use crate::batch::{check_room, flat};
use crate::border::{give, indices, places, points, told};

/// The most bytes a point and a constraint that forcing edges into a mesh needs.
const BYTES_OF_A_PLAN: usize = 600;

/// Checks that there is memory to force constraints into the mesh of points.
fn check_room_for_plan(points: usize, constraints: usize) -> Result<(), String> {
    let bytes = points.saturating_add(constraints).saturating_mul(BYTES_OF_A_PLAN);
    let text = || {
        format!(
            "{points} points with {constraints} constraints need up to {bytes} bytes, and the module cannot get them: \
             give fewer at a time"
        )
    };
    has_room(bytes).then_some(()).ok_or_else(text)
}

/// Triangulates the points in the buffer with the pairs of the buffer of indices as edges, and lists the triangles and
/// the region of each. `domain` is the number of a domain in the order of [`Domain::ALL`], and the buffer of places
/// has a place in each hole of [`Domain::Holes`].
#[no_mangle]
pub extern "C" fn constrained(domain: usize) -> f64 {
    let constraints = indices();
    let holes = places();
    let points = points();
    let room = check_room(&points).and_then(|()| check_room_for_plan(points.len(), constraints.len() / 2));
    let made = room.and_then(|()| {
        let domain = Domain::ALL.get(domain).copied().ok_or("there is no such domain")?;
        let plan = Plan { domain, holes: &holes, ..Plan::new(constraints.as_chunks().0) };
        triangulate(&points, &plan, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()))
            .map_err(|error| error.to_string())
    });
    told(made.map(|mesh| {
        let made = mesh.made;
        give(vec![flat(made.triangles), made.regions]);
        0.0
    }))
}
