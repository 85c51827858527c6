//! The engine: the fastest way to the mesh on a processor, by divide and conquer with exact integers, on any number of
//! threads.
//!
//! [`triangulate`] is the whole of it. The mesh is the one that every device gives, byte for byte, since there is only
//! one.
//!
//! How it works, file by file: points are sorted along a Z-curve (`sites`), which is the tree that they are divided by
//! (`conquer`, on several threads `stretches`); two parts are joined along their common border (`merge`, `edges`), with
//! predicates that never round, in which the tie rule enters (`view`); edges in the order of the curve name the
//! triangles, which are sorted (`collect`). Before they are sorted, points and triangles are dealt to buckets, each of
//! which is sorted in the cache (`deal`).
//!
//! Lawson's and Delaunay's theorems make the joined parts right for any lifting of the points onto a strictly convex
//! surface, and the tie rule is one: the paraboloid, each point lowered by an amount that is infinitely small, and
//! infinitely smaller than that of all lexicographically smaller ones. So the tie rule need not be restored at the end:
//! every part, at every moment, is canonical.

mod collect;
mod conquer;
mod deal;
mod edges;
mod engine;
mod merge;
#[cfg(test)]
mod oracle;
mod parallel;
mod sites;
#[cfg(feature = "std")]
mod stretches;
#[cfg(test)]
mod tests;
mod view;

pub use engine::{threads_for, triangulate, Error, Progress, Stage, Watch};
