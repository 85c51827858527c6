//! The nearest-neighbour graph: of each point, the nearest other one; of equally near ones, the first along the
//! Z-curve.
//!
//! With a fixed order among equally near points each component has exactly one pair of points that are nearest to each
//! other: on a longer cycle all steps would be equally long, and the step behind the cycle's first point would have to
//! lead back to it.
//!
//! Two ways from the well-separated pairs to the graph. In linear time (Callahan and Kosaraju 1995): points come down
//! the tree to the nodes that can hold their nearest neighbour. And by looking at all points of the node of each pair
//! (Har-Peled, *Geometric approximation algorithms*, 2011, section 3.2): a node of a level has a constant number of
//! pairs, so that is O(n log U), and simpler.

use super::descent::Lists;
use super::kind::BrioDc;
use super::pairs::{add_pairs, Pair};
use super::quadtree::Quadtree;
use incircle_geometry::pages::with_room;
use incircle_geometry::Point;

/// Finds graphs, one after the other in the same memory.
#[derive(Debug)]
pub(super) struct Search {
    by: BrioDc,
    tree: Quadtree,
    pairs: Vec<Pair>,
    lists: Lists,
    nearest: Vec<u32>,
}

impl Search {
    /// For up to so many points.
    pub(super) fn with_room(points: usize, by: BrioDc) -> Self {
        let (tree, nearest) = (Quadtree::with_room(points), with_room(points));
        Self { by, tree, pairs: Vec::new(), lists: Lists::default(), nearest }
    }

    /// The nearest neighbour of each point, by place. The points are distinct, in Z-order, and at least two.
    pub(super) fn run(&mut self, points: &[Point]) -> &[u32] {
        let Self { tree, pairs, .. } = self;
        pairs.clear();
        // Pairs are made as soon as both of their nodes are, while these are still at hand.
        match self.by {
            BrioDc::Linear => tree.build_by_stack(points, |tree, node| add_pairs(tree, node, pairs)),
            BrioDc::LogU => tree.build_from_top(points, |tree, node| add_pairs(tree, node, pairs)),
        }
        match self.by {
            BrioDc::Linear => self.lists.descend_with(tree, pairs),
            BrioDc::LogU => meet_all(tree, pairs),
        }
        self.nearest.clear();
        self.nearest.extend(tree.nearest());
        &self.nearest
    }
}

/// Lets each point meet all those of the nodes it is paired with.
fn meet_all(tree: &mut Quadtree, pairs: &[Pair]) {
    for &Pair { place, node, .. } in pairs {
        if tree.is_within_reach(place, node) {
            tree.places(node).for_each(|other| tree.meet(place, other));
        }
    }
}
