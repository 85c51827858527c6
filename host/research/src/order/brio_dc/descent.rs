//! Points on their way down the tree, to the leaves that can be their nearest neighbours: linear time.
//!
//! At each node come together the points that came to the node above and those paired with this one. They meet, and
//! whoever is nearer to another than to the node stays behind. Those that go on are farther from each other than from
//! the node, of which there is room for a constant number. Callahan and Kosaraju 1995.

use super::pairs::Pair;
use super::quadtree::{is_leaf, place, Quadtree};
use incircle_geometry::sort::sort_by_key;

/// No pair of a list: larger than all numbers.
const END: u32 = u32::MAX;

/// The pairs of each node of several points, as a list.
#[derive(Debug, Default)]
pub(super) struct Lists {
    /// The first pair of each node, by half its number, which is odd.
    first: Vec<u32>,
    /// The pair behind each pair, of the same node.
    next: Vec<u32>,
    /// The points that have come to the nodes from the first to the one at work, by node.
    coming: Vec<u32>,
}

impl Lists {
    /// Lets the points of all pairs go down the tree and meet the leaves they come to. O(n): no node is visited twice
    /// but by points.
    pub(super) fn descend_with(&mut self, tree: &mut Quadtree, pairs: &mut Vec<Pair>) {
        // A node above another is larger: its points come first, and take those of the other with them.
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

/// The descent under way.
struct Descent<'d> {
    tree: &'d mut Quadtree,
    pairs: &'d [Pair],
    lists: &'d mut Lists,
}

impl Descent<'_> {
    /// Takes the points that came to the node above, from `above` on, and those paired with this node, down to the
    /// leaves.
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
        // Where nobody goes on, pairs further below have a turn of their own.
        if !is_leaf(node) && self.lists.coming.len() > own {
            let (left, right) = self.tree.children(node);
            self.go(left, own);
            self.go(right, own);
        }
        self.lists.coming.truncate(own);
    }

    /// Lets a point come to a node where it meets those that are there, from `own` on; whoever is nearer to another
    /// than to the node leaves.
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
