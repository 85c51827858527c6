//! The triangles of a mesh whose edges may be fixed.

use alloc::vec::Vec;

use super::error::Error;
use super::fixed_mesh::{FixedMesh, Work};
use crate::living::plane::{Plane, Side, INFINITE};
use crate::pages::zeros;
use crate::site::Site;

/// Marks a triangle that the constraint at hand crosses.
const CROSSED: u8 = 1 << 3;
/// Marks a triangle that was written since the mesh was loaded.
const CHANGED: u8 = 1 << 4;

/// A mesh with ghost triangles, some of whose edges are fixed: no flip removes them.
pub(super) struct Network<'a, S: Site> {
    pub sites: &'a [S],
    pub plane: Plane,
    /// Marks of each triangle: a bit for each side whose edge is fixed, and [`CROSSED`] and [`CHANGED`].
    marks: Vec<u8>,
    /// One of the triangles at each vertex that is an end of a constraint or of one of its pieces.
    at: Vec<u32>,
    work: Work,
    /// Ghost triangles that are linked to nothing.
    spare: Vec<u32>,
}

impl<'a, S: Site> Network<'a, S> {
    /// Links the triangles of a mesh whose indices are those of `sites`. `ends` are the ends of all constraints. O(n).
    ///
    /// # Errors
    /// A list names a point that does not exist, or the triangles are not sorted.
    pub fn new(sites: &'a [S], triangles: &[[u32; 3]], hull: &[u32], ends: &[[u32; 2]]) -> Result<Self, Error> {
        let is_site = |&index: &u32| (index as usize) < sites.len();
        if !triangles.as_flattened().iter().chain(hull).all(is_site) {
            return Err(Error::NoMesh);
        }
        let has_corners = |&[a, b, c]: &[u32; 3]| a < b && a < c && b != c;
        if !triangles.iter().all(has_corners) || !triangles.is_sorted_by(|one, other| one < other) {
            return Err(Error::NoMesh);
        }
        let mut plane = Plane::default();
        plane.load(triangles, hull, sites.len());
        // Bits fit the cache, where a number for each corner of each triangle would not.
        let mut is_end: Vec<u64> = zeros(sites.len() / 64 + 1);
        ends.as_flattened().iter().for_each(|&end| is_end[end as usize / 64] |= 1 << (end % 64));
        let mut at = zeros(sites.len());
        for (triangle, corners) in (0u32..).zip(triangles) {
            for &corner in corners {
                if is_end[corner as usize / 64] >> (corner % 64) & 1 != 0 {
                    at[corner as usize] = triangle;
                }
            }
        }
        let marks = zeros(plane.end() as usize);
        Ok(Self { sites, plane, marks, at, work: Work::default(), spare: Vec::new() })
    }

    /// Whether a triangle was written since the mesh was loaded.
    pub fn is_changed(&self, triangle: u32) -> bool {
        self.marks[triangle as usize] & CHANGED != 0
    }
}

impl<S: Site> FixedMesh for Network<'_, S> {
    type Site = S;

    #[inline(always)]
    fn site(&self, vertex: u32) -> S {
        self.sites[vertex as usize]
    }

    #[inline(always)]
    fn plane(&self) -> &Plane {
        &self.plane
    }

    #[inline(always)]
    fn plane_mut(&mut self) -> &mut Plane {
        &mut self.plane
    }

    #[inline(always)]
    fn work(&mut self) -> &mut Work {
        &mut self.work
    }

    #[inline(always)]
    fn is_fixed(&self, side: Side) -> bool {
        self.marks[side.triangle() as usize] >> side.slot() & 1 != 0
    }

    fn fix(&mut self, side: Side) {
        for side in [side, self.plane.across(side)] {
            self.marks[side.triangle() as usize] |= 1 << side.slot();
        }
    }

    fn write(&mut self, triangle: u32, vertices: [u32; 3], links: [(Side, bool); 3]) {
        self.plane.set(triangle, vertices, links.map(|(outside, _)| outside));
        let mut marks = CHANGED;
        for (slot, (outside, is_fixed)) in links.into_iter().enumerate() {
            self.plane.link(Side::new(triangle, slot), outside);
            marks |= u8::from(is_fixed) << slot;
        }
        self.marks[triangle as usize] = marks;
        vertices.iter().for_each(|&vertex| self.at[vertex as usize] = triangle);
    }

    fn triangle_at(&self, vertex: u32) -> u32 {
        self.at[vertex as usize]
    }

    fn note(&mut self, vertex: u32, triangle: u32) {
        self.at[vertex as usize] = triangle;
    }

    fn mark_crossed(&mut self, triangle: u32) {
        self.marks[triangle as usize] |= CROSSED;
    }

    fn is_crossed(&self, triangle: u32) -> bool {
        self.marks[triangle as usize] & CROSSED != 0
    }

    fn take_spare(&mut self) -> u32 {
        let triangle = self.spare.pop().unwrap_or_else(|| {
            self.marks.push(0);
            self.plane.allocate()
        });
        self.plane.set(triangle, [0, 1, INFINITE], [Side::new(triangle, 2); 3]);
        triangle
    }

    fn give_spare(&mut self, triangle: u32) {
        self.spare.push(triangle);
    }
}
