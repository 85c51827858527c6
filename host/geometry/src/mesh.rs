//! The answer: the canonical mesh of a point set.

use alloc::vec;
use alloc::vec::Vec;

use crate::edges::EdgeList;
use crate::point::{Duplicate, Point};
use crate::verify::{self, VerifyError};

/// "No half-edge": the other side of an edge on the hull, in [`Mesh::halfedges`].
pub const EMPTY: u32 = u32::MAX;

/// The Delaunay triangulation of the distinct points, in canonical form.
///
/// There is exactly one answer for a set of points: every device and every order of insertion gives the same
/// `triangles` and the same `hull`. Two meshes are equal if all four lists are.
#[non_exhaustive]
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Mesh {
    /// The input points, in input order, duplicates included.
    pub points: Vec<Point>,
    /// Triples of indices into `points`, counter-clockwise, each with its smallest index first, sorted.
    pub triangles: Vec<[u32; 3]>,
    /// Indices of the points on the hull, counter-clockwise, lowest index first; points in the middle of a hull edge
    /// are included. Without triangles: all distinct points in lexicographic order.
    pub hull: Vec<u32>,
    /// Points that fell onto an earlier one, by index.
    pub duplicates: Vec<Duplicate>,
}

impl Mesh {
    /// A mesh of these parts. Nothing is checked: see [`Mesh::verify`].
    pub fn new(points: Vec<Point>, triangles: Vec<[u32; 3]>, hull: Vec<u32>, duplicates: Vec<Duplicate>) -> Self {
        Self { points, triangles, hull, duplicates }
    }

    /// There are no triangles: fewer than three distinct points, or all on one line.
    pub fn is_collinear(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The neighbours of each triangle: the `k`-th is across the edge opposite the `k`-th vertex; `None` on the hull.
    ///
    /// O(n): a radix sort of the edges; 190 bytes per point while it runs.
    pub fn neighbors(&self) -> Vec<[Option<u32>; 3]> {
        let mut neighbors = vec![[None; 3]; self.triangles.len()];
        for [one, other] in EdgeList::of(&self.triangles).pairs() {
            for (from, to) in [(one, other), (other, one)] {
                let (triangle, side) = (from / 3, from % 3);
                neighbors[triangle as usize][(side as usize + 2) % 3] = Some(to / 3);
            }
        }
        neighbors
    }

    /// Half-edges in delaunator's convention: half-edge `3 t + k` runs from vertex `k` of triangle `t` to the next one,
    /// and its value is the half-edge of the same edge in the other triangle, or [`EMPTY`] on the hull.
    ///
    /// O(n), as [`Mesh::neighbors`].
    pub fn halfedges(&self) -> Vec<u32> {
        let mut halfedges = vec![EMPTY; 3 * self.triangles.len()];
        for [one, other] in EdgeList::of(&self.triangles).pairs() {
            halfedges[one as usize] = other;
            halfedges[other as usize] = one;
        }
        halfedges
    }

    /// Checks the whole mesh with the independent validator, hull and duplicates included. O(n log n).
    ///
    /// # Errors
    /// The first thing found wrong, with its numbers.
    pub fn verify(&self) -> Result<(), VerifyError> {
        let summary = verify::verify(&self.points, &self.triangles)?;
        verify::check_hull(&self.hull, &summary)?;
        verify::check_duplicates(&self.points, &self.duplicates)
    }
}
