//! A compressed quadtree over points in Z-order, with nodes numbered from left to right.
//!
//! A square is halved in x and then in y, so a node has two children. Squares with points in only one half have no
//! node. The tree is built in one pass with a stack (Chan, *Well-separated pair decomposition in linear time?*, 2008),
//! or from the top.

use std::ops::RangeInclusive;

use super::distance::{gap, span, Distance};
use incircle_geometry::pages::with_room;
use incircle_geometry::Point;

/// Nodes of up to this many points are searched point by point, in constant time.
const FEW: u32 = 8;
/// Stands for the absence of a point; larger than all places.
const NOBODY: u32 = u32::MAX;

/// A node: a square or half of one, with all its points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    /// The lowest and the highest corner of the smallest box around the points.
    pub(super) low: Point,
    pub(super) high: Point,
    /// The square of a distance within which every point below the node has its nearest neighbour. For a leaf, the
    /// square of the distance of the nearest point that its point has met.
    pub(super) reach: Distance,
    /// The halves with smaller and with larger coordinates. For a leaf, the leaf itself, and the place of the nearest
    /// point that its point has met.
    links: [u32; 2],
}

impl Node {
    /// The square of the distance between two boxes.
    pub(super) fn gap(&self, other: &Self) -> Distance {
        gap([self.low, self.high], [other.low, other.high])
    }

    /// The square of the diagonal of the box.
    pub(super) fn span(&self) -> Distance {
        span(self.low, self.high)
    }

    /// The bit at which the halves differ, counted from 1; 0 for a leaf. Larger squares have higher levels.
    pub(super) fn level(&self) -> u32 {
        level(self.low, self.high)
    }
}

/// The quadtree. The leaf of the point at place `j` is node `2 j`, and the node whose left half ends at place `j` is
/// node `2 j + 1`.
#[derive(Debug)]
pub(super) struct Quadtree {
    pub(super) nodes: Vec<Node>,
    pub(super) root: u32,
    /// While the tree is built from left to right, the nodes whose right halves are not complete, with their levels.
    /// Each level is higher than the next.
    open: Vec<(u32, u32)>,
}

/// Whether this node is a leaf.
pub(super) const fn is_leaf(node: u32) -> bool {
    node & 1 == 0
}

/// The place of the point of a leaf.
pub(super) const fn place(leaf: u32) -> u32 {
    leaf >> 1
}

/// The leaf of the point at this place.
pub(super) const fn leaf(place: u32) -> u32 {
    place << 1
}

/// The highest bit at which the positions of two points along the Z-curve differ, counted from 1; 0 if they are equal.
pub(super) fn level(one: Point, other: Point) -> u32 {
    let bits = |difference: u32| 2 * (u32::BITS - difference.leading_zeros());
    bits(one.x ^ other.x).max(bits(one.y ^ other.y).saturating_sub(1))
}

impl Quadtree {
    /// Makes an empty tree with room for this many points.
    pub(super) fn with_room(points: usize) -> Self {
        Self { nodes: with_room(2 * points), root: 0, open: Vec::new() }
    }

    /// Builds the tree anew in one pass from left to right, in O(n). There must be at least one point, and all must be
    /// distinct and in Z-order. `complete` is called with each node once all below it is complete. By then each point
    /// below has met its neighbours along the curve.
    pub(super) fn build_by_stack(&mut self, points: &[Point], mut complete: impl FnMut(&mut Self, u32)) {
        self.nodes.clear();
        let mut before = None;
        for (place, &point) in (0..).zip(points) {
            let size = before.map_or(0, |before| level(before, point));
            before = Some(point);
            self.add_leaf(place, point);
            if place > 0 {
                let node = leaf(place) - 1;
                let left = self.complete_below(node - 1, size, &mut complete);
                self.nodes[node as usize].links[0] = left;
                self.open.push((node, size));
            }
        }
        self.root = self.complete_below(leaf(points.len() as u32 - 1), u32::MAX, &mut complete);
    }

    /// Completes the open nodes below this level, the lowest of them with the right half `half`. Returns the last node
    /// that was completed, or `half` if there was none.
    fn complete_below(&mut self, half: u32, size: u32, complete: &mut impl FnMut(&mut Self, u32)) -> u32 {
        let mut right = half;
        while let Some((node, _)) = self.open.pop_if(|&mut (_, lower)| lower < size) {
            self.close(node, right);
            complete(self, node);
            right = node;
        }
        right
    }

    /// Builds the tree anew from the top and finds the right half of each node by bisection, in O(n log n), which is
    /// at most O(n log U). Points and `complete` are as in [`Self::build_by_stack`].
    pub(super) fn build_from_top(&mut self, points: &[Point], mut complete: impl FnMut(&mut Self, u32)) {
        self.nodes.clear();
        (0..).zip(points).for_each(|(place, &point)| self.add_leaf(place, point));
        self.root = self.halve(points, 0, &mut complete);
    }

    /// Makes the node of these points, the first of which is at place `first`. The recursion is as deep as a pair
    /// of coordinates has bits.
    fn halve(&mut self, points: &[Point], first: u32, complete: &mut impl FnMut(&mut Self, u32)) -> u32 {
        let [low, .., high] = *points else {
            return leaf(first);
        };
        let size = level(low, high);
        let middle = points.partition_point(|&point| level(low, point) < size);
        let (before, after) = points.split_at(middle);
        let node = leaf(first + middle as u32) - 1;
        self.nodes[node as usize].links[0] = self.halve(before, first, complete);
        let right = self.halve(after, first + middle as u32, complete);
        self.close(node, right);
        complete(self, node);
        node
    }

