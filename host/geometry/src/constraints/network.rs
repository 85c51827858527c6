//! The triangles of a mesh whose edges may be fixed.

use alloc::vec::Vec;

use super::error::Error;
use crate::living::plane::{Plane, Side, INFINITE, NEXT};
use crate::pages::zeros;
use crate::site::Site;

/// Marks a triangle that the constraint at hand crosses.
const CROSSED: u8 = 1 << 3;
/// Marks a triangle that was written since the mesh was loaded.
const CHANGED: u8 = 1 << 4;

/// An edge of a chain: its first end, its side outside the chain, and whether it is fixed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub from: u32,
    pub outside: Side,
    pub is_fixed: bool,
}

/// A mesh with ghost triangles, some of whose edges are fixed: no flip removes them.
pub(super) struct Network<'a, S: Site> {
    pub sites: &'a [S],
    pub plane: Plane,
    /// Marks of each triangle: a bit for each side whose edge is fixed, and [`CROSSED`] and [`CHANGED`].
    marks: Vec<u8>,
    /// One of the triangles at each vertex that is an end of a constraint or of one of its pieces.
    at: Vec<u32>,
    /// The edges that may have to be flipped.
    pub stack: Vec<Side>,
    /// The triangles that the constraint at hand crosses, and the chains of edges around them. Each is empty between
    /// two steps and kept for its memory.
    pub crossed: Vec<u32>,
    pub left: Vec<Link>,
    pub right: Vec<Link>,
    pub chain: Vec<Link>,
    /// Ghost triangles that are linked to nothing.
    pub spare: Vec<u32>,
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
        let [left, right, chain] = [(); 3].map(|()| Vec::new());
        Ok(Self {
            sites,
            plane,
            marks,
            at,
            stack: Vec::new(),
            crossed: Vec::new(),
            left,
            right,
            chain,
            spare: Vec::new(),
        })
    }

    #[inline(always)]
    pub fn site(&self, vertex: u32) -> S {
        self.sites[vertex as usize]
    }

    /// Whether the edge is fixed.
    #[inline(always)]
    pub fn is_fixed(&self, side: Side) -> bool {
        self.marks[side.triangle() as usize] >> side.slot() & 1 != 0
    }

    /// Fixes an edge, on both of its sides.
    pub fn fix(&mut self, side: Side) {
        for side in [side, self.plane.across(side)] {
            self.marks[side.triangle() as usize] |= 1 << side.slot();
        }
    }

    /// Writes a triangle, with what lies behind its three sides.
    pub fn write(&mut self, triangle: u32, vertices: [u32; 3], links: [(Side, bool); 3]) {
        self.plane.set(triangle, vertices, links.map(|(outside, _)| outside));
        let mut marks = CHANGED;
        for (slot, (outside, is_fixed)) in links.into_iter().enumerate() {
            self.plane.link(Side::new(triangle, slot), outside);
            marks |= u8::from(is_fixed) << slot;
        }
        self.marks[triangle as usize] = marks;
        vertices.iter().for_each(|&vertex| self.at[vertex as usize] = triangle);
    }

    /// A ghost triangle that is linked to nothing, with no edge fixed.
    pub fn take_spare(&mut self) -> u32 {
        let triangle = self.spare.pop().unwrap_or_else(|| {
            self.marks.push(0);
            self.plane.allocate()
        });
        self.plane.set(triangle, [0, 1, INFINITE], [Side::new(triangle, 2); 3]);
        triangle
    }

    /// The triangle from which the triangles around an end of a constraint are found.
    pub fn triangle_at(&self, vertex: u32) -> u32 {
        self.at[vertex as usize]
    }

    /// Says in which triangle an end of a piece is.
    pub fn note(&mut self, vertex: u32, triangle: u32) {
        self.at[vertex as usize] = triangle;
    }

    /// The sides opposite a vertex in the triangles around it, counter-clockwise from the triangle `first`, those of
    /// ghost triangles left out. No side comes twice, so the walk ends on any list of triangles.
    pub fn around(&self, vertex: u32, first: u32) -> impl Iterator<Item = Side> + '_ {
        let opposite = move |triangle: u32| {
            let record = self.plane.get(triangle);
            let slot = record.slot_of(vertex);
            (record.vertices[slot] == vertex).then(|| Side::new(triangle, slot))
        };
        let mut left = self.plane.len();
        let next = move |side: &Side| {
            left = left.checked_sub(1)?;
            let next = self.plane.across(Side::new(side.triangle(), NEXT[side.slot()])).triangle();
            (next != first).then(|| opposite(next))?
        };
        let all = core::iter::successors(opposite(first), next);
        all.filter(|side| self.plane.get(side.triangle()).infinite_slot().is_none())
    }

    /// Whether a triangle was written since the mesh was loaded.
    pub fn is_changed(&self, triangle: u32) -> bool {
        self.marks[triangle as usize] & CHANGED != 0
    }

    /// Marks a triangle that a constraint crosses, until it is written.
    pub fn mark_crossed(&mut self, triangle: u32) {
        self.marks[triangle as usize] |= CROSSED;
    }

    /// Whether a triangle has the mark of [`mark_crossed`](Self::mark_crossed).
    pub fn is_crossed(&self, triangle: u32) -> bool {
        self.marks[triangle as usize] & CROSSED != 0
    }

    /// Whether a triangle is a ghost triangle.
    pub fn is_ghost(&self, triangle: u32) -> bool {
        self.plane.get(triangle).vertices.contains(&INFINITE)
    }

    /// Both ends of an edge in rising order.
    pub fn edge(&self, side: Side) -> [u32; 2] {
        let [a, b] = self.plane.ends(side);
        [a.min(b), a.max(b)]
    }

    /// Flips edges until the mesh is canonical. All edges that may have to be flipped are on the stack.
    ///
    /// # Errors
    /// A flip would turn a triangle over, which happens in no mesh.
    pub fn repair(&mut self) -> Result<(), Error> {
        while let Some(side) = self.stack.pop() {
            if self.must_flip(side) {
                self.flip(side)?;
            }
        }
        Ok(())
    }

    /// Whether the edge is free, inside the hull, and not one of the canonical mesh.
    #[inline]
    fn must_flip(&self, side: Side) -> bool {
        let other = self.plane.across(side);
        let (apex, triangle) = (self.plane.apex(other), self.plane.get(side.triangle()));
        let is_free = !self.is_fixed(side) && apex != INFINITE && triangle.infinite_slot().is_none();
        is_free && S::conflicts(triangle.vertices.map(|vertex| self.site(vertex)), self.site(apex))
    }

    /// Replaces an edge by the other diagonal, and puts the four edges around both triangles on the stack.
    ///
    /// ```text
    ///      p            p
    ///     / \          /|\
    ///    a---b   ->   a | b
    ///     \ /          \|/
    ///      q            q
    /// ```
    fn flip(&mut self, side: Side) -> Result<(), Error> {
        let other = self.plane.across(side);
        let ([a, b], p, q) = (self.plane.ends(side), self.plane.apex(side), self.plane.apex(other));
        // On the triangles of a mesh this always holds. On any others, flips shrink the sum of the areas or lower the
        // lifted surface, so they end.
        let is_left = |corners: [u32; 3]| {
            let [one, two, three] = corners.map(|vertex| self.site(vertex));
            S::orient2d(one, two, three).is_gt()
        };
        if !is_left([p, a, q]) || !is_left([q, b, p]) {
            return Err(Error::NoMesh);
        }
        let [bp, pa, aq, qb] = [side.next(), side.last(), other.next(), other.last()]
            .map(|side| (self.plane.across(side), self.is_fixed(side)));
        let (one, two) = (side.triangle(), other.triangle());
        let (new, back) = (Side::new(one, 1), Side::new(two, 1));
        self.write(one, [p, a, q], [aq, (back, false), pa]);
        self.write(two, [q, b, p], [bp, (new, false), qb]);
        let around = [Side::new(one, 0), Side::new(one, 2), Side::new(two, 0), Side::new(two, 2)];
        self.stack.extend(around);
        Ok(())
    }
}
