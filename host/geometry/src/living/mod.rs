//! A Delaunay triangulation that can be asked and changed: points come, go and move, and the mesh stays canonical.
//!
//! Use a [`Triangulation`] if points change and you need the mesh in between, or if you ask which triangle holds a
//! place. For the mesh of a set that does not change, [`cpu::triangulate`](crate::cpu::triangulate) is several times
//! quicker. The page `docs/living.md` of the repository has the contract, the costs, and what is not there yet.
//!
//! | you want | call | cost |
//! |---|---|---|
//! | a first set of points | [`Triangulation::from`] | O(n) on even sets, about 1 µs a point |
//! | a change of one point | [`insert`], [`delete`], [`move_to`] | 0.3 µs near the last place, some µs elsewhere |
//! | an edge that must be there | [`insert_constraint`], [`remove_constraint`] | O(n) for the first; see there |
//! | all points at other places | [`move_all`] | 0.2 µs a point for short steps |
//! | what a place is | [`locate`] | 0.1 µs near the last place, some µs elsewhere |
//! | the points near a place | [`nearest`], [`k_nearest`] | O(k log k) beside `locate` |
//! | the points of a region | [`within_circle`], [`within_rectangle`] | O(k log k) beside `locate` |
//! | the triangles that a line crosses | [`segment`] | O(t) beside `locate` |
//! | what is around a point | [`neighbors`], [`star`] | O(k) |
//! | the whole mesh | [`mesh`], [`triangles`], [`edges`], [`hull`] | O(n); `mesh` about 0.3 µs a point |
//!
//! [`insert`]: Triangulation::insert
//! [`delete`]: Triangulation::delete
//! [`move_to`]: Triangulation::move_to
//! [`insert_constraint`]: Triangulation::insert_constraint
//! [`remove_constraint`]: Triangulation::remove_constraint
//! [`move_all`]: Triangulation::move_all
//! [`locate`]: Triangulation::locate
//! [`nearest`]: Triangulation::nearest
//! [`k_nearest`]: Triangulation::k_nearest
//! [`within_circle`]: Triangulation::within_circle
//! [`within_rectangle`]: Triangulation::within_rectangle
//! [`segment`]: Triangulation::segment
//! [`neighbors`]: Triangulation::neighbors
//! [`star`]: Triangulation::star
//! [`mesh`]: Triangulation::mesh
//! [`triangles`]: Triangulation::triangles
//! [`edges`]: Triangulation::edges
//! [`hull`]: Triangulation::hull
//!
//! **How it works, file by file.** `level` holds the vertices of a mesh and `plane` its triangles and ghost triangles;
//! points on one line are a state without triangles (`line`). `walk` finds a place, and `climb` the nearest vertex.
//! `cavity` adds a vertex, `hole` and `large_hole` remove one, `flips` moves one, and `sweep` moves all.
//! `triangulation` is a Delaunay hierarchy of such levels, in which about one vertex in 32 is also in the level above,
//! chosen by a hash of its number. `names` keeps which vertex has the point of an index. `load` and `link` take the
//! mesh of the CPU triangulator over, and `answer` gives a mesh back. `constrain` has the constraints, and
//! `constrained` the mesh with them: `parts` says which edges are fixed, `straight` walks in it, and `ears` removes a
//! vertex. All predicates are exact and contain the tie rule (`site`).

mod answer;
mod cavity;
mod change;
mod climb;
mod constrain;
mod constrained;
mod constraint_list;
mod ears;
mod error;
mod flips;
mod frame;
mod hole;
mod iterate;
mod large_hole;
mod level;
mod line;
mod link;
mod load;
mod names;
mod near;
mod parts;
pub(crate) mod plane;
mod queries;
mod rectangle;
mod segment;
mod star;
mod straight;
mod sweep;
#[cfg(test)]
mod tests;
mod triangulation;
mod walk;

pub use error::Error;
pub use queries::Location;
pub use triangulation::Triangulation;
