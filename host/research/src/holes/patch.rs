//! The triangles of a hole by their edges.

use std::collections::BTreeMap;

use super::ring::{Ring, Triangle};

/// Triangles, as a map from each edge with a triangle to its left to the apex of that triangle.
#[derive(Clone, Debug, Default)]
pub(super) struct Patch(BTreeMap<(usize, usize), usize>);

fn edges([a, b, c]: Triangle) -> [((usize, usize), usize); 3] {
    [((a, b), c), ((b, c), a), ((c, a), b)]
}

impl Patch {
    pub(super) fn add(&mut self, triangle: Triangle) {
        self.0.extend(edges(triangle));
    }

    fn remove(&mut self, triangle: Triangle) {
        edges(triangle).iter().for_each(|(edge, _)| _ = self.0.remove(edge));
    }

    fn apex(&self, a: usize, b: usize) -> Option<usize> {
        self.0.get(&(a, b)).copied()
    }

    /// All triangles, once each.
    pub(super) fn triangles(&self) -> Vec<Triangle> {
        let all = self.0.iter().map(|(&(a, b), &c)| [a, b, c]);
        all.filter(|&[a, b, c]| a < b && a < c).collect()
    }

    /// Flips edges until the triangles are canonical.
    pub(super) fn flip_all(&mut self, ring: &mut Ring) {
        let mut open: Vec<(usize, usize)> = self.0.keys().copied().filter(|&(a, b)| a < b).collect();
        while let Some((a, b)) = open.pop() {
            let (Some(c), Some(d)) = (self.apex(a, b), self.apex(b, a)) else { continue };
            if ring.conflicts([a, b, c], d) {
                self.remove([a, b, c]);
                self.remove([b, a, d]);
                self.add([c, a, d]);
                self.add([d, b, c]);
                open.extend([(a, d), (d, b), (b, c), (c, a)]);
            }
        }
    }

    /// Inserts a place of the ring between the places that were neighbours along the ring so far.
    pub(super) fn insert(&mut self, ring: &mut Ring, place: usize, [before, behind]: [usize; 2]) {
        let mut open = vec![(before, behind)];
        while let Some((a, b)) = open.pop() {
            match self.apex(a, b) {
                Some(apex) if ring.conflicts([a, b, apex], place) => {
                    self.remove([a, b, apex]);
                    open.extend([(a, apex), (apex, b)]);
                }
                _ => self.add([a, place, b]),
            }
        }
    }
}
