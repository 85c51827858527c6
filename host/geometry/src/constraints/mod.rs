//! Constrained Delaunay triangulation: edges that must be in the mesh, and the domain that they bound.
//!
//! Use [`triangulate`] if roads, walls, coastlines or outlines must be edges of a mesh. A constraint is a pair of
//! indices of points. The answer is canonical, as without constraints: of all triangulations that have the constraints
//! as edges, it is the one in which every other edge is locally Delaunay, with ties decided by the tie rule. The page
//! `docs/constraints.md` of the repository has the contract and the proof.
//!
//! | you want | call |
//! |---|---|
//! | a mesh with edges that must be there | [`triangulate`] with [`Plan::new`] |
//! | such edges in a mesh that there is already | [`constrain`] with [`Plan::new`] |
//! | the triangles inside polygons | the same with [`Domain::EvenOdd`] or [`Domain::NonZero`] |
//! | the triangles of a `.poly` file of Shewchuk's Triangle | the same with [`Domain::Holes`] and the holes |
//! | points where constraints cross | [`snap`], then `constrain` |
//! | constraints in the mesh of a device | [`constrain_numbers`] |
//!
//! **How it works, file by file.** `triangulate` lets the CPU triangulator force constraints in before it sorts its
//! triangles. The others work on the lists of a mesh. `build` has the steps. `network` links the triangles of a mesh
//! and marks fixed edges; `fixed_mesh` flips free ones; `force` brings a constraint in, and `listing` all of them;
//! `pieces` collects what constraints became, and `repeats` finds those that are equal; `crossing` works out where two
//! of them cross. `sweep` finds all crossings with the order of lines in `status`, and `snap` and `pixels` round them
//! to a finer grid. `domain` floods the parts between constraints, and `locate` finds holes and regions.

mod build;
mod constrain;
mod constrained;
pub(crate) mod crossing;
mod domain;
mod error;
pub(crate) mod fixed_mesh;
pub(crate) mod force;
mod listing;
mod locate;
mod network;
pub(crate) mod pieces;
mod pixels;
pub(crate) mod repeats;
mod snap;
mod status;
mod sweep;
#[cfg(test)]
mod tests;
mod triangulate;

pub use constrain::{constrain, constrain_numbers};
pub use constrained::Constrained;
pub use crossing::{Fraction, Place};
pub use error::Error;
pub use pieces::Pieces;
pub use snap::{snap, SnapError, Snapped, SNAP_BITS};
pub use triangulate::{triangulate, triangulate_numbers, TriangulateError, Triangulated};

pub use crate::plan::{Domain, Mark, Plan, UnknownDomain};
