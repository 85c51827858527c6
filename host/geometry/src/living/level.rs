//! One level of the hierarchy: a mesh of points that can be changed.
//!
//! **States.** Points on one line (none, one and two included) are kept in lexicographic order, in which neighbours on
//! the line are neighbours in the list, and there are no triangles. All other sets have triangles and ghost triangles,
//! in which each edge has two sides. A level goes from one state to the other when the first point off the line comes
//! and when the last one goes.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;

use super::plane::{make_room, Plane, Side, INFINITE};
use crate::plane_point::PlanePoint;
use crate::site::Site;

/// Marks, as the triangle of a vertex, that the vertex is free.
const FREE: u32 = u32::MAX;
/// Marks the end of the list of free vertices.
const NONE: u32 = u32::MAX;

/// A place of the plane that has a point.
#[derive(Clone, Copy, Debug)]
pub struct Vertex<P> {
    pub point: P,
    /// One of the triangles around the vertex; of no meaning while all points lie on one line.
    pub triangle: u32,
    /// In the lowest level the lowest living index of the place, in all others the vertex in the level below. A free
    /// vertex has the number of the next free one here.
    pub name: u32,
}

/// An edge of the border of a hole in the mesh: its first end, and its side outside the hole.
#[derive(Clone, Copy, Debug)]
pub struct Border {
    pub from: u32,
    pub outside: Side,
}

/// A part of a hole: the edges of its border from one place to another, closed by a chord from the last vertex to the
/// first.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    pub first: usize,
    pub last: usize,
    /// The side of the chord outside the part.
    pub chord: Side,
}

/// A mesh that can be changed.
#[derive(Clone, Debug)]
pub struct Level<P: PlanePoint> {
    pub vertices: Vec<Vertex<P>>,
    free: u32,
    pub count: usize,
    /// All vertices in lexicographic order, while they lie on one line; else empty.
    pub line: BTreeMap<P::Site, u32>,
    /// The triangles; none while all vertices lie on one line.
    pub plane: Plane,
    /// Lists that are kept so that a change allocates nothing.
    pub stack: Vec<Side>,
    /// The sides of a star that a walk found clockwise.
    pub behind: Vec<Side>,
    pub dead: Vec<u32>,
    /// The triangles that the last removal made.
    pub made: Vec<u32>,
    pub border: Vec<Border>,
    /// The first end of each edge of the border around a star.
    pub ring: Vec<P::Site>,
    /// The parts of a hole that are still to be filled.
    pub parts: Vec<Part>,
}

impl<P: PlanePoint> Default for Level<P> {
    fn default() -> Self {
        Self {
            vertices: Vec::new(),
            free: NONE,
            count: 0,
            line: BTreeMap::new(),
            plane: Plane::default(),
            stack: Vec::new(),
            behind: Vec::new(),
            dead: Vec::new(),
            made: Vec::new(),
            border: Vec::new(),
            ring: Vec::new(),
            parts: Vec::new(),
        }
    }
}

impl<P: PlanePoint> Level<P> {
    /// Whether there are triangles.
    #[inline(always)]
    pub fn is_plane(&self) -> bool {
        self.plane.len() > 0
    }

    /// The coordinates of a vertex other than the infinite one.
    #[inline(always)]
    pub fn site(&self, vertex: u32) -> P::Site {
        self.vertices[vertex as usize].point.site()
    }

    /// Whether the number is that of a vertex and not of a free place.
    #[inline]
    pub fn is_vertex(&self, vertex: u32) -> bool {
        self.vertices.get(vertex as usize).is_some_and(|vertex| vertex.triangle != FREE)
    }

    /// Some vertex, if there is one.
    pub fn any_vertex(&self) -> Option<u32> {
        if self.is_plane() {
            let ghost = self.plane.get(self.plane.ghost);
            ghost.vertices.into_iter().find(|&vertex| vertex != INFINITE)
        } else {
            self.line.values().next().copied()
        }
    }

    /// Some vertex with an edge to this one, if there is one.
    pub fn some_neighbor(&self, vertex: u32) -> Option<u32> {
        if self.is_plane() {
            let ends = self.plane.ends(self.side_opposite(vertex));
            return ends.into_iter().find(|&end| end != INFINITE);
        }
        None
    }

    /// The bytes that vertices and triangles take.
    pub fn bytes(&self) -> usize {
        size_of::<Vertex<P>>() * self.vertices.capacity() + self.plane.bytes()
    }

    /// Makes a vertex without a triangle.
    pub fn allocate(&mut self, point: P, name: u32) -> u32 {
        self.count += 1;
        let made = Vertex { point, triangle: 0, name };
        if self.free != NONE {
            let vertex = self.free;
            self.free = self.vertices[vertex as usize].name;
            self.vertices[vertex as usize] = made;
            return vertex;
        }
        make_room(&mut self.vertices);
        self.vertices.push(made);
        (self.vertices.len() - 1) as u32
    }

    /// Frees a vertex. The vertex that is made next takes its number.
    pub fn release(&mut self, vertex: u32) {
        self.count -= 1;
        let freed = &mut self.vertices[vertex as usize];
        (freed.triangle, freed.name) = (FREE, self.free);
        self.free = vertex;
    }

    /// Notes a triangle of a vertex.
    #[inline(always)]
    pub fn note(&mut self, vertex: u32, triangle: u32) {
        if vertex == INFINITE {
            self.plane.ghost = triangle;
        } else {
            self.vertices[vertex as usize].triangle = triangle;
        }
    }

    /// The side of one of the triangles around a vertex that lies opposite the vertex.
    #[inline]
    pub fn side_opposite(&self, vertex: u32) -> Side {
        let triangle = self.vertices[vertex as usize].triangle;
        Side::new(triangle, self.plane.get(triangle).slot_of(vertex))
    }

    /// Whether a triangle conflicts with a place that is no vertex.
    #[inline]
    pub fn conflicts(&self, triangle: u32, q: P::Site) -> bool {
        let found = self.plane.get(triangle);
        if let Some(slot) = found.infinite_slot() {
            let [a, b] = self.plane.hull_edge(triangle, slot).map(|vertex| self.site(vertex));
            let turn = P::Site::orient2d(a, b, q);
            return turn.is_lt() || turn.is_eq() && P::Site::is_between(a, q, b);
        }
        P::Site::conflicts(found.vertices.map(|vertex| self.site(vertex)), q)
    }

    /// Whether the place lies strictly beyond the hull edge of a ghost triangle.
    pub fn is_beyond(&self, ghost: u32, q: P::Site) -> bool {
        let slot = self.plane.get(ghost).slot_of(INFINITE);
        let [a, b] = self.plane.hull_edge(ghost, slot).map(|vertex| self.site(vertex));
        P::Site::orient2d(a, b, q).is_lt()
    }
}
