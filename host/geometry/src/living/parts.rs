//! The fixed edges of a mesh that lives, and the constraints of which each is a piece.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

/// The fixed edges by their ends. They stay the same when triangles change, so no change of triangles has to tell.
#[derive(Clone, Debug, Default)]
pub struct Parts {
    /// An end of a piece, its other end, and a constraint of it; each in both directions.
    all: BTreeSet<[u32; 3]>,
    /// A bit for each vertex that is an end of a piece. Most vertices are none, and need no search.
    is_end: Vec<u64>,
}

impl Parts {
    /// Whether an edge is fixed.
    #[inline]
    pub fn has(&self, [a, b]: [u32; 2]) -> bool {
        self.may_have(a) && self.may_have(b) && self.of([a, b]).next().is_some()
    }

    #[inline(always)]
    fn may_have(&self, vertex: u32) -> bool {
        // The infinite vertex lies behind the end of the list.
        self.is_end.get(vertex as usize / 64).is_some_and(|bits| bits >> (vertex % 64) & 1 != 0)
    }

    /// The constraints of an edge in rising order.
    pub fn of(&self, [a, b]: [u32; 2]) -> impl Iterator<Item = u32> + '_ {
        self.all.range([a, b, 0]..=[a, b, u32::MAX]).map(|part| part[2])
    }

    /// The other end of each fixed edge at a vertex with a constraint of it, sorted.
    pub fn around(&self, vertex: u32) -> impl Iterator<Item = [u32; 2]> + '_ {
        let own = self.may_have(vertex).then(|| self.all.range([vertex, 0, 0]..=[vertex, u32::MAX, u32::MAX]));
        own.into_iter().flatten().map(|&[_, other, constraint]| [other, constraint])
    }

    /// All pieces, the smaller vertex first, with each of their constraints.
    pub fn iter(&self) -> impl Iterator<Item = ([u32; 2], u32)> + '_ {
        self.all.iter().filter(|[a, b, _]| a < b).map(|&[a, b, constraint]| ([a, b], constraint))
    }

    /// Makes an edge a piece of a constraint.
    pub fn add(&mut self, [a, b]: [u32; 2], constraint: u32) {
        self.all.extend([[a, b, constraint], [b, a, constraint]]);
        let words = a.max(b) as usize / 64 + 1;
        if self.is_end.len() < words {
            self.is_end.resize(words, 0);
        }
        [a, b].into_iter().for_each(|end| self.is_end[end as usize / 64] |= 1 << (end % 64));
    }

    /// The edge is no longer a piece of the constraint.
    pub fn remove(&mut self, [a, b]: [u32; 2], constraint: u32) {
        self.all.remove(&[a, b, constraint]);
        self.all.remove(&[b, a, constraint]);
        for end in [a, b] {
            if self.all.range([end, 0, 0]..=[end, u32::MAX, u32::MAX]).next().is_none() {
                self.is_end[end as usize / 64] &= !(1 << (end % 64));
            }
        }
    }

    /// Takes the constraints of an edge away, and returns them.
    pub fn take(&mut self, edge: [u32; 2]) -> Vec<u32> {
        let own: Vec<u32> = self.of(edge).collect();
        own.iter().for_each(|&constraint| self.remove(edge, constraint));
        own
    }
}
