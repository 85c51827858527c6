//! The triangulation as the core stores it, and the insertion of points into it, one after the other. The insertion
//! engine of the core does the same in many contexts at once.

mod approach;
mod cavity;
mod change;
mod filling;
pub(crate) mod free;
pub(crate) mod hole;
mod question;
mod record;
mod solo;
mod star;
mod walk;

use crate::predicate::{orient2d, Point};
pub use approach::Approach;
use cavity::Cavity;
use free::FreeRecords;
use hole::Hole;
use incircle_protocol::{infinite_vertex, Outcome};
pub use record::Record;

/// Number of records of a first triangle: the triangle and three ghost triangles.
const SEED_RECORDS: u32 = 4;

/// The outcome for one point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Insertion {
    /// The point is a vertex of the mesh now, or is one of the first three of a job, which become a triangle together.
    Inserted,
    /// The point equals a vertex.
    Duplicate,
    /// The point completes a collinear triple. Nothing was inserted, and nothing will be until a clear.
    Collinear,
    /// The point was refused: the memory is full, or the first three points were collinear.
    Refused,
}

/// What a change of a standing mesh did: its outcome, and the vertex that the answer names.
pub type Changed = (Outcome, u32);

/// Numbers of events since the last clear; see `incircle_protocol::Counter`.
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
    /// For each point that has arrived, whether it is a vertex of the mesh.
    is_vertex: Vec<bool>,
    free: FreeRecords,
    /// The hint of each job: the record at which its next walk starts, which holds the point that was inserted or found
    /// last. There is one job unless a batch is in progress.
    starts: Vec<u32>,
    collinear: bool,
    counts: Counts,
    /// Number of vertices taken out of the mesh since the last clear; those that were put back by a move count.
    deletions: u32,
    cavity: Cavity,
    hole: Hole,
}

impl Mesh {
    /// An empty mesh for `capacity` points, with boundary lists of `ring_capacity` entries.
    pub fn new(capacity: u32, ring_capacity: u32) -> Self {
        Self {
            capacity,
            infinite: infinite_vertex(capacity),
            points: Vec::new(),
            records: Vec::new(),
            is_vertex: Vec::new(),
            free: FreeRecords::default(),
            starts: vec![0],
            collinear: false,
            counts: Counts::default(),
            deletions: 0,
            cavity: Cavity::new(ring_capacity),
            hole: Hole::default(),
        }
    }

    /// Forgets everything but the parameters. The allocated memory is kept.
    pub fn clear(&mut self) {
        self.clear_for(1);
    }

    /// Forgets everything and starts a batch of `jobs` jobs, at least one, each with a mesh of its own. The first
    /// points that arrive are three for each job; the later ones are dealt to the jobs in turn.
    pub fn clear_for(&mut self, jobs: u32) {
        self.points.clear();
        self.records.clear();
        self.is_vertex.clear();
        self.free.clear();
        // Ids of the first records of each job, which exist as soon as the job has three points.
        self.starts = (0..jobs.max(1)).map(|job| SEED_RECORDS * job).collect();
        self.collinear = false;
        self.counts = Counts::default();
        self.deletions = 0;
    }

    /// All records, in the order of their ids, the free ones included. There are none before the third point.
    pub fn records(&self) -> &[Record] {
        &self.records
    }

    /// Number of records that are not free: `2 n - 2` for `n` vertices.
    pub fn live_records(&self) -> u32 {
        self.records.len() as u32 - self.free.len()
    }

    /// Whether a record is free: its triangle was deleted, and no other has its id yet.
    pub fn is_free(&self, record: &Record) -> bool {
        record.v == [self.infinite; 3]
    }

    /// Number of vertices of the mesh; from the third point on the first two count.
    pub fn vertices(&self) -> u32 {
        self.counts.insertions - self.deletions
    }

    /// Whether there is one mesh to ask and to change: three points span a triangle, and no batch is in progress.
    pub fn can_change(&self) -> bool {
        self.starts.len() == 1 && !self.records.is_empty()
    }

    /// Numbers of events since the last clear.
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// Whether the first three points were collinear; in a batch, those of any job.
    pub fn is_collinear(&self) -> bool {
        self.collinear
    }

    /// Allocates memory for `more` points, if that many fit. Memory for more than a million is allocated only
    /// as the points come.
    pub fn reserve(&mut self, more: u32) {
        const BELIEVED: u32 = 1 << 20;
        let points = more.min(self.capacity - self.counts.arrived).min(BELIEVED) as usize;
        self.points.reserve_exact(points);
        self.records.reserve_exact(2 * points);
    }

    /// Inserts one point. The walk to it starts where the last one ended.
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

    /// Accepts and numbers a point, or returns `None` if it is refused.
    fn arrive(&mut self, p: Point) -> Option<u32> {
        if self.collinear || self.counts.arrived == self.capacity {
            self.counts.refused += 1;
            return None;
        }
        let id = self.counts.arrived;
        self.counts.arrived += 1;
        self.points.push(p);
        self.is_vertex.push(false);
        Some(id)
    }

    /// Writes the first finite triangle of a job and its three ghost triangles, from the job's first three vertices.
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
        self.is_vertex[first as usize..first as usize + 3].fill(true);
        Insertion::Inserted
    }

    fn insert_vertex(&mut self, id: u32, p: Point, job: usize) -> Insertion {
        let root = self.locate(p, self.starts[job]);
        self.starts[job] = root;
        self.insert_in(id, p, root)
    }

    /// Inserts a vertex whose point this record holds.
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
        self.is_vertex[id as usize] = true;
        Insertion::Inserted
    }

    /// The id for a record beyond those that an insertion replaces: a free one, or one that no record has had.
    fn new_record(&mut self) -> u32 {
        // So many records are there when the memory is full of vertices.
        let are_all_used = self.records.len() as u32 >= 2 * self.capacity - 2;
        self.free.take(are_all_used).unwrap_or_else(|| {
            self.records.push(Record::default());
            self.records.len() as u32 - 1
        })
    }

    /// The slot of the infinite vertex in a ghost triangle, or `None` for a finite triangle.
    #[inline]
    fn infinite_slot(&self, v: [u32; 3]) -> Option<usize> {
        v.iter().position(|&v| v == self.infinite)
    }

    /// Whether `p`, which is no vertex of the mesh, conflicts with `u`.
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
