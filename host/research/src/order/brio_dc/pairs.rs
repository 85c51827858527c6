//! Well-separated pairs in which a point can have its nearest neighbour.
//!
//! Two nodes are well separated if they are farther apart than either is wide. Then a point has its nearest neighbour
//! in the other node only if it is alone in its own node. Source: Callahan and Kosaraju, *A decomposition of
//! multidimensional point sets with applications to k-nearest-neighbors and n-body potential fields*, 1995.
//!
//! The decomposition halves the larger node of a pair until the pair is well separated, which gives O(n) pairs.
//! Pairs that are farther apart than either node *reaches* hold no nearest neighbours and are left out, with all
//! pairs that would follow from them. A node reaches at most as far as it is wide, so all pairs are among those
//! of the whole decomposition.

use bytemuck::Zeroable;

use super::quadtree::{is_leaf, place, Quadtree};
use incircle_geometry::sort::Keyed;

/// A point, and a node of more than a few points that can hold its nearest neighbour.
#[derive(Clone, Copy, Debug, Zeroable)]
pub(super) struct Pair {
    pub(super) place: u32,
    pub(super) node: u32,
    level: u32,
}

impl Keyed for Pair {
    /// The key sorts larger nodes first.
    fn key(&self) -> u64 {
        u64::from(u32::MAX - self.level)
    }
}

/// Adds the pairs between the halves of a node, and then sets how far the node reaches. All pairs within the halves
/// must have been made before. A few points meet directly and make no pair.
pub(super) fn add_pairs(tree: &mut Quadtree, node: u32, pairs: &mut Vec<Pair>) {
    let (left, right) = tree.children(node);
    Decomposition { tree, pairs }.between(left, right);
    let reach = |half: u32| tree.nodes[half as usize].reach;
    tree.nodes[node as usize].reach = reach(left).max(reach(right));
}

/// The state of a decomposition. Nodes are as deep as a pair of coordinates has bits, and the calls twice as deep.
struct Decomposition<'d> {
    tree: &'d mut Quadtree,
    pairs: &'d mut Vec<Pair>,
}

impl Decomposition<'_> {
    /// Adds the pairs between two nodes.
    fn between(&mut self, one: u32, other: u32) {
        let nodes = &self.tree.nodes;
        let (u, v) = (&nodes[one as usize], &nodes[other as usize]);
        let gap = u.gap(v);
        if gap > u.reach && gap > v.reach {
            return;
        }
        match (is_leaf(one), is_leaf(other)) {
            (true, true) => self.tree.meet(place(one), place(other)),
            (true, false) if gap > v.span() => self.keep(one, other),
            (false, true) if gap > u.span() => self.keep(other, one),
            _ => {
                let (halved, whole) = if u.level() > v.level() { (one, other) } else { (other, one) };
                let (left, right) = self.tree.children(halved);
                self.between(whole, left);
                self.between(whole, right);
            }
        }
    }

    /// Adds the pair of a leaf and a node.
    fn keep(&mut self, leaf: u32, node: u32) {
        let place = place(leaf);
        match self.tree.few_places(node) {
            Some(few) => few.for_each(|other| self.tree.meet(place, other)),
            None => self.pairs.push(Pair { place, node, level: self.tree.nodes[node as usize].level() }),
        }
    }
}
