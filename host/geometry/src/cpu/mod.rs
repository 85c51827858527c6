//! The CPU triangulator: divide and conquer with exact integers, on any number of threads.
//!
//! [`triangulate`] takes points and gives the canonical mesh, the same as every device, byte for byte. Use the CPU
//! triangulator whenever you want the mesh and not the hardware: no other back end in software is faster.
//!
//! The algorithm is that of Guibas and Stolfi, *Primitives for the manipulation of general subdivisions and the
//! computation of Voronoi diagrams*, 1985, with alternating cuts (Dwyer, *A faster divide-and-conquer algorithm for
//! constructing Delaunay triangulations*, 1987). The cuts lie at the bits of the coordinates and not at medians. So a
//! radix sort is enough, and the tree of cuts has at most `2 w` levels for coordinates of `w` bits. File by file:
//!
//! 1. `sites` sorts the points along a Z-curve, whose quadrants form the tree of cuts.
//! 2. `conquer` triangulates the parts of that tree from the leaves up. `leaf` builds parts of up to four vertices.
//!    Larger sets are cut into `subtrees`, whose half-edges have numbers of 16 bits (`short`), and `segments` deals
//!    the subtrees to threads.
//! 3. `merge` joins two parts along their common border, on the half-edges of `edges`, with the predicates of `view`,
//!    which never round and contain the tie rule.
//! 4. `collect` finds the triangles at the edges, in the order of the curve, and sorts them.
//!
//! `fixed` forces constraints into the half-edges between the steps 3 and 4, for
//! [`constraints::triangulate`](crate::constraints::triangulate).
//!
//! [`Triangulator`] does the same for many small sets, in memory that it keeps (`small`).
//!
//! Before points and triangles are sorted, `buckets` distributes them to buckets that are small enough to be
//! sorted in the cache.
//!
//! **Why the tie rule needs no step of its own.** The tie rule is a lifting: each point goes onto the paraboloid and is
//! then lowered by an infinitely small amount, which is infinitely smaller than the amounts of all lexicographically
//! smaller points (a symbolic perturbation: Edelsbrunner and Mücke, *Simulation of simplicity*, 1990). The canonical
//! mesh is the lower hull of the lifted points: every point is a vertex of that hull, and every face is a triangle. The
//! merge rests on two facts. An edge of the whole mesh between two points of one part is an edge of that part; and a
//! mesh that is convex at each of its edges is the lower hull. Both facts hold for the perturbed lifting as for the
//! plain one. So every part is canonical when its merge ends, and no later step restores the ties.

mod buckets;
mod collect;
mod conquer;
mod edges;
mod filtered;
mod filtered_sites;
mod fixed;
#[cfg(test)]
pub(crate) mod hostile;
mod kernel;
mod leaf;
mod merge;
#[cfg(test)]
mod oracle;
mod parallel;
mod parts;
#[cfg(test)]
mod published;
#[cfg(feature = "std")]
mod segments;
mod short;
mod sites;
mod small;
mod subtrees;
#[cfg(test)]
mod tests;
mod triangulator;
pub(crate) mod view;

pub(crate) use fixed::{connect_fixed, Asked, Forced, Outcome};
pub(crate) use parallel::in_parallel;
pub use parts::{Parts, SolvedPart, Unsound};
pub use small::Triangulator;
pub(crate) use triangulator::tell;
pub use triangulator::{connect, threads_for, triangulate, Connectivity, Error, Progress, Stage, Watch};
