//! A mesh for comparison: insertion by recursive flips, written down as a list of writes, and exact checks that
//! share no formula with the core.

use std::collections::BTreeSet;

/// A grid point; points compare by `x`, then by `y`.
pub type Point = (i64, i64);
/// Number of the infinite vertex.
pub const INFINITE: u64 = 0x7fff;

/// A record: its vertices `v`, counter-clockwise, and opposite each the id of a neighbour `n`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Record {
    pub v: [u64; 3],
    pub n: [u64; 3],
}

impl Record {
    /// Slot of the neighbour `id`, or the first slot if no neighbour has this id.
    pub fn slot_to(&self, id: u64) -> usize {
        self.n.iter().position(|n| *n == id).unwrap_or(0)
    }

    pub fn turned(&self, slot: usize) -> Self {
        let turn = |c: [u64; 3]| [c[slot], c[(slot + 1) % 3], c[(slot + 2) % 3]];
        Self { v: turn(self.v), n: turn(self.n) }
    }
}

/// A write to the mesh: a whole record, or one neighbour of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    Record(u64, Record),
    Link { id: u64, slot: u64, value: u64 },
}

/// The points and the records of a mesh.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub points: Vec<Point>,
    pub records: Vec<Record>,
}

/// Writes, tests and flips of an insertion.
#[derive(Clone, Debug, Default)]
pub struct Deeds {
    pub writes: Vec<Written>,
    pub tests: usize,
    pub flips: usize,
}

/// Twice the signed area of a triangle, by the shoelace formula.
fn area(a: Point, b: Point, c: Point) -> i128 {
    let corner = |u: Point, v: Point| i128::from(u.0 * v.1 - v.0 * u.1);
    corner(a, b) + corner(b, c) + corner(c, a)
}

