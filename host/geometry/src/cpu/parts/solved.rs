//! A part that has been triangulated, divided into final triangles and the half-edges of its border.

use alloc::vec;
use alloc::vec::Vec;

use super::super::triangulator::is_collinear;
use super::super::view::{Integers, Site, Widest};
use super::rings::Rings;
use super::{Parts, Unsound};
use crate::mesh::smallest_first;
use crate::point::Point;
use crate::tiles::reach::{Reach, TilePoint};

/// A vertex that is not at the border.
const INSIDE: u32 = u32::MAX;

/// The mesh of one part, ready to be joined; see [`Parts::solved`]. Final triangles are kept as they are, and all other
/// triangles become half-edges.
#[derive(Debug)]
pub struct SolvedPart {
    pub(super) part: usize,
    /// The vertices of the border, along the curve: corners of triangles that are not final, and the hull.
    pub(super) sites: Vec<Site>,
    /// The input index of each vertex of the border.
    pub(super) ids: Vec<u32>,
    pub(super) rings: Rings,
    /// The final triangles by input index, smallest index first.
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
    /// O(n) for a part of n points: a test for each triangle, and half-edges for about `5.5 sqrt(n)` vertices.
    ///
    /// # Errors
    /// The mesh cannot be that of the part. This finds only what would be in the way of the join: callers that do not
    /// trust the source of the mesh call [`Mesh::verify`](crate::Mesh::verify) before.
    pub fn solved(&self, part: usize, mut triangles: Vec<[u32; 3]>, hull: &[u32]) -> Result<SolvedPart, Unsound> {
        let range = self.range(part).ok_or(Unsound)?;
        let (sites, ids) = (&self.sites[range.clone()], &self.ids[range.clone()]);
        let largest = |list: &[u32]| list.iter().fold(0, |largest, &v| largest.max(v)) as usize;
        if hull.is_empty() || largest(hull).max(largest(triangles.as_flattened())) >= sites.len() {
            return Err(Unsound);
        }
        let is_line = triangles.is_empty();
        let is_in_order = || hull.is_sorted_by(|&a, &b| sites[a as usize] < sites[b as usize]);
        if is_line && (hull.len() != sites.len() || !is_in_order() || !is_collinear::<Integers<Widest>>(sites)) {
            return Err(Unsound);
        }
        let point = |v: u32| Point::new(sites[v as usize].x(), sites[v as usize].y());
        let sides = Point::sides(&self.region(&range));
        let mut open = Vec::new();
        // The final triangles stay in their list, whose memory the processor has in its cache.
        let mut finals = 0;
        for place in 0..triangles.len() {
            let corners = triangles[place];
            if Point::reach(&sides, corners.map(point)) == Reach::Within {
                triangles[finals] = smallest_first(corners.map(|v| ids[v as usize]));
                finals += 1;
            } else {
                open.push(corners);
            }
        }
        triangles.truncate(finals);
        let border = Border::of(&open, hull, sites.len());
        let own = border.vertices.iter().map(|&v| v as usize);
        let (border_sites, border_ids): (Vec<Site>, Vec<u32>) = own.map(|v| (sites[v], ids[v])).unzip();
        open.iter_mut().flatten().for_each(|v| *v = border.numbers[*v as usize]);
        let hull: Vec<u32> = hull.iter().map(|&v| border.numbers[v as usize]).collect();
        let rings =
            if is_line { Rings::of_line(&border_sites, &hull) } else { Rings::of(&border_sites, &open, &hull)? };
        Ok(SolvedPart { part, sites: border_sites, ids: border_ids, rings, finals: triangles })
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
        let mut vertices = Vec::with_capacity(open.len());
        for (number, v) in numbers.iter_mut().zip(0..).filter(|(number, _)| **number != INSIDE) {
            *number = vertices.len() as u32;
            vertices.push(v);
        }
        Self { vertices, numbers }
    }
}
