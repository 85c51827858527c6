//! The memories, and the registered write port of the triangle memory.
//!
//! Hardware twin: the blocks of `hdl/src/mesh/`.

use super::defect::Defect;
use super::wires::{Registers, Wires};
use crate::mesh::Record;
use crate::predicate::Point;
use incircle_protocol::{infinite_vertex, triangle_capacity, Config, Layout};

/// A write into the triangle memory: a whole record, or one neighbour of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Write {
    /// Whether there is a write.
    pub valid: bool,
    /// Id of the record that is written.
    pub id: u32,
    /// Whether the vertices are written.
    pub vertices: bool,
    /// The slots whose neighbours are written.
    pub links: [bool; 3],
    /// The data of vertices and neighbours.
    pub record: Record,
}

impl Write {
    /// A write of a whole record.
    pub(super) fn record(id: u32, v: [u32; 3], n: [u32; 3]) -> Self {
        Self { valid: true, id, vertices: true, links: [true; 3], record: Record { v, n } }
    }

    /// A write of one neighbour. The value is in all three slots, and the vertices are zero.
    pub(super) fn link(id: u32, slot: usize, value: u32) -> Self {
        let mut links = [false; 3];
        links[slot] = true;
        Self { valid: true, id, vertices: false, links, record: Record { v: [0; 3], n: [value; 3] } }
    }

    /// Takes the request of the block that makes one. While no block does, the data stay.
    pub(super) fn clock(&mut self, was: &Registers) {
        let sources = [was.commit.write, was.filled, was.solo.write, was.seeder.write];
        let requests = sources.iter().filter(|write| write.valid).count();
        assert!(requests <= 1, "{requests} writes are requested at one edge");
        match sources.into_iter().find(|write| write.valid) {
            Some(write) => *self = write,
            None => self.valid = false,
        }
    }
}

/// A final edge of the boundary.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Entry {
    pub first_vertex: u32,
    pub outside_record: u32,
    pub slot: usize,
    pub cavity_record: u32,
    pub after: usize,
}

/// All memories of the core.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    pub infinite: u32,
    layout: Layout,
    records: Vec<Record>,
    vertices: Vec<Point>,
    pub locks: Vec<bool>,
    /// The context that took the lock last.
    holders: Vec<usize>,
    /// Entries of the ring, inner records, and logged locks of each context.
    pub entries: Vec<Vec<Entry>>,
    pub inner: Vec<Vec<u32>>,
    pub lock_log: Vec<Vec<u32>>,
    /// The current point of each context, and the clock in which the context took it.
    pub point_id: Vec<u32>,
    pub position: Vec<Point>,
    /// The place to which the item of each context moves its vertex; and whether that vertex goes back into the mesh,
    /// or has still to be found.
    pub target: Vec<Point>,
    pub inserts: Vec<bool>,
    /// The vertices opposite the records of each context's star at which its chains stand: to the right and to the
    /// left.
    pub carried: Vec<[u32; 2]>,
    pub since: Vec<u32>,
    /// The ids of two free records for each vertex that has been deleted.
    kept: Vec<Option<[u32; 2]>>,
}

impl Memory {
    pub(super) fn new(config: Config) -> Self {
        let records = triangle_capacity(config.points) as usize;
        let (contexts, ring) = (config.contexts as usize, config.ring as usize);
        Self {
            infinite: infinite_vertex(config.points),
            layout: Layout::of(incircle_protocol::CORE_COORD_BITS, config.points),
            records: vec![Record::default(); records],
            vertices: vec![Point::default(); config.points as usize],
            locks: vec![false; records],
            holders: vec![0; records],
            entries: vec![vec![Entry::default(); ring.next_power_of_two()]; contexts],
            inner: vec![vec![0; ring]; contexts],
            lock_log: vec![vec![0; 2 * ring]; contexts],
            point_id: vec![0; contexts],
            position: vec![Point::default(); contexts],
            target: vec![Point::default(); contexts],
            inserts: vec![false; contexts],
            carried: vec![[0; 2]; contexts],
            since: vec![0; contexts],
            kept: vec![None; config.points as usize],
        }
    }

    /// Keeps two ids of records for a vertex that is deleted.
    pub(super) fn keep(&mut self, vertex: u32, ids: [u32; 2]) {
        self.kept[vertex as usize] = Some(ids);
    }

    /// The ids that are kept for a vertex.
    pub(super) fn kept(&self, vertex: u32) -> Option<[u32; 2]> {
        self.kept.get(vertex as usize).copied().flatten()
    }

    /// Takes the ids that are kept for a vertex which is in the mesh again.
    pub(super) fn take_kept(&mut self, vertex: u32) {
        self.kept[vertex as usize] = None;
    }

    /// Forgets all ids that are kept.
    pub(super) fn clear_kept(&mut self) {
        self.kept.fill(None);
    }

    /// Whether all vertices of a record, in the words of an answer, are infinite.
    pub(super) fn is_free(&self, words: [u32; 3]) -> bool {
        words.iter().all(|word| word & 0x7fff == self.infinite)
    }

    /// Takes a lock for a context, and returns whether the context took it and whether another context holds it. A lock
    /// that is cleared at this edge counts as held by another.
    pub(super) fn take_lock(
        &mut self,
        id: u32,
        context: usize,
        cleared: Option<u32>,
        defect: Option<Defect>,
    ) -> (bool, bool) {
        let place = id as usize % self.locks.len();
        if cleared == Some(place as u32) {
            return (false, true);
        }
        if self.locks[place] {
            // L9: the stored holder tells a second visit of the same cavity from a visit of another context.
            let is_own = self.holders[place] == context && defect != Some(Defect::TakesOwnForForeign);
            return (false, !is_own);
        }
        self.locks[place] = true;
        self.holders[place] = context;
        (true, false)
    }

    /// The context that holds the lock of a record, if one does.
    pub(super) fn lock_holder(&self, id: u32) -> Option<usize> {
        let place = id as usize % self.locks.len();
        self.locks[place].then(|| self.holders[place])
    }

    /// The record of this id. Ids wrap at the depth of the memory, which ignores the address bits above.
    pub(super) fn record(&self, id: u32) -> Record {
        self.records[id as usize % self.records.len()]
    }

    /// The point of a vertex. The point of the infinite vertex is arbitrary, and never decides anything.
    pub(super) fn vertex(&self, id: u32) -> Point {
        self.vertices[id as usize % self.vertices.len()]
    }

    /// Number of points that the vertex memory holds.
    pub(super) fn capacity(&self) -> u32 {
        self.vertices.len() as u32
    }

    /// Writes the point of a vertex.
    pub(super) fn set_vertex(&mut self, id: u32, point: Point) {
        let place = id as usize % self.vertices.len();
        self.vertices[place] = point;
    }

    pub(super) fn record_words(&self, id: u32) -> [u32; 3] {
        let record = self.record(id);
        let words = self.layout.record_to_words(record.v, record.n, self.locks[id as usize % self.locks.len()]);
        [words[0], words[1], words[2]]
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires) {
        let port = was.write;
        if port.valid {
            let record = &mut self.records[port.id as usize];
            if port.vertices {
                record.v = port.record.v;
            }
            for k in 0..3 {
                if port.links[k] {
                    record.n[k] = port.record.n[k];
                }
            }
        }
        if let Some((id, position)) = wires.new_vertex.or(wires.new_point) {
            self.set_vertex(id, position);
        }
    }
}