/// Determinant of the points lifted to a paraboloid: positive if `p` lies inside
/// the circle of a counter-clockwise triangle.
fn lifted(triangle: [Point; 3], p: Point) -> i128 {
    let [a, b, c] = triangle.map(|q| {
        let (x, y) = (i128::from(q.0 - p.0), i128::from(q.1 - p.1));
        [x, y, x * x + y * y]
    });
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

impl Mesh {
    /// Makes the mesh of three points that turn left.
    pub fn of(points: [Point; 3]) -> Self {
        let inf = INFINITE;
        let record = |v, n| Record { v, n };
        Self {
            points: points.to_vec(),
            records: vec![
                record([0, 1, 2], [1, 2, 3]),
                record([2, 1, inf], [3, 2, 0]),
                record([0, 2, inf], [1, 3, 0]),
                record([1, 0, inf], [2, 1, 0]),
            ],
        }
    }

    fn at(&self, vertex: u64) -> Point {
        self.points[vertex as usize]
    }

    /// End points of the hull edge of a ghost triangle, with the outside on its left; `None` for a finite triangle.
    fn hull_edge(&self, v: [u64; 3]) -> Option<(Point, Point)> {
        let place = v.iter().position(|v| *v == INFINITE)?;
        Some((self.at(v[(place + 1) % 3]), self.at(v[(place + 2) % 3])))
    }

    /// True if `p` removes this record, which is turned so that its edge `v1 v2` faces `p`.
    pub fn conflicts(&self, v: [u64; 3], p: Point) -> bool {
        if let Some((a, b)) = self.hull_edge(v) {
            let side = area(a, b, p);
            return side > 0 || side == 0 && a.min(b) < p && p < a.max(b);
        }
        let [apex, a, b] = v.map(|v| self.at(v));
        match lifted([apex, a, b], p) {
            // By the tie rule, the diagonal from `p` starts at the smallest of the four points or ends there. It
            // crosses the side that faces `p`.
            0 => {
                let opposite = match () {
                    () if area(b, apex, p) < 0 => a,
                    () if area(apex, a, p) < 0 => b,
                    () => apex,
                };
                [opposite, p].contains(&[apex, a, b, p].into_iter().min().unwrap_or(p))
            }
            inside => inside > 0,
        }
    }

    /// All finite triangles that hold `p`, and all ghost triangles with `p` strictly beyond their edge.
    pub fn places_of(&self, p: Point) -> Vec<u64> {
        let holds = |record: &Record| match self.hull_edge(record.v) {
            Some((a, b)) => area(a, b, p) > 0,
            None => (0..3).all(|k| area(self.at(record.v[k]), self.at(record.v[(k + 1) % 3]), p) >= 0),
        };
        (0..self.records.len()).filter(|id| holds(&self.records[*id])).map(|id| id as u64).collect()
    }

    pub fn write(&mut self, written: Written) {
        match written {
            Written::Record(id, record) => {
                if self.records.len() <= id as usize {
                    // Ids are taken in order, but one may be written before the one below it.
                    self.records.resize(id as usize + 1, record);
                }
                self.records[id as usize] = record;
            }
            Written::Link { id, slot, value } => self.records[id as usize].n[slot as usize] = value,
        }
    }

    fn does(&mut self, deeds: &mut Deeds, written: Written) {
        self.write(written);
        deeds.writes.push(written);
    }

    /// Inserts a point that lies in `root`, and returns the writes.
    pub fn insert(&mut self, point: Point, root: u64) -> Deeds {
        let p = self.points.len() as u64;
        self.points.push(point);
        let mut deeds = Deeds::default();
        let ids = [root, self.records.len() as u64, self.records.len() as u64 + 1];
        let old = self.records[root as usize];
        for k in 0..3 {
            let v = [p, old.v[(k + 1) % 3], old.v[(k + 2) % 3]];
            let n = [old.n[k], ids[(k + 1) % 3], ids[(k + 2) % 3]];
            self.does(&mut deeds, Written::Record(ids[k], Record { v, n }));
        }
        for (outer, value) in [(old.n[1], ids[1]), (old.n[2], ids[2])] {
            let slot = self.records[outer as usize].slot_to(root) as u64;
            let id = outer;
            self.does(&mut deeds, Written::Link { id, slot, value });
        }
        for id in ids {
            // Flips of an earlier edge may have given this star triangle another neighbour, but never another id.
            self.legalise(&mut deeds, id, id);
        }
        deeds
    }

    /// Flips the outer edge of star triangle `id` if it must go, and then all edges that follow from it, from its first
    /// vertex to its last. The triangle outside knows the star as `back`.
    fn legalise(&mut self, deeds: &mut Deeds, id: u64, back: u64) {
        deeds.tests += 1;
        let star = self.records[id as usize];
        let outer = star.n[0];
        let slot = self.records[outer as usize].slot_to(back);
        let u = self.records[outer as usize].turned(slot);
        let [p, a, b] = star.v;
        if !self.conflicts(u.v, self.at(p)) {
            if back != id {
                self.does(deeds, Written::Link { id: outer, slot: slot as u64, value: id });
            }
            return;
        }
        deeds.flips += 1;
        let apex = u.v[0];
        let first = Record { v: [p, a, apex], n: [u.n[1], outer, star.n[2]] };
        let second = Record { v: [p, apex, b], n: [u.n[2], star.n[1], id] };
        self.does(deeds, Written::Record(id, first));
        self.does(deeds, Written::Record(outer, second));
        self.does(deeds, Written::Link { id: star.n[1], slot: 2, value: outer });
        self.legalise(deeds, id, outer);
        self.legalise(deeds, outer, outer);
    }

    /// Checks over all pairs, exactly: every link leads back, both ends of every edge agree, and
    /// no point lies inside any circle.
    pub fn assert_delaunay(&self) {
        assert_eq!(self.records.len(), 2 * self.points.len() - 2);
        let mut edges = BTreeSet::new();
        for (id, record) in self.records.iter().enumerate() {
            for k in 0..3 {
                let (a, b) = (record.v[(k + 1) % 3], record.v[(k + 2) % 3]);
                assert!(edges.insert((a, b)), "edge {a} {b} stands twice");
                let beyond = self.records[record.n[k] as usize];
                let slot = beyond.slot_to(id as u64);
                assert_eq!(
                    (beyond.n[slot], beyond.v[(slot + 1) % 3], beyond.v[(slot + 2) % 3]),
                    (id as u64, b, a),
                    "link {k} of record {id}"
                );
            }
            if self.hull_edge(record.v).is_none() {
                let triangle = record.v.map(|v| self.at(v));
                assert!(area(triangle[0], triangle[1], triangle[2]) > 0, "record {id} turns left");
                let is_inside = |q: &&Point| lifted(triangle, **q) > 0;
                assert_eq!(self.points.iter().find(is_inside), None, "inside the circle of record {id}");
            }
        }
    }
}
