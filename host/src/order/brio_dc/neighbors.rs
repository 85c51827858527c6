//! The nearest-neighbour graph: of each point, the nearest other one; of equally near ones, the first along the Z-curve.
//!
//! With a fixed order among equally near points each component has exactly one pair of points that are nearest to each other: on a
//! longer cycle all steps would be equally long, and the step behind the cycle's first point would have to lead back to it.
//!
//! Two ways from the well-separated pairs to the graph. In linear time (Callahan and Kosaraju 1995): points come down the tree to
//! the nodes that can hold their nearest neighbour; of points that come to one node only those stay that are nearer to it than to each
//! other, which are a constant number. And by looking at all points of the node of each pair (Har-Peled, *Geometric approximation
//! algorithms*, 2011, section 3.2): a node of a level has a constant number of pairs, so that is O(n log U), and simpler.

use super::descent::Lists;
use super::distance::{gap, span};
use super::pairs::{well_separated, Pair};
use super::quadtree::{leaf, Quadtree};
use super::BrioDc;
use crate::pages::with_room;
use crate::point::Point;

/// No point: larger than all places.
const END: u32 = u32::MAX;

/// What is known so far. The leaf of a point reaches as far as the nearest of the points it has met.
#[derive(Debug)]
pub(super) struct Neighbors {
    pub(super) tree: Quadtree,
    /// Of each point, the nearest it has met, by place; [`END`] before the first.
    pub(super) nearest: Vec<u32>,
}

/// Finds graphs, one after the other in the same memory.
#[derive(Debug)]
pub(super) struct Search {
    by: BrioDc,
    neighbors: Neighbors,
    pairs: Vec<Pair>,
    lists: Lists,
}

impl Search {
    /// For up to so many points.
    pub(super) fn with_room(points: usize, by: BrioDc) -> Self {
        let neighbors = Neighbors { tree: Quadtree::with_room(points), nearest: with_room(points) };
        Self { by, neighbors, pairs: with_room(points), lists: Lists::default() }
    }

    /// The nearest neighbour of each point, by place. The points are distinct, in Z-order, and at least two.
    pub(super) fn run(&mut self, points: &[Point]) -> &[u32] {
        self.neighbors.nearest.clear();
        self.neighbors.nearest.resize(points.len(), END);
        let tree = &mut self.neighbors.tree;
        match self.by {
            BrioDc::Linear => tree.build_by_stack(points),
            BrioDc::LogU => tree.build_from_top(points),
        }
        well_separated(&mut self.neighbors, &mut self.pairs);
        match self.by {
            BrioDc::Linear => self.lists.descend_with(&mut self.neighbors, &self.pairs),
            BrioDc::LogU => self.neighbors.meet_all(&self.pairs),
        }
        &self.neighbors.nearest
    }
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
    pub(super) fn is_within_reach(&self, place: u32, node: u32) -> bool {
        let (own, node) = (&self.tree.nodes[leaf(place) as usize], &self.tree.nodes[node as usize]);
        gap([own.low, own.high], [node.low, node.high]) <= own.reach
    }
}