    /// Adds a leaf, whose point meets that of the previous leaf. Between both leaves there is room for a node.
    fn add_leaf(&mut self, place: u32, point: Point) {
        let own = Node { low: point, high: point, reach: Distance::MAX, links: [leaf(place), NOBODY] };
        if place == 0 {
            self.nodes.push(own);
        } else {
            self.nodes.extend([own, own]);
            self.meet(place - 1, place);
        }
    }

    /// Gives a node its right half, and computes its box from both halves.
    fn close(&mut self, node: u32, right: u32) {
        let (left, _) = self.children(node);
        let (one, other) = (self.nodes[left as usize], self.nodes[right as usize]);
        let low = Point::new(one.low.x.min(other.low.x), one.low.y.min(other.low.y));
        let high = Point::new(one.high.x.max(other.high.x), one.high.y.max(other.high.y));
        self.nodes[node as usize] = Node { low, high, reach: Distance::MAX, links: [left, right] };
    }

    /// The left and the right half of a node.
    pub(super) fn children(&self, node: u32) -> (u32, u32) {
        let [left, right] = self.nodes[node as usize].links;
        (left, right)
    }

    /// The places of all points below a node.
    pub(super) fn places(&self, node: u32) -> RangeInclusive<u32> {
        let (mut first, mut last) = (node, node);
        while !is_leaf(first) {
            (first, _) = self.children(first);
        }
        while !is_leaf(last) {
            (_, last) = self.children(last);
        }
        place(first)..=place(last)
    }

    /// The places of all points below a node of at most [`FEW`] points, in constant time; `None` for a larger node.
    pub(super) fn few_places(&self, node: u32) -> Option<RangeInclusive<u32>> {
        let (mut first, mut last) = (node, node);
        for _ in 1..FEW {
            first = if is_leaf(first) { first } else { self.children(first).0 };
            last = if is_leaf(last) { last } else { self.children(last).1 };
        }
        let is_whole = is_leaf(first) && is_leaf(last) && place(last) - place(first) < FEW;
        is_whole.then(|| place(first)..=place(last))
    }

    /// Lets two points meet: each remembers the other one if that is the nearest so far.
    pub(super) fn meet(&mut self, one: u32, other: u32) {
        let at = |place: u32| self.nodes[leaf(place) as usize].low;
        let distance = span(at(one), at(other));
        for (place, met) in [(one, other), (other, one)] {
            let own = &mut self.nodes[leaf(place) as usize];
            if (distance, met) < (own.reach, own.links[1]) {
                (own.reach, own.links[1]) = (distance, met);
            }
        }
    }

    /// Whether this node can hold the nearest neighbour of this point.
    pub(super) fn is_within_reach(&self, place: u32, node: u32) -> bool {
        let own = &self.nodes[leaf(place) as usize];
        own.gap(&self.nodes[node as usize]) <= own.reach
    }

    /// The nearest point that each point has met, by place.
    pub(super) fn nearest(&self) -> impl Iterator<Item = u32> + '_ {
        self.nodes.iter().step_by(2).map(|leaf| leaf.links[1])
    }
}

#[cfg(test)]
mod tests {
    use super::super::z_order::distinct_in_z_order;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn levels_follow_the_curve() {
        let at = Point::new;
        assert_eq!(level(at(5, 9), at(5, 9)), 0);
        assert_eq!(level(at(0, 0), at(0, 1)), 1);
        assert_eq!(level(at(0, 0), at(1, 1)), 2);
        assert_eq!(level(at(0, 0), at(1, 2)), 3);
        assert_eq!(level(at(0, 0), at(u32::MAX, u32::MAX)), 64);
    }

    /// Checks what must hold at each node.
    fn check(tree: &Quadtree, points: &[Point], id: u32) {
        let node = tree.nodes[id as usize];
        let places = tree.places(id);
        let are_few = places.clone().count() <= FEW as usize;
        assert_eq!(tree.few_places(id), are_few.then_some(places.clone()));
        let inside = &points[*places.start() as usize..=*places.end() as usize];
        let bound = |get: fn(&Point) -> u32| (inside.iter().map(get).min(), inside.iter().map(get).max());
        assert_eq!(bound(|p| p.x), (Some(node.low.x), Some(node.high.x)));
        assert_eq!(bound(|p| p.y), (Some(node.low.y), Some(node.high.y)));
        if !is_leaf(id) {
            let (left, right) = tree.children(id);
            let is_lower = |child: u32| tree.nodes[child as usize].level() < node.level();
            assert!(is_lower(left) && is_lower(right));
        }
    }

    proptest! {
        #[test]
        fn both_ways_lead_to_the_same_tree(
            raw in prop::collection::vec((any::<u32>(), any::<u32>()), 1..200),
            (wide, high) in (0u32..32, 0u32..32),
        ) {
            let points: Vec<Point> = raw.iter().map(|&(x, y)| Point::new(x >> wide, y >> high)).collect();
            let points = distinct_in_z_order(&points);
            let (mut tree, mut other) = (Quadtree::with_room(0), Quadtree::with_room(0));
            let (mut told, mut told_other) = (Vec::new(), Vec::new());
            tree.build_by_stack(&points, |_, node| told.push(node));
            other.build_from_top(&points, |_, node| told_other.push(node));
            prop_assert_eq!((tree.root, &told), (other.root, &told_other));
            prop_assert_eq!(told.len() + 1, points.len());
            for id in 0..tree.nodes.len() as u32 {
                check(&tree, &points, id);
                let is_same = is_leaf(id) || tree.children(id) == other.children(id);
                prop_assert!(is_same, "node {}", id);
            }
        }
    }
}
