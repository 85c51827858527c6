//! Linking a list of triangles to a mesh in which each edge has two sides.
//!
//! The triangles are sorted, and the smallest vertex of each comes first. So for each vertex, those triangles in which
//! it is the smallest stand in a row, with both of their edges at that vertex. The third edge of a triangle waits in a
//! list of its smaller end. Only these lists are read in scattered order.

use alloc::vec::Vec;

use super::plane::{Plane, Side, INFINITE};
use crate::pages;

/// Marks the end of a list of triangles.
const NONE: u32 = u32::MAX;
/// The most comparisons for which the sides at a vertex are not sorted.
const FEW: usize = 256;

/// A side of an edge: the ends of the edge, with the triangle to the left, and the side.
type Open = ([u32; 2], Side);

/// The sides of edges at one vertex, with their other ends: those of edges that leave the vertex, and those of edges
/// that arrive.
#[derive(Default)]
struct Around {
    leaving: Vec<(u32, Side)>,
    arriving: Vec<(u32, Side)>,
}

impl Around {
    /// Links the two sides of each edge, and puts sides without another into a list. Leaves both lists empty. O(d) for
    /// few sides, else O(d log d).
    fn link(&mut self, vertex: u32, plane: &mut Plane, open: &mut Vec<Open>) {
        if self.leaving.len() * self.arriving.len() > FEW {
            // From the end of both sorted lists, as sides are found: sides with the largest other end come first.
            self.leaving.sort_unstable_by_key(|&(end, side)| (end, side.number()));
            self.arriving.sort_unstable_by_key(|&(end, side)| (end, side.number()));
        }
        while let Some((end, side)) = self.leaving.pop() {
            let is_same = |&(other, _): &(u32, Side)| other == end;
            match self.arriving.iter().rposition(is_same) {
                Some(place) => {
                    // The order of the rest stays, and in sorted lists nothing but sides without another stands behind.
                    plane.link(side, self.arriving.remove(place).1);
                }
                None => open.push(([vertex, end], side)),
            }
        }
        open.extend(self.arriving.drain(..).map(|(end, side)| ([end, vertex], side)));
    }
}

impl Plane {
    /// Loads the triangles of a mesh and its hull into a plane without triangles, and adds the ghost triangles. The
    /// triangles are sorted, each with its smallest vertex first.
    pub fn load(&mut self, triangles: &[[u32; 3]], hull: &[u32], vertices: usize) {
        self.reserve(triangles.len() + hull.len());
        for &triangle in triangles {
            let number = self.allocate();
            self.set(number, triangle, [Side::new(0, 0); 3]);
        }
        let mut open = self.link_all(triangles, vertices);
        open.sort_unstable_by_key(|&(ends, side)| (ends, side.number()));
        for (place, &from) in hull.iter().enumerate() {
            let to = hull[(place + 1) % hull.len()];
            let ghost = self.allocate();
            self.set_ghost(ghost, [from, to]);
            if let Ok(found) = open.binary_search_by_key(&[from, to], |&(ends, _)| ends) {
                self.link(open[found].1, Side::new(ghost, 2));
            }
        }
        let ghost = |place: usize| (triangles.len() + place % hull.len()) as u32;
        for place in 0..hull.len() {
            self.link(Side::new(ghost(place), 1), Side::new(ghost(place + 1), 0));
        }
    }

    /// Links the sides of all triangles. Returns the sides without another, which are those of the hull.
    fn link_all(&mut self, triangles: &[[u32; 3]], vertices: usize) -> Vec<Open> {
        // For each vertex the triangles whose third edge has it as its smaller end.
        let [mut first, mut next] = [vertices, triangles.len()].map(|count| {
            let mut list = pages::with_room(count);
            list.resize(count, NONE);
            list
        });
        for (number, &[_, b, c]) in triangles.iter().enumerate() {
            let head = &mut first[b.min(c) as usize];
            next[number] = core::mem::replace(head, number as u32);
        }
        let (mut open, mut around) = (Vec::new(), Around::default());
        let mut own = 0u32;
        for vertex in 0..vertices as u32 {
            while let Some(&[_, b, c]) = triangles.get(own as usize).filter(|triangle| triangle[0] == vertex) {
                around.leaving.push((b, Side::new(own, 2)));
                around.arriving.push((c, Side::new(own, 1)));
                own += 1;
            }
            let mut waiting = first[vertex as usize];
            while waiting != NONE {
                let [_, b, c] = self.get(waiting).vertices;
                let side = Side::new(waiting, 0);
                if b == vertex {
                    around.leaving.push((c, side));
                } else {
                    around.arriving.push((b, side));
                }
                waiting = next[waiting as usize];
            }
            around.link(vertex, self, &mut open);
        }
        open
    }

    /// Writes the ghost triangle of a hull edge. Its sides 0 and 1 are those to the ghost triangles of the hull edges
    /// before and behind, and side 2 is the hull edge itself.
    pub fn set_ghost(&mut self, ghost: u32, [from, to]: [u32; 2]) {
        self.set(ghost, [to, from, INFINITE], [Side::new(0, 0); 3]);
        self.ghost = ghost;
    }
}
