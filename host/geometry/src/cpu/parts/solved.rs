//! A part that has been triangulated, divided into final triangles and the half-edges of its border.

use alloc::vec;
use alloc::vec::Vec;

use super::super::triangulator::is_collinear;
use super::super::view::{Integers, Site, Widest};
use super::open::take_open;
use super::rings::Rings;
use super::{Parts, Unsound};

/// A vertex that is not at the border.
const INSIDE: u32 = u32::MAX;

/// The mesh of one part, ready to be joined; see [`Parts::solved`]. Final triangles are kept as they are, and all other
/// triangles become half-edges.
#[derive(Debug)]
pub struct SolvedPart {
    pub(super) part: usize,
    /// The number of points of the part.
    pub(super) count: usize,
    /// The vertices of the border, along the curve: corners of triangles that are not final, and the hull.
    pub(super) vertices: Vec<u32>,
    /// The place of each vertex of the border.
    pub(super) sites: Vec<Site>,
    pub(super) rings: Rings,
    /// The final triangles, by the indices of the part.
    pub(super) finals: Vec<[u32; 3]>,
}

impl SolvedPart {
    /// The number of vertices at the border, which take part in the join.
    pub fn border(&self) -> usize {
        self.sites.len()
    }

    /// The number of triangles that need no join.
    pub fn finals(&self) -> usize {
        self.finals.len()
    }
}

impl Parts {
    /// Takes the mesh of a part: the triangles and the hull of [`Parts::points`], by the indices of these points, as in
    /// [`Mesh`](crate::Mesh). The triangles may stand in any order. Several threads may call this at once, each for
    /// other parts.
    ///
    /// O(n) for a part of n points: a look at each triangle, a test for those near the sides of the part, and
    /// half-edges for about `5.5 sqrt(n)` vertices.
    ///
    /// # Errors
    /// The mesh cannot be that of the part. This finds only what would be in the way of the join: callers that do not
    /// trust the source of the mesh call [`Mesh::verify`](crate::Mesh::verify) before.
    pub fn solved(&self, part: usize, mut triangles: Vec<[u32; 3]>, hull: &[u32]) -> Result<SolvedPart, Unsound> {
        let range = self.range(part).ok_or(Unsound)?;
        let sites = &self.sites[range.clone()];
        if hull.is_empty() || hull.iter().any(|&v| v as usize >= sites.len()) {
            return Err(Unsound);
        }
        let is_line = triangles.is_empty();
        let is_in_order = || hull.is_sorted_by(|&a, &b| sites[a as usize] < sites[b as usize]);
        if is_line && (hull.len() != sites.len() || !is_in_order() || !is_collinear::<Integers<Widest>>(sites)) {
            return Err(Unsound);
        }
        // The final triangles stay in their list, and most of them are not written again.
        let mut open = take_open(&mut triangles, hull, sites, &self.region(&range), self.far)?;
        let Border { vertices, numbers } = Border::of(&open, hull, sites.len());
        open.iter_mut().flatten().for_each(|v| *v = numbers[*v as usize]);
        let hull: Vec<u32> = hull.iter().map(|&v| numbers[v as usize]).collect();
        let count = sites.len();
        let sites: Vec<Site> = vertices.iter().map(|&v| sites[v as usize]).collect();
        let rings = if is_line { Rings::of_line(&sites, &hull) } else { Rings::of(&sites, &open, &hull)? };
        Ok(SolvedPart { part, count, vertices, sites, rings, finals: triangles })
    }
}

/// The vertices at the border of a part.
struct Border {
    /// The vertices, along the curve.
    vertices: Vec<u32>,
    /// For each vertex of the part, its place in `vertices`, or [`INSIDE`].
    numbers: Vec<u32>,
}

impl Border {
    fn of(open: &[[u32; 3]], hull: &[u32], count: usize) -> Self {
        let mut numbers = vec![INSIDE; count];
        open.iter().flatten().chain(hull).for_each(|&v| numbers[v as usize] = 0);
        // Every vertex is written, and the counter keeps the right ones: no processor would predict a branch.
        let mut vertices = vec![0; count];
        let mut border = 0;
        for (number, v) in numbers.iter_mut().zip(0..) {
            let is_inside = *number == INSIDE;
            vertices[border] = v;
            *number = if is_inside { INSIDE } else { border as u32 };
            border += usize::from(!is_inside);
        }
        vertices.truncate(border);
        vertices.shrink_to_fit();
        Self { vertices, numbers }
    }
}
