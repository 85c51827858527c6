//! The nearest-neighbour graph: for each point the nearest other point, and among equally near ones the
//! first along the Z-curve.
//!
//! With a fixed order among equally near points, each component has exactly one pair of points that are nearest to each
//! other. On a longer cycle all steps would be equally long. The successor of that point of the cycle which comes first
//! along the Z-curve would then have this point as its nearest, and the cycle would end after two steps.
//!
//! Two algorithms lead from the well-separated pairs to the graph. In the linear one (Callahan and Kosaraju 1995)
//! points descend through the tree to the nodes that can hold their nearest neighbour. The other one looks at all
//! points of the node of each pair (Har-Peled, *Geometric approximation algorithms*, 2011, section 3.2). A node of a
//! level has a constant number of pairs, so the second algorithm takes O(n log U), and it is simpler.

use super::descent::Lists;
use super::kind::BrioDc;
use super::pairs::{add_pairs, Pair};
use super::quadtree::Quadtree;
use incircle_geometry::pages::with_room;
use incircle_geometry::Point;

/// A search for nearest-neighbour graphs, one after the other in the same memory.
#[derive(Debug)]
pub(super) struct Search {
    by: BrioDc,
    tree: Quadtree,
    pairs: Vec<Pair>,
    lists: Lists,
    nearest: Vec<u32>,
}

impl Search {
    /// Makes a search with room for `points` points.
    pub(super) fn with_room(points: usize, by: BrioDc) -> Self {
        let (tree, nearest) = (Quadtree::with_room(points), with_room(points));
        Self { by, tree, pairs: Vec::new(), lists: Lists::default(), nearest }
    }

    /// Finds the nearest neighbour of each point, by place. There must be at least two points, distinct and in Z-order.
    pub(super) fn run(&mut self, points: &[Point]) -> &[u32] {
        let Self { tree, pairs, .. } = self;
        pairs.clear();
        // Pairs are made as soon as both of their nodes exist, while the nodes are still in the cache.
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

/// Lets each point meet all points of the nodes that it is paired with.
fn meet_all(tree: &mut Quadtree, pairs: &[Pair]) {
    for &Pair { place, node, .. } in pairs {
        if tree.is_within_reach(place, node) {
            tree.places(node).for_each(|other| tree.meet(place, other));
        }
    }
}
