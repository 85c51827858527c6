//! The nearest-neighbour graph: of each point, the nearest other one; of equally near ones, the first along the Z-curve.
//!
//! With a fixed order among equally near points each component has exactly one pair of points that are nearest to each other: on a
//! longer cycle all steps would be equally long, and the step behind the cycle's first point would have to lead back to it.
//!
//! Two ways from the well-separated pairs to the graph. In linear time (Callahan and Kosaraju 1995): points come down the tree to
//! the nodes that can hold their nearest neighbour; of points that come to one node only those stay that are nearer to it than to each
//! other, which are a constant number. And by looking at all points of the node of each pair (Har-Peled, *Geometric approximation
//! algorithms*, 2011, section 3.2): a node of a level has a constant number of pairs, so that is O(n log U), and simpler.

use super::distance::{gap, span};
use super::pairs::{well_separated, Pair};
use super::quadtree::{is_leaf, leaf, place, Quadtree};
use super::BrioDc;
use crate::point::Point;

/// What is known so far. The leaf of a point reaches as far as the nearest of the points it has met.
#[derive(Debug)]
pub(super) struct Neighbors {
    pub(super) tree: Quadtree,
    /// Of each point, the nearest it has met, by place; [`END`] before the first.
    pub(super) nearest: Vec<u32>,
}

/// The nearest neighbour of each point, by place. The points are distinct, in Z-order, and at least two.
pub(super) fn nearest_neighbors(points: &[Point], by: BrioDc) -> Vec<u32> {
    let tree = match by {
        BrioDc::Linear => Quadtree::by_stack(points),
        BrioDc::LogU => Quadtree::from_top(points),
    };
    let mut neighbors = Neighbors { tree, nearest: vec![END; points.len()] };
    let pairs = well_separated(&mut neighbors);
    match by {
        BrioDc::Linear => Descent::new(&mut neighbors, &pairs).run(),
        BrioDc::LogU => neighbors.meet_all(&pairs),
    }
    neighbors.nearest
}

impl Neighbors {
    /// Lets two points meet.
    pub(super) fn meet(&mut self, one: u32, other: u32) {
        let at = |place: u32| self.tree.nodes[leaf(place) as usize].low;
        let distance = span(at(one), at(other));
        for (place, met) in [(one, other), (other, one)] {
            let own = &mut self.tree.nodes[leaf(place) as usize];
            let nearest = &mut self.nearest[place as usize];
            if (distance, met) < (own.reach, *nearest) {
                (own.reach, *nearest) = (distance, met);
            }
        }
    }

    /// Lets each point meet all those of the nodes it is paired with.
    fn meet_all(&mut self, pairs: &[Pair]) {
        for pair in pairs {
            if self.is_within_reach(pair.place, pair.node) {
                self.tree.places(pair.node).for_each(|other| self.meet(pair.place, other));
            }
        }
    }

    /// Whether this node can hold the nearest neighbour of this point.
    fn is_within_reach(&self, place: u32, node: u32) -> bool {
        let (own, node) = (&self.tree.nodes[leaf(place) as usize], &self.tree.nodes[node as usize]);
        gap([own.low, own.high], [node.low, node.high]) <= own.reach
    }
}

/// No point, or no pair: larger than all numbers.
const END: u32 = u32::MAX;

/// Points on their way down the tree.
struct Descent<'n> {
    neighbors: &'n mut Neighbors,
    pairs: &'n [Pair],
    /// The first pair of each node, and the pair behind each pair, of the same node.
    first: Vec<u32>,
    next: Vec<u32>,
    /// The points that have come to the nodes from the root to the one at work, by node.
    coming: Vec<u32>,
}

impl<'n> Descent<'n> {
    fn new(neighbors: &'n mut Neighbors, pairs: &'n [Pair]) -> Self {
        let mut first = vec![END; neighbors.tree.nodes.len()];
        let mut next = vec![END; pairs.len()];
        for (number, pair) in (0..).zip(pairs) {
            next[number as usize] = std::mem::replace(&mut first[pair.node as usize], number);
        }
        Self { neighbors, pairs, first, next, coming: Vec::new() }
    }

    fn run(&mut self) {
        self.descend(self.neighbors.tree.root, 0);
    }

    /// Takes the points that came to the node above, from `above` on, and those paired with this node, down to the leaves.
    fn descend(&mut self, node: u32, above: usize) {
        let own = self.coming.len();
        for place in above..own {
            self.admit(self.coming[place], node, own);
        }
        let mut number = self.first[node as usize];
        while number != END {
            self.admit(self.pairs[number as usize].place, node, own);
            number = self.next[number as usize];
        }
        if is_leaf(node) {
            for come in own..self.coming.len() {
                self.neighbors.meet(self.coming[come], place(node));
            }
        } else {
            let (left, right) = self.neighbors.tree.children(node);
            self.descend(left, own);
            self.descend(right, own);
        }
        self.coming.truncate(own);
    }

    /// Lets a point come to a node where it meets those that are there; whoever is nearer to another than to the node leaves.
    fn admit(&mut self, point: u32, node: u32, own: usize) {
        let mut there = own;
        while there < self.coming.len() {
            let other = self.coming[there];
            self.neighbors.meet(point, other);
            if self.neighbors.is_within_reach(other, node) {
                there += 1;
            } else {
                self.coming.swap_remove(there);
            }
        }
        if self.neighbors.is_within_reach(point, node) {
            self.coming.push(point);
        }
    }
}
