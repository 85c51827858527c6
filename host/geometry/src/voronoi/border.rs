//! The corners and edges of a clip in a tree of boxes, so that the work for a cell looks at few of them.
//!
//! A node has edges with consecutive numbers: those of some whole rings, or consecutive ones of a single ring. Its box
//! holds all their ends. So one comparison tells that all corners of a node lie on one side of a line, or that none of
//! its edges comes near a cell.

use alloc::vec::Vec;
use core::cmp::Ordering;
use core::ops::Range;

use super::corner::{dot, vector};
use super::rings::Rings;
use crate::point::Point;
use crate::predicate::orient2d;

/// The most edges of a node without children.
const LEAF: u32 = 4;

/// The edges of all rings of a rings. Nodes stand in the order in which a search visits them, each before its children.
#[derive(Clone, Debug, Default)]
pub(super) struct Border {
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    /// The first edge, and the one behind the last.
    edges: [u32; 2],
    low: [u32; 2],
    high: [u32; 2],
    /// The node that is next if the search leaves this one out. It is the very next one if the node has no children.
    skip: u32,
    /// Whether there is more than one ring.
    has_rings: bool,
}

/// The perpendicular bisector of two points; its sides are told from the first point.
#[derive(Clone, Copy)]
pub(super) struct Bisector {
    p: Point,
    /// The vector to the other point, and its square.
    v: [i64; 2],
    square: i128,
}

impl Bisector {
    pub(super) fn of(p: Point, q: Point) -> Self {
        let v = vector(p, q);
        Self { p, v, square: dot(v, v).into() }
    }

    /// Whether a point is nearer to the first point (`Greater`), as near to both (`Equal`), or farther (`Less`).
    pub(super) fn side(&self, point: Point) -> Ordering {
        self.square.cmp(&(2 * i128::from(dot(self.v, vector(self.p, point)))))
    }

    /// The side of all points of a box, if it is the same for all and none is on the line.
    fn side_of_box(&self, low: [u32; 2], high: [u32; 2]) -> Option<Ordering> {
        let ahead = |axis: usize| self.v[axis] > 0;
        let corner = |far: bool| [0, 1].map(|axis| if ahead(axis) == far { high[axis] } else { low[axis] });
        let [nearest, farthest] = [false, true].map(|far| self.side(Point::from(corner(far))));
        match (nearest, farthest) {
            (_, Ordering::Greater) => Some(Ordering::Greater),
            (Ordering::Less, _) => Some(Ordering::Less),
            _ => None,
        }
    }
}

impl Border {
    /// The border of a rings.
    pub(super) fn of(rings: &Rings) -> Self {
        let mut border = Self::default();
        let count = rings.corners.len() as u32;
        if count > 0 {
            border.add(rings, [0, count]);
        }
        border
    }

    /// Adds the node of some edges, and its children. Returns its box.
    fn add(&mut self, rings: &Rings, edges: [u32; 2]) -> [[u32; 2]; 2] {
        let (number, [first, end]) = (self.nodes.len(), edges);
        let between = rings.ring_between(edges);
        self.nodes.push(Node { edges, low: [0; 2], high: [0; 2], skip: 0, has_rings: between.is_some() });
        let [low, high] = match between {
            None if end - first <= LEAF => {
                (first..end).map(|edge| box_of(rings.edge(edge as usize))).fold([[u32::MAX; 2], [0; 2]], united)
            }
            middle => {
                let middle = middle.unwrap_or(first + (end - first) / 2);
                let one = self.add(rings, [first, middle]);
                united(one, self.add(rings, [middle, end]))
            }
        };
        let skip = self.nodes.len() as u32;
        self.nodes[number] = Node { low, high, skip, ..self.nodes[number] };
        [low, high]
    }

