//! Constraints in the mesh of the CPU triangulator, before it is brought into canonical form.
//!
//! The vertices have their numbers along the curve here, and the edges of a neighbourhood lie close together in
//! memory. So constraints are forced many times faster than in a list of triangles, whose order is that of the input.
//! Vertices are taken in the order of the curve, too. `force` brings a constraint in, and `flips` makes the edges
//! around it locally Delaunay. Then `parts` floods the parts of the plane between the constraints, and `domain` takes the
//! triangles of those that are wanted.
//!
//! `mesh` is the mesh of half-edges with fixed edges, and `connect` leads from points and a plan to the answer.

mod connect;
mod domain;
mod flips;
mod force;
mod mesh;
mod parts;
mod turn;

pub(crate) use connect::{connect_fixed, Asked, Forced};
