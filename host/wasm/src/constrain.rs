//! Forcing edges into a mesh, and triangulating the inside of polygons.
#![allow(unsafe_code)] // names of functions that JavaScript calls

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use incircle_geometry::constraints::{triangulate, Domain, Plan};

use crate::batch::{check_room, flat};
use crate::border::{give, indices, places, points, told};

/// Triangulates the points in the buffer with the pairs of the buffer of indices as edges, and lists the triangles and
/// the region of each. `domain` is the number of a domain in the order of [`Domain::ALL`], and the buffer of places
/// has a place in each hole of [`Domain::Holes`].
#[no_mangle]
pub extern "C" fn constrained(domain: usize) -> f64 {
    let constraints = indices();
    let holes = places();
    let points = points();
    let made = check_room(&points).and_then(|()| {
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