    /// Visits the nodes from above. `enter` says whether the children of a node, or its edges, are wanted. `edge` is
    /// called with each edge of a node without children until it returns true, and that edge is returned. Edges come in
    /// the order of their numbers.
    fn visit(&self, mut enter: impl FnMut(&Node) -> bool, mut edge: impl FnMut(u32) -> bool) -> Option<u32> {
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            at = if !enter(node) {
                node.skip as usize
            } else {
                let has_children = node.skip as usize > at + 1;
                let mut own = if has_children { 0..0 } else { node.edges[0]..node.edges[1] };
                if let Some(found) = own.find(|&number| edge(number)) {
                    return Some(found);
                }
                at + 1
            };
        }
        None
    }

    /// Whether the box of an edge and a box of doubles have a place in common. The box may be infinite.
    pub(super) fn may_touch(&self, rings: &Rings, low: [f64; 2], high: [f64; 2]) -> bool {
        let overlaps = |[from, to]: [[u32; 2]; 2]| {
            (0..2).all(|axis| low[axis] <= f64::from(to[axis]) && high[axis] >= f64::from(from[axis]))
        };
        self.visit(|node| overlaps([node.low, node.high]), |edge| overlaps(box_of(rings.edge(edge as usize)))).is_some()
    }

    /// Whether an odd number of rings contains a point that is on none of them, without the ring of these edges.
    pub(super) fn is_inside(&self, rings: &Rings, point: Point, without: Range<u32>) -> bool {
        let is_above = |corner: Point| corner.y > point.y;
        let (mut nodes, mut edges) = (false, false);
        let enter = |node: &Node| {
            let [first, end] = node.edges;
            if node.low[1] > point.y || node.high[1] <= point.y || node.high[0] < point.x {
                return false;
            }
            // A ray to the right crosses a chain of edges an odd number of times if the ends lie on two sides of it.
            if node.low[0] > point.x && !without.contains(&first) {
                nodes ^= !node.has_rings
                    && is_above(rings.edge(first as usize)[0]) != is_above(rings.edge(end as usize - 1)[1]);
                return false;
            }
            !(without.contains(&first) && end <= without.end)
        };
        self.visit(enter, |edge| {
            edges ^= is_right_of(rings.edge(edge as usize), point);
            false
        });
        nodes != edges
    }

    /// The first of the edges behind this one that meets it, of those whose boxes have a place in common with its own.
    pub(super) fn first_met(&self, rings: &Rings, edge: u32, meets: impl Fn(u32) -> bool) -> Option<u32> {
        let [low, high] = box_of(rings.edge(edge as usize));
        let enter = |node: &Node| {
            let overlaps = |axis: usize| node.low[axis] <= high[axis] && node.high[axis] >= low[axis];
            node.edges[1] > edge + 1 && overlaps(0) && overlaps(1)
        };
        self.visit(enter, |other| other > edge && meets(other))
    }

    /// Calls `add` with all corners from a number to before another, in runs that lie on one side of a line. Corners
    /// on the line come alone. A run is of one ring, or of some whole ones.
    pub(super) fn sides(
        &self,
        rings: &Rings,
        [first, end]: [u32; 2],
        line: Bisector,
        mut add: impl FnMut([u32; 2], Ordering),
    ) {
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            let part = [node.edges[0].max(first), node.edges[1].min(end)];
            if part[0] >= part[1] {
                at = node.skip as usize;
            } else if let Some(side) = line.side_of_box(node.low, node.high) {
                add(part, side);
                at = node.skip as usize;
            } else {
                if node.skip as usize == at + 1 {
                    (part[0]..part[1]).for_each(|k| add([k, k + 1], line.side(rings.corners[k as usize])));
                }
                at += 1;
            }
        }
    }
}

fn box_of([a, b]: [Point; 2]) -> [[u32; 2]; 2] {
    [[a.x.min(b.x), a.y.min(b.y)], [a.x.max(b.x), a.y.max(b.y)]]
}

fn united([a, b]: [[u32; 2]; 2], [c, d]: [[u32; 2]; 2]) -> [[u32; 2]; 2] {
    [[a[0].min(c[0]), a[1].min(c[1])], [b[0].max(d[0]), b[1].max(d[1])]]
}

/// Whether a ray from the point to the right crosses an edge. Half open, so that a corner on the ray counts once.
fn is_right_of([a, b]: [Point; 2], point: Point) -> bool {
    (a.y > point.y) != (b.y > point.y) && (orient2d(a, b, point) > 0) == (b.y > a.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::voronoi::tests::{draw_clip, draw_holes, sets};
    use incircle_testkit::SplitMix64;

    #[test]
    fn the_tree_answers_like_all_edges() {
        let mut random = SplitMix64::new(293);
        let mut answers = [0; 4];
        for number in 0..sets() {
            let clip = if number % 2 == 0 { Some(draw_clip(&mut random)) } else { draw_holes(&mut random) };
            let Some(clip) = clip else { continue };
            let edges: Vec<[Point; 2]> = (0..clip.corners().len()).map(|edge| clip.rings.edge(edge)).collect();
            for _ in 0..20 {
                let point = Point::new(random.below_u32(16), random.below_u32(16));
                let is_inside = edges.iter().filter(|&&edge| is_right_of(edge, point)).count() % 2 == 1;
                assert_eq!(clip.contains(point), is_inside, "{point:?} in {:?}", clip.corners());
                let low = [0; 2].map(|_| random.below(20) as f64 - 2.0);
                let high = low.map(|value| value + random.below(6) as f64 / 2.0);
                let touches = edges.iter().any(|&edge| {
                    let [from, to] = box_of(edge);
                    (0..2).all(|axis| low[axis] <= to[axis].into() && high[axis] >= from[axis].into())
                });
                assert_eq!(clip.may_touch(low, high), touches, "{low:?} to {high:?} in {:?}", clip.corners());
                answers[usize::from(is_inside)] += 1;
                answers[2 + usize::from(touches)] += 1;
            }
        }
        assert!(answers.iter().all(|&count| count > 100), "{answers:?}");
    }
}
