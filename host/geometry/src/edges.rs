//! The two sides of every edge of a list of triangles.

use alloc::vec::Vec;

use crate::sort::{sort_by_key, Entry, Keyed, Wide};

/// Half-edges sorted by their undirected edge. Half-edge `3 t + k` runs from vertex `k` of triangle `t` to the next.
///
/// Any triples are allowed, even if they are no mesh, because no vertex is used as an index.
pub(crate) struct EdgeList<'a> {
    triangles: &'a [[u32; 3]],
    sorted: Vec<Wide>,
}

impl<'a> EdgeList<'a> {
    /// Sorts the half-edges of a list of triangles. O(n).
    pub(crate) fn of(triangles: &'a [[u32; 3]]) -> Self {
        let mut sorted = Vec::with_capacity(3 * triangles.len());
        for (t, v) in triangles.iter().enumerate() {
            for k in 0..3 {
                let (from, to) = (v[k], v[(k + 1) % 3]);
                let key = u64::from(from.min(to)) << 32 | u64::from(from.max(to));
                sorted.push(Wide::new(key, (3 * t + k) as u32));
            }
        }
        sort_by_key(&mut sorted);
        Self { triangles, sorted }
    }

    /// The two vertices of a half-edge: its origin, then its end.
    pub(crate) fn ends(&self, halfedge: u32) -> [u32; 2] {
        let v = self.triangles[(halfedge / 3) as usize];
        let k = (halfedge % 3) as usize;
        [v[k], v[(k + 1) % 3]]
    }

    /// The groups of half-edges that share an edge, sorted by the vertices of the edge.
    pub(crate) fn groups(&self) -> impl Iterator<Item = &[Wide]> {
        self.sorted.chunk_by(|one, other| one.key() == other.key())
    }

    /// The half-edges that form a proper pair, which are the only two of their edge and run in opposite directions.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.groups().filter_map(|group| match group {
            [one, other] if self.ends(one.value())[0] != self.ends(other.value())[0] => {
                Some([one.value(), other.value()])
            }
            _ => None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_triangles_share_one_pair() {
        let triangles = [[0, 1, 2], [0, 2, 3]];
        let pairs: Vec<_> = EdgeList::of(&triangles).pairs().collect();
        assert_eq!(pairs, [[2, 3]]);
    }

    #[test]
    fn a_doubled_triangle_pairs_with_nothing() {
        let triangles = [[0, 1, 2], [0, 1, 2]];
        assert_eq!(EdgeList::of(&triangles).pairs().count(), 0);
    }
}
