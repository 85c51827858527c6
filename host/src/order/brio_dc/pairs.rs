//! Well-separated pairs in which a point can have its nearest neighbour.
//!
//! Two nodes are well separated if they are farther apart than either is wide: then a point has its nearest neighbour across only if it
//! is alone in its node. Callahan and Kosaraju, *A decomposition of multidimensional point sets with applications to k-nearest-neighbors
//! and n-body potential fields*, 1995.
//!
//! The decomposition halves the larger node of a pair until it is well separated: O(n) pairs. Pairs farther apart than either node
//! *reaches* hold no nearest neighbours, whatever is in them, and are left out with all that would follow. A node reaches at most as far
//! as it is wide, so the pairs made are among those of the whole decomposition.

use super::distance::span;
use super::neighbors::Neighbors;
use super::quadtree::{is_leaf, place};

/// A point, and a node that can hold its nearest neighbour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    pub(super) place: u32,
    pub(super) node: u32,
}

/// Finds all pairs of a point and a node of several points that are well separated and within reach. Pairs of two points are told to
/// `neighbors` at once.
pub(super) fn well_separated(neighbors: &mut Neighbors, pairs: &mut Vec<Pair>) {
    reach_along_curve(neighbors);
    pairs.clear();
    let root = neighbors.tree.root;
    Decomposition { neighbors, pairs }.within(root);
}

/// Tells each point its neighbours along the curve: in every node each point then reaches another one there.
fn reach_along_curve(neighbors: &mut Neighbors) {
    for after in 1..neighbors.nearest.len() as u32 {
        neighbors.meet(after - 1, after);
    }
}

/// The decomposition under way. Nodes are as deep as a coordinate pair has bits, and so are its calls, twice.
struct Decomposition<'n> {
    neighbors: &'n mut Neighbors,
    pairs: &'n mut Vec<Pair>,
}

impl Decomposition<'_> {
    /// The pairs within a node, then how far it reaches.
    fn within(&mut self, node: u32) {
        if is_leaf(node) {
            return;
        }
        let (left, right) = self.neighbors.tree.children(node);
        self.within(left);
        self.within(right);
        self.between(left, right);
        let nodes = &mut self.neighbors.tree.nodes;
        nodes[node as usize].reach = nodes[left as usize].reach.max(nodes[right as usize].reach);
    }

    /// The pairs between two nodes.
    fn between(&mut self, one: u32, other: u32) {
        let nodes = &self.neighbors.tree.nodes;
        let (u, v) = (&nodes[one as usize], &nodes[other as usize]);
        let gap = u.gap(v);
        if gap > u.reach && gap > v.reach {
            return;
        }
        match (is_leaf(one), is_leaf(other)) {
            (true, true) => self.neighbors.meet(place(one), place(other)),
            (true, false) if gap > span(v.low, v.high) => self.keep(one, other),
            (false, true) if gap > span(u.low, u.high) => self.keep(other, one),
            _ => {
                let (halved, whole) = if u.level() > v.level() { (one, other) } else { (other, one) };
                let (left, right) = self.neighbors.tree.children(halved);
                self.between(whole, left);
                self.between(whole, right);
            }
        }
    }

    fn keep(&mut self, leaf: u32, node: u32) {
        self.pairs.push(Pair { place: place(leaf), node });
    }
}
