//! The descent of points through the tree, to the leaves that can be their nearest neighbours, in linear time.
//!
//! Each node gets the points that came to the node above, and those paired with the node itself. These points meet, and
//! a point that is nearer to another one than to the node stays behind. The points that go on are farther from each
//! other than from the node, so there is room for a constant number of them. Source: Callahan and Kosaraju 1995.

use super::pairs::Pair;
use super::quadtree::{is_leaf, place, Quadtree};
use incircle_geometry::sort::sort_by_key;

/// Marks the end of a list of pairs; larger than all numbers of pairs.
const END: u32 = u32::MAX;

/// A linked list of pairs for each node of several points.
#[derive(Debug, Default)]
pub(super) struct Lists {
    /// The first pair of each node. Such nodes have odd numbers, and the index is half the number.
    first: Vec<u32>,
    /// For each pair, the next pair of the same node.
    next: Vec<u32>,
    /// The points that have come to the nodes on the path from the top to the current node, by node.
    coming: Vec<u32>,
}

impl Lists {
    /// Lets the points of all pairs go down the tree and meet the leaves that they come to. O(n), because a node is
    /// visited more than once only by points.
    pub(super) fn descend_with(&mut self, tree: &mut Quadtree, pairs: &mut Vec<Pair>) {
        // Pairs of larger nodes come first, and a node is larger than all below it. So the descent from a node also
        // takes the points that are paired with the nodes below.
        sort_by_key(pairs);
        for (list, length) in [(&mut self.first, tree.nodes.len() / 2), (&mut self.next, pairs.len())] {
            list.clear();
            list.resize(length, END);
        }
        for (number, pair) in (0..).zip(&*pairs) {
            self.next[number as usize] = std::mem::replace(&mut self.first[pair.node as usize / 2], number);
        }
        let mut descent = Descent { tree, pairs, lists: self };
        for pair in &*pairs {
            if descent.lists.first[pair.node as usize / 2] != END {
                descent.go(pair.node, 0);
            }
        }
    }
}

/// The state of a descent.
struct Descent<'d> {
    tree: &'d mut Quadtree,
    pairs: &'d [Pair],
    lists: &'d mut Lists,
}

impl Descent<'_> {
    /// Takes points down to the leaves: those that came to the node above, from `above` on in the list, and those
    /// paired with this node.
    fn go(&mut self, node: u32, above: usize) {
        let own = self.lists.coming.len();
        for come in above..own {
            self.admit(self.lists.coming[come], node, own);
        }
        if is_leaf(node) {
            for come in own..self.lists.coming.len() {
                self.tree.meet(self.lists.coming[come], place(node));
            }
        } else {
            let mut number = std::mem::replace(&mut self.lists.first[node as usize / 2], END);
            while number != END {
                self.admit(self.pairs[number as usize].place, node, own);
                number = self.lists.next[number as usize];
            }
        }
        // If no point goes on, the pairs of the nodes below are left to their own calls.
        if !is_leaf(node) && self.lists.coming.len() > own {
            let (left, right) = self.tree.children(node);
            self.go(left, own);
            self.go(right, own);
        }
        self.lists.coming.truncate(own);
    }

    /// Adds a point to those at a node, from `own` on in the list. The point meets all of them, and those that are
    /// nearer to another point than to the node leave.
    fn admit(&mut self, point: u32, node: u32, own: usize) {
        let mut there = own;
        while let Some(&other) = self.lists.coming.get(there) {
            self.tree.meet(point, other);
            if self.tree.is_within_reach(other, node) {
                there += 1;
            } else {
                self.lists.coming.swap_remove(there);
            }
        }
        if self.tree.is_within_reach(point, node) {
            self.lists.coming.push(point);
        }
    }
}
