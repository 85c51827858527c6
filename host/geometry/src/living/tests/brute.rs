//! The answers of a triangulation by brute force, from a list of points and their mesh. The CPU triangulator makes that
//! mesh, and the validator, which shares no code with it, confirms each.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use incircle_testkit::orient2d;

use crate::cpu;
use crate::living::Location;
use crate::mesh::Mesh;
use crate::point::Point;

/// The living points by index, and their mesh.
pub struct Brute {
    pub points: Vec<Option<Point>>,
    pub mesh: Mesh,
    /// The index of each point of the mesh.
    pub indices: Vec<u32>,
}

impl Brute {
    pub fn new() -> Self {
        Self { points: Vec::new(), mesh: Mesh::default(), indices: Vec::new() }
    }

    /// Triangulates the living points anew.
    pub fn renew(&mut self) {
        let living = (0u32..).zip(&self.points).filter_map(|(index, point)| Some((index, (*point)?)));
        let (indices, points): (Vec<u32>, Vec<Point>) = living.unzip();
        self.indices = indices;
        self.mesh = cpu::triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("a mesh");
        self.mesh.verify().expect("the canonical mesh");
    }

    /// The indices of places, the lowest of each.
    pub fn places(&self) -> Vec<(u32, Point)> {
        let all: Vec<(u32, Point)> = self.indices.iter().copied().zip(self.mesh.points.iter().copied()).collect();
        let is_first = |&(index, point): &(u32, Point)| all.iter().all(|other| other.1 != point || other.0 >= index);
        all.iter().copied().filter(is_first).collect()
    }

    fn at(&self, rank: u32) -> Point {
        self.mesh.points[rank as usize]
    }

    fn name(&self, rank: u32) -> u32 {
        self.indices[rank as usize]
    }

    pub fn locate(&self, q: Point) -> Location {
        if let Some(&(index, _)) = self.places().iter().find(|place| place.1 == q) {
            return Location::Vertex(index);
        }
        let hull = &self.mesh.hull;
        let edges = |triangle: [u32; 3]| [0, 1, 2].map(|k| [triangle[k], triangle[(k + 1) % 3]]);
        let is_inside = |[a, b]: [u32; 2]| {
            let ([p, r], on) = ([self.at(a), self.at(b)], orient2d(self.at(a), self.at(b), q) == 0);
            on && (p.min(r) < q && q < p.max(r))
        };
        let line = if self.mesh.triangles.is_empty() { hull.windows(2) } else { [].windows(2) };
        let all = self.mesh.triangles.iter().flat_map(|&t| edges(t)).chain(line.map(|pair| [pair[0], pair[1]]));
        for edge in all {
            if is_inside(edge) {
                let [one, other] = edge.map(|rank| self.name(rank));
                return Location::Edge([one.min(other), one.max(other)]);
            }
        }
        let holds = |&&t: &&[u32; 3]| edges(t).iter().all(|&[a, b]| orient2d(self.at(a), self.at(b), q) > 0);
        if let Some(triangle) = self.mesh.triangles.iter().find(holds) {
            return Location::Triangle(triangle.map(|rank| self.name(rank)));
        }
        if self.mesh.triangles.is_empty() {
            return Location::None;
        }
        let edge = |k: usize| [hull[k % hull.len()], hull[(k + 1) % hull.len()]];
        let is_visible = |k: usize| orient2d(self.at(edge(k)[0]), self.at(edge(k)[1]), q) < 0;
        let first = (0..hull.len()).find(|&k| is_visible(k) && !is_visible(k + hull.len() - 1));
        Location::Outside(edge(first.expect("a place outside sees an edge")).map(|rank| self.name(rank)))
    }

    pub fn distance(p: Point, q: Point) -> u64 {
        let (x, y) = (u64::from(p.x.abs_diff(q.x)), u64::from(p.y.abs_diff(q.y)));
        x * x + y * y
    }

    /// All places, the nearest first.
    pub fn by_nearness(&self, q: Point) -> Vec<u32> {
        let mut places = self.places();
        places.sort_by_key(|&(_, p)| (Self::distance(p, q), p));
        places.into_iter().map(|place| place.0).collect()
    }

    /// The triangles whose inside the segment crosses, in its order: each edge of a triangle cuts an interval off the
    /// segment, whose ends are fractions.
    pub fn segment(&self, a: Point, b: Point) -> Vec<[u32; 3]> {
        let less = |[p, q]: [i128; 2], [r, s]: [i128; 2]| p * s < r * q;
        let mut crossed: Vec<([i128; 2], [u32; 3])> = Vec::new();
        'triangles: for &triangle in &self.mesh.triangles {
            let (mut low, mut high) = ([0, 1], [1, 1]);
            for k in 0..3 {
                let [from, to] = [k, (k + 1) % 3].map(|k| self.at(triangle[k]));
                let (start, end) = (orient2d(from, to, a), orient2d(from, to, b));
                match (start > 0, end > 0) {
                    (true, true) => {}
                    (false, false) => continue 'triangles,
                    // The value is 0 at the fraction start / (start - end) of the segment.
                    (true, false) if less([start, start - end], high) => high = [start, start - end],
                    (false, true) if less(low, [-start, end - start]) => low = [-start, end - start],
                    _ => {}
                }
            }
            if a == b || less(low, high) {
                crossed.push((low, triangle.map(|rank| self.name(rank))));
            }
        }
        crossed.sort_by(|one, other| (one.0[0] * other.0[1]).cmp(&(other.0[0] * one.0[1])));
        crossed.into_iter().map(|entry| entry.1).collect()
    }

    /// The edges of the mesh by index, sorted.
    pub fn edges(&self) -> Vec<[u32; 2]> {
        let sides = self.mesh.triangles.iter().flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]);
        let line = if self.mesh.triangles.is_empty() { self.mesh.hull.windows(2) } else { [].windows(2) };
        let all = sides.chain(line.map(|pair| [pair[0], pair[1]]));
        let named = all.map(|edge| edge.map(|rank| self.name(rank)));
        let mut edges: Vec<[u32; 2]> = named.map(|[one, other]| [one.min(other), one.max(other)]).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// The triangles of the mesh by index.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        self.mesh.triangles.iter().map(|triangle| triangle.map(|rank| self.name(rank))).collect()
    }

    pub fn hull(&self) -> Vec<u32> {
        self.mesh.hull.iter().map(|&rank| self.name(rank)).collect()
    }
}
