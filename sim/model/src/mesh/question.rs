//! Questions about places. They leave the mesh as it is, but for the hint.

use super::Mesh;
use crate::predicate::{orient2d, Point};
use incircle_protocol::{Located, Outcome};

impl Mesh {
    /// The vertex, edge or triangle at a place, with the weights of the vertices of its triangle.
    ///
    /// The outcome is `Vertex`, `Edge`, `Triangle` or `Outside`. The weight of a vertex is twice the area of the
    /// triangle that the place makes with the other two corners. Vertices whose weight is 0 are not named. There must
    /// be a mesh to ask ([`can_change`](Self::can_change)).
    pub fn look_at(&mut self, p: Point) -> (Outcome, Located) {
        let root = self.walk_to(p);
        let record = self.records[root as usize];
        if let Some(slot) = self.infinite_slot(record.v) {
            let [from, to] = self.first_visible(root, slot, p);
            return (Outcome::Outside, Located { vertices: [from, to, 0], weights: [0; 3] });
        }
        let corners = record.v.map(|vertex| self.points[vertex as usize]);
        let area = |k: usize| orient2d(corners[(k + 1) % 3], corners[(k + 2) % 3], p).unsigned_abs();
        let mut named: Vec<(u32, u64)> = (0..3).map(|k| (record.v[k], area(k))).collect();
        named.retain(|&(_, weight)| weight != 0);
        let outcome = match named.len() {
            1 => Outcome::Vertex,
            2 => Outcome::Edge,
            _ => Outcome::Triangle,
        };
        let mut located = Located::default();
        for (k, (vertex, weight)) in named.into_iter().enumerate() {
            (located.vertices[k], located.weights[k]) = (vertex, weight);
        }
        (outcome, located)
    }

    /// The vertex nearest to a place; of several, the one with the smaller x, then y. There must be a mesh to ask.
    ///
    /// A vertex that is not the nearest has a neighbour that is nearer. Of those at the least distance, which lie on an
    /// empty circle, the smallest is a neighbour of all others, because the diagonals of ties end there. With another
    /// rule for equal distances, the search would end too early.
    pub fn nearest(&mut self, p: Point) -> u32 {
        let root = self.walk_to(p);
        let distance = |q: Point| {
            let (x, y) = (u64::from(q.x.abs_diff(p.x)), u64::from(q.y.abs_diff(p.y)));
            (x * x + y * y, q)
        };
        let near = |mesh: &Self, record: u32| {
            let corners = mesh.records[record as usize].v.into_iter();
            let finite = corners.filter_map(|vertex| Some((distance(mesh.finite_point(vertex)?), vertex, record)));
            finite.min()
        };
        let Some(mut best) = near(self, root) else {
            return self.infinite;
        };
        loop {
            let ((_, vertex, first), mut record) = (best, best.2);
            loop {
                self.counts.walk_visits += 1;
                best = near(self, record).map_or(best, |found| best.min(found));
                record = self.records[record as usize].n[(self.corner_slot(record, vertex) + 1) % 3];
                if record == first {
                    break;
                }
            }
            if best.1 == vertex {
                return vertex;
            }
        }
    }

    /// Walks to a place from where the last walk ended, and returns the record that holds the place.
    pub(super) fn walk_to(&mut self, p: Point) -> u32 {
        let root = self.locate(p, self.starts[0]);
        self.starts[0] = root;
        root
    }

    /// The vertex of the record that has this point.
    pub(super) fn corner_at(&self, record: u32, p: Point) -> Option<u32> {
        self.records[record as usize].v.into_iter().find(|&vertex| self.finite_point(vertex) == Some(p))
    }

    /// The ends of the first, counter-clockwise, of the hull edges that are visible from `p`, which sees that of the
    /// ghost triangle `ghost`. `slot` is that of the infinite vertex.
    fn first_visible(&mut self, ghost: u32, slot: usize, p: Point) -> [u32; 2] {
        let mut edge = self.hull_edge(ghost, slot);
        let mut before = self.records[ghost as usize].n[(slot + 1) % 3];
        loop {
            self.counts.walk_visits += 1;
            let record = self.records[before as usize];
            let slot = usize::from(record.v[1] == self.infinite) | usize::from(record.v[2] == self.infinite) << 1;
            let [from, to] = self.hull_edge(before, slot);
            if orient2d(self.points[from as usize], self.points[to as usize], p) >= 0 {
                return edge;
            }
            (edge, before) = ([from, to], record.n[(slot + 1) % 3]);
        }
    }

    /// The ends of the hull edge of a ghost triangle, counter-clockwise on the hull.
    fn hull_edge(&self, ghost: u32, slot: usize) -> [u32; 2] {
        let v = self.records[ghost as usize].v;
        [v[(slot + 2) % 3], v[(slot + 1) % 3]]
    }
}
