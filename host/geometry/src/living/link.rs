//! Linking a list of triangles to a mesh in which each edge has two sides.

use alloc::vec;
use alloc::vec::Vec;

use super::plane::{Plane, Side, INFINITE, LAST, NEXT};

/// Marks the end of a list of half-edges.
const NONE: u32 = u32::MAX;

/// The half-edges that have not found their other side, in a list for each vertex. An edge is in the list of the end
/// with fewer edges. So all lists together are searched in O(n) time, because the smaller of both degrees, summed over
/// the edges of a planar graph, is O(n) (Chiba and Nishizeki 1985).
struct Waiting {
    /// The first half-edge of each vertex.
    first: Vec<u32>,
    /// The next half-edge of the same list, for each half-edge.
    next: Vec<u32>,
    degrees: Vec<u32>,
}

impl Waiting {
    fn of(triangles: &[[u32; 3]], vertices: usize) -> Self {
        let mut degrees = vec![0; vertices];
        triangles.iter().flatten().for_each(|&vertex| degrees[vertex as usize] += 1);
        Self { first: vec![NONE; vertices], next: vec![NONE; 3 * triangles.len()], degrees }
    }

    /// The vertex in whose list an edge is.
    fn place(&self, [a, b]: [u32; 2]) -> usize {
        let key = |vertex: u32| (self.degrees[vertex as usize], vertex);
        key(a).min(key(b)).1 as usize
    }

    /// Takes out the half-edge with these ends.
    fn take(&mut self, ends: [u32; 2], ends_of: impl Fn(u32) -> [u32; 2]) -> Option<u32> {
        let place = self.place(ends);
        let (mut before, mut half) = (NONE, self.first[place]);
        while half != NONE {
            let next = self.next[half as usize];
            if ends_of(half) == ends {
                match before {
                    NONE => self.first[place] = next,
                    before => self.next[before as usize] = next,
                }
                return Some(half);
            }
            (before, half) = (half, next);
        }
        None
    }

    fn put(&mut self, half: u32, ends: [u32; 2]) {
        let place = self.place(ends);
        self.next[half as usize] = self.first[place];
        self.first[place] = half;
    }
}

impl Plane {
    /// Loads the triangles of a mesh and its hull into a plane without triangles, and adds the ghost triangles.
    pub fn load(&mut self, triangles: &[[u32; 3]], hull: &[u32], vertices: usize) {
        self.reserve(triangles.len() + hull.len());
        for &triangle in triangles {
            let number = self.allocate();
            self.set(number, triangle, [Side::new(0, 0); 3]);
        }
        // Half-edge 3 t + k of triangle t lies opposite its vertex k.
        let side = |half: u32| Side::new(half / 3, half as usize % 3);
        let ends_of = |half: u32| {
            let (triangle, slot) = (triangles[half as usize / 3], half as usize % 3);
            [triangle[NEXT[slot]], triangle[LAST[slot]]]
        };
        let mut waiting = Waiting::of(triangles, vertices);
        for half in 0..3 * triangles.len() as u32 {
            let [from, to] = ends_of(half);
            match waiting.take([to, from], ends_of) {
                Some(other) => self.link(side(half), side(other)),
                None => waiting.put(half, [from, to]),
            }
        }
        for (place, &from) in hull.iter().enumerate() {
            let to = hull[(place + 1) % hull.len()];
            let ghost = self.allocate();
            self.set_ghost(ghost, [from, to]);
            if let Some(half) = waiting.take([from, to], ends_of) {
                self.link(side(half), Side::new(ghost, 2));
            }
        }
        let ghost = |place: usize| (triangles.len() + place % hull.len()) as u32;
        for place in 0..hull.len() {
            self.link(Side::new(ghost(place), 1), Side::new(ghost(place + 1), 0));
        }
    }

    /// Writes the ghost triangle of a hull edge. Its sides 0 and 1 are those to the ghost triangles of the hull edges
    /// before and behind, and side 2 is the hull edge itself.
    pub fn set_ghost(&mut self, ghost: u32, [from, to]: [u32; 2]) {
        self.set(ghost, [to, from, INFINITE], [Side::new(0, 0); 3]);
        self.ghost = ghost;
    }
}
