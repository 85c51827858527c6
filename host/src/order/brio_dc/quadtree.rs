//! A compressed quadtree over points in Z-order, its nodes numbered from left to right.
//!
//! A square is halved in x and then in y, so a node has two children; squares with points in one half only have no node. Two ways to
//! build it: in one pass with a stack (Chan, *Well-separated pair decomposition in linear time?*, 2008), or from the top.

use super::distance::{gap, Distance};
use crate::pages::with_room;
use crate::point::Point;

/// A square, or half of one, with all its points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    /// The corners of the smallest box around the points.
    pub(super) low: Point,
    pub(super) high: Point,
    /// The halves with smaller and with larger coordinates; of a leaf, both itself.
    pub(super) left: u32,
    pub(super) right: u32,
    /// No point below has its nearest neighbour farther away than this.
    pub(super) reach: Distance,
}

impl Node {
    /// The square of the distance between two boxes.
    pub(super) fn gap(&self, other: &Self) -> Distance {
        gap([self.low, self.high], [other.low, other.high])
    }

    /// The bit at which the halves differ, from 1; 0 for a leaf. The larger, the larger is the square.
    pub(super) fn level(&self) -> u32 {
        level(self.low, self.high)
    }
}

/// The tree. The leaf of the point at place `j` is node `2 j`; the node whose left half ends at place `j` is node `2 j + 1`.
#[derive(Debug)]
pub(super) struct Quadtree {
    pub(super) nodes: Vec<Node>,
    pub(super) root: u32,
    /// While it is built from left to right: nodes whose right halves are not complete, and their levels, each higher than the next.
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

/// The highest bit at which the positions of two points along the Z-curve differ, from 1; 0 if they are equal.
pub(super) fn level(one: Point, other: Point) -> u32 {
    let bits = |difference: u32| 2 * (u32::BITS - difference.leading_zeros());
    bits(one.x ^ other.x).max(bits(one.y ^ other.y).saturating_sub(1))
}

impl Quadtree {
    /// A tree that has room for this many points, and none yet.
    pub(super) fn with_room(points: usize) -> Self {
        Self { nodes: with_room(2 * points), root: 0, open: Vec::new() }
    }

    /// The leaves alone, which have met nobody.
    fn begin(&mut self, points: &[Point]) {
        self.nodes.clear();
        for (place, &point) in (0..).zip(points) {
            let id = leaf(place);
            let own = Node { low: point, high: point, left: id, right: id, reach: Distance::MAX };
            if place > 0 {
                self.nodes.push(own);
            }
            self.nodes.push(own);
        }
    }

    /// Builds it anew in one pass from left to right: O(n). The points are distinct, in Z-order, and at least one.
    pub(super) fn build_by_stack(&mut self, points: &[Point]) {
        self.begin(points);
        for (before, pair) in (0..).zip(points.windows(2)) {
            let size = level(pair[0], pair[1]);
            let mut left = leaf(before);
            while let Some((node, _)) = self.open.pop_if(|&mut (_, lower)| lower < size) {
                self.close(node, left);
                left = node;
            }
            let node = leaf(before) + 1;
            self.nodes[node as usize].left = left;
            self.open.push((node, size));
        }
        let mut right = leaf(points.len() as u32 - 1);
        while let Some((node, _)) = self.open.pop() {
            self.close(node, right);
            right = node;
        }
        self.root = right;
    }

    /// Builds it anew from the top, each node's right half found by bisection: O(n log n), which is less than O(n log U). Points as before.
    pub(super) fn build_from_top(&mut self, points: &[Point]) {
        self.begin(points);
        self.root = self.halve(points, 0);
    }

    /// The node of these points, the first of which is at place `first`. As deep as a coordinate pair has bits.
    fn halve(&mut self, points: &[Point], first: u32) -> u32 {
        let [low, .., high] = *points else {
            return leaf(first);
        };
        let size = level(low, high);
        let middle = points.partition_point(|&point| level(low, point) < size);
        let (before, after) = points.split_at(middle);
        let node = leaf(first + middle as u32) - 1;
        self.nodes[node as usize].left = self.halve(before, first);
        let right = self.halve(after, first + middle as u32);
        self.close(node, right);
        node
    }

    /// Gives a node its right half; its box follows.
    fn close(&mut self, node: u32, right: u32) {
        let (left, _) = self.children(node);
        let (one, other) = (self.nodes[left as usize], self.nodes[right as usize]);
        let low = Point::new(one.low.x.min(other.low.x), one.low.y.min(other.low.y));
        let high = Point::new(one.high.x.max(other.high.x), one.high.y.max(other.high.y));
        self.nodes[node as usize] = Node { low, high, left, right, reach: Distance::MAX };
    }

    /// The halves of a node.
    pub(super) fn children(&self, node: u32) -> (u32, u32) {
        let Node { left, right, .. } = self.nodes[node as usize];
        (left, right)
    }

    /// The places of all points below a node.
    pub(super) fn places(&self, node: u32) -> std::ops::RangeInclusive<u32> {
        let (mut first, mut last) = (node, node);
        while !is_leaf(first) {
            first = self.nodes[first as usize].left;
        }
        while !is_leaf(last) {
            last = self.nodes[last as usize].right;
        }
        place(first)..=place(last)
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

    proptest! {
        #[test]
        fn both_ways_lead_to_the_same_tree(
            raw in prop::collection::vec((any::<u32>(), any::<u32>()), 1..200),
            (wide, high) in (0u32..32, 0u32..32),
        ) {
            let points: Vec<Point> = raw.iter().map(|&(x, y)| Point::new(x >> wide, y >> high)).collect();
            let points = distinct_in_z_order(&points);
            let (mut tree, mut other) = (Quadtree::with_room(0), Quadtree::with_room(0));
            tree.build_by_stack(&points);
            other.build_from_top(&points);
            prop_assert_eq!(tree.root, other.root);
            for id in 0..tree.nodes.len() as u32 {
                let (node, same) = (tree.nodes[id as usize], other.nodes[id as usize]);
                prop_assert_eq!((node.left, node.right, node.low, node.high), (same.left, same.right, same.low, same.high));
                let inside = &points[*tree.places(id).start() as usize..=*tree.places(id).end() as usize];
                let bound = |get: fn(&Point) -> u32| (inside.iter().map(get).min(), inside.iter().map(get).max());
                prop_assert_eq!(bound(|p| p.x), (Some(node.low.x), Some(node.high.x)));
                prop_assert_eq!(bound(|p| p.y), (Some(node.low.y), Some(node.high.y)));
                if !is_leaf(id) {
                    let (left, right) = (tree.nodes[node.left as usize], tree.nodes[node.right as usize]);
                    prop_assert!(left.level() < node.level() && right.level() < node.level());
                }
            }
        }
    }
}
