//! The CPU triangulator: divide and conquer with exact integers, on any number of threads.
//!
//! [`triangulate`] does it all: points in, the canonical mesh out. The mesh is the one that every device gives, byte
//! for byte, because there is only one. Use the CPU triangulator whenever you want the mesh and not the hardware; it is
//! the fastest back end of a usual computer.
//!
//! The algorithm is that of Guibas and Stolfi, *Primitives for the manipulation of general subdivisions and the
//! computation of Voronoi diagrams*, 1985, with alternating cuts (Dwyer, *A faster divide-and-conquer algorithm for
//! constructing Delaunay triangulations*, 1987). File by file:
//!
//! 1. `sites` sorts the points along a Z-curve, whose quadrants form the tree of cuts.
//! 2. `conquer` triangulates the parts of that tree from the leaves up. `leaf` builds parts of up to four vertices.
//!    Larger sets are cut into `subtrees`, whose half-edges have numbers of 16 bits (`short`), and `segments` deals
//!    the subtrees to threads.
//! 3. `merge` joins two parts along their common border, on the half-edges of `edges`, with the predicates of `view`,
//!    which never round and contain the tie rule.
//! 4. `collect` finds the triangles at the edges, in the order of the curve, and sorts them.
//!
//! [`Triangulator`] does the same for many small sets, in memory that it keeps (`small`).
//!
//! Before points and triangles are sorted, `buckets` distributes them to buckets that are small enough to be
//! sorted in the cache.
//!
//! **Why the tie rule needs no step of its own.** Lawson's and Delaunay's theorems make the joined parts right
//! for any lifting of the points onto a strictly convex surface, and the tie rule is such a lifting: the
//! paraboloid, with each point lowered by an amount that is infinitely small, and infinitely smaller than the
//! amounts of all lexicographically smaller points. So the tie rule need not be restored at the end: every part,
//! at every moment, is canonical.

mod buckets;
mod collect;
mod conquer;
mod edges;
mod filtered;
mod filtered_sites;
mod kernel;
mod leaf;
mod merge;
#[cfg(test)]
mod oracle;
mod parallel;
#[cfg(feature = "std")]
mod segments;
mod short;
mod sites;
mod small;
mod subtrees;
#[cfg(test)]
mod tests;
mod triangulator;
mod view;

pub use small::Triangulator;
pub use triangulator::{
    connect, connect_doubles, connect_integers, threads_for, triangulate, Connectivity, Error, Progress, Stage, Watch,
};
