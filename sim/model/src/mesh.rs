//! The triangulation as the core stores it, and insertion into it, one point after the other.

mod approach;
mod cavity;
mod record;
mod solo;
mod star;
mod walk;

use crate::predicate::{orient2d, Point};
pub use approach::Approach;
use cavity::Cavity;
use incircle_protocol::infinite_vertex;
pub use record::Record;

/// Records of a first triangle and its ghosts.
const SEED_RECORDS: u32 = 4;

/// What became of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Insertion {
    /// It is a vertex of the mesh now, or one of the first three of a job, which wait for each other.
    Inserted,
    /// It fell onto a vertex.
    Duplicate,
    /// It completes a collinear triple; nothing was inserted, and nothing will be before a clear.
    Collinear,
    /// It was refused: the memory is full, or the start was collinear.
    Refused,
}

/// Events since the last clear; see `incircle_protocol::Counter`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)] // the names are those of `Counter`, where each is explained
pub struct Counts {
    pub arrived: u32,
    pub insertions: u32,
    pub duplicates: u32,
    pub refused: u32,
    pub walk_visits: u32,
    pub tests: u32,
    pub cavity_triangles: u32,
    pub overflows: u32,
    pub flips: u32,
}

/// A canonical Delaunay triangulation under construction.
#[derive(Clone, Debug)]
pub struct Mesh {
    capacity: u32,
    infinite: u32,
    points: Vec<Point>,
    records: Vec<Record>,
    /// Where the next walk of each job starts: a record at its point inserted or found last. One job but in a batch.
    starts: Vec<u32>,
    collinear: bool,
    counts: Counts,
    cavity: Cavity,
}

impl Mesh {
    /// An empty mesh for `capacity` points with boundary lists of `ring_capacity` entries.
    pub fn new(capacity: u32, ring_capacity: u32) -> Self {
        Self {
            capacity,
            infinite: infinite_vertex(capacity),
            points: Vec::new(),
            records: Vec::new(),
            starts: vec![0],
            collinear: false,
            counts: Counts::default(),
            cavity: Cavity::new(ring_capacity),
        }
    }

    /// Forgets everything but its parameters. Keeps its memory.
    pub fn clear(&mut self) {
        self.clear_for(1);
    }

    /// The same; what comes from then on is a batch of so many jobs, at least one, each with a mesh of its own. The first points are three
    /// for each job, the others are dealt to them in turn.
    pub fn clear_for(&mut self, jobs: u32) {
        self.points.clear();
        self.records.clear();
        // The first records of each job, as soon as they are written.
        self.starts = (0..jobs.max(1)).map(|job| SEED_RECORDS * job).collect();
        self.collinear = false;
        self.counts = Counts::default();
    }

    /// All records, by id; empty before the third point.
    pub fn records(&self) -> &[Record] {
        &self.records
    }

    /// Events since the last clear.
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// Whether the first three points were collinear, in a batch those of any job.
    pub fn is_collinear(&self) -> bool {
        self.collinear
    }

    /// Makes room for `more` points, if that many fit; a claim beyond a million is believed as the points come.
    pub fn reserve(&mut self, more: u32) {
        const BELIEVED: u32 = 1 << 20;
        let points = more.min(self.capacity - self.counts.arrived).min(BELIEVED) as usize;
        self.points.reserve_exact(points);
        self.records.reserve_exact(2 * points);
    }

    /// Inserts one point. The search for it begins where the last one ended.
    pub fn insert(&mut self, p: Point) -> Insertion {
        let Some(id) = self.arrive(p) else {
            return Insertion::Refused;
        };
        let jobs = self.starts.len() as u32;
        match id.checked_sub(3 * jobs) {
            None if id % 3 != 2 => Insertion::Inserted,
            None => self.seed(id - 2),
            Some(place) => self.insert_vertex(id, p, (place % jobs) as usize),
        }
    }

    /// Takes a point in, and numbers it; `None` if it is refused.
    fn arrive(&mut self, p: Point) -> Option<u32> {
        if self.collinear || self.counts.arrived == self.capacity {
            self.counts.refused += 1;
            return None;
        }
        let id = self.counts.arrived;
        self.counts.arrived += 1;
        self.points.push(p);
        Some(id)
    }

    /// The first finite triangle of a job and its three ghosts, from its first three vertices.
    fn seed(&mut self, first: u32) -> Insertion {
        let corner = |k: u32| self.points[(first + k) as usize];
        let turn = orient2d(corner(0), corner(1), corner(2));
        if turn == 0 {
            self.collinear = true;
            return Insertion::Collinear;
        }
        let (b, c) = if turn > 0 { (first + 1, first + 2) } else { (first + 2, first + 1) };
        let (a, inf) = (first, self.infinite);
        let id = |k: u32| self.records.len() as u32 + k;
        self.records.extend([
            Record { v: [a, b, c], n: [id(1), id(2), id(3)] },
            Record { v: [c, b, inf], n: [id(3), id(2), id(0)] },
            Record { v: [a, c, inf], n: [id(1), id(3), id(0)] },
            Record { v: [b, a, inf], n: [id(2), id(1), id(0)] },
        ]);
        self.counts.insertions += 3;
        Insertion::Inserted
    }

    fn insert_vertex(&mut self, id: u32, p: Point, job: usize) -> Insertion {
        let root = self.locate(p, self.starts[job]);
        self.starts[job] = root;
        self.insert_in(id, p, root)
    }

    /// Inserts a vertex whose point is in this record.
    #[inline]
    fn insert_in(&mut self, id: u32, p: Point, root: u32) -> Insertion {
        let record = self.records[root as usize];
        let falls_onto = |&v: &u32| v != self.infinite && self.points[v as usize] == p;
        if record.v.iter().any(falls_onto) {
            self.counts.duplicates += 1;
            return Insertion::Duplicate;
        }
        if self.grow(root, p) {
            self.commit(id);
        } else {
            self.counts.overflows += 1;
            self.insert_solo(id, p, root);
        }
        self.counts.insertions += 1;
        Insertion::Inserted
    }

    /// The infinite slot of a ghost, or `None` for a finite triangle.
    #[inline]
    fn infinite_slot(&self, v: [u32; 3]) -> Option<usize> {
        v.iter().position(|&v| v == self.infinite)
    }

    /// Whether inserting `p` removes `u`, a record rotated so that slot 0 is opposite the edge that faces `p`.
    #[inline]
    fn in_conflict(&self, u: &Record, p: Point) -> bool {
        let at = |k: usize| self.points[u.v[k] as usize];
        match self.infinite_slot(u.v) {
            None => crate::predicate::finite_conflict([at(0), at(1), at(2)], p),
            Some(0) => crate::predicate::ghost_conflict(at(1), at(2), p),
            Some(1) => crate::predicate::ghost_conflict(at(2), at(0), p),
            Some(_) => crate::predicate::ghost_conflict(at(0), at(1), p),
        }
    }
}
