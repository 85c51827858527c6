//! The cavity of an insertion (Bowyer 1981, Watson 1981). In hardware, `hdl/src/engine/attempt/` grows it.
//!
//! The boundary is a singly linked ring of entries, split in place:
//! ```text
//!           c                         c
//!          / \                       ^ \
//!         /   \      conflict       /   \
//!        /  u  \     ------->   X  /     \  Y     X = (a -> c), Y = (c -> b)
//!       a ----> b                 a       v
//!           X                              b
//!           p                         p
//! ```
//! Tests are made in the order in which they arose, like the visits in the core's queue.

use super::record::Record;

/// A final edge of the boundary, from `first_vertex` to that of the next entry, with the point on its left.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Entry {
    pub(super) first_vertex: u32,
    /// The record outside, which stays, and the slot in which it names `cavity_record` as its neighbour.
    pub(super) outside_record: u32,
    pub(super) slot: u8,
    /// The cavity record behind the edge.
    pub(super) cavity_record: u32,
    pub(super) after: u8,
}

/// A test to be made: does `record`, in front of the edge of `entry`, conflict with the point?
#[derive(Clone, Copy, Debug)]
pub(super) struct Test {
    pub(super) entry: u8,
    pub(super) after: u8,
    /// The entry that was allocated when `cavity_record` joined the cavity, or 0 for the root. The number stands for
    /// that record in `half_open`.
    pub(super) cavity_entry: u8,
    pub(super) cavity_record: u32,
    pub(super) record: u32,
}

/// The scratch memory of an insertion.
#[derive(Clone, Debug)]
pub(super) struct Cavity {
    capacity: u8,
    pub(super) entries: Vec<Entry>,
    pub(super) count: u8,
    pub(super) queue: Vec<Test>,
    /// Bit `y` says that the boundary has moved across one of the two edges that the cavity record of entry `y`
    /// brought. The root brought three edges, and uses bits 0 and 1.
    half_open: u64,
    /// Inner records: cavity records without an edge on the boundary.
    pub(super) inner: Vec<u32>,
}

impl Cavity {
    pub(super) fn new(ring_capacity: u32) -> Self {
        let capacity = ring_capacity as usize;
        Self {
            capacity: ring_capacity as u8,
            entries: vec![Entry::default(); capacity],
            count: 0,
            queue: Vec::with_capacity(2 * capacity),
            half_open: 0,
            inner: Vec::with_capacity(capacity),
        }
    }

    /// Number of entries for which the list has room.
    pub(super) fn capacity(&self) -> usize {
        self.capacity.into()
    }

    pub(super) fn start(&mut self, root: u32, n: [u32; 3]) {
        self.queue.clear();
        self.inner.clear();
        self.half_open = 0;
        self.count = 3;
        for entry in 0..3u8 {
            self.queue.push(Test {
                entry,
                after: (entry + 1) % 3,
                cavity_entry: 0,
                cavity_record: root,
                record: n[usize::from(entry)],
            });
        }
    }

    /// Moves the boundary across the edge of `test`, so that the ring grows by one entry. Returns false if
    /// the list is full.
    pub(super) fn split(&mut self, test: Test, record: &Record) -> bool {
        if self.count == self.capacity {
            return false;
        }
        if self.passes_last_edge(test.cavity_entry) {
            self.inner.push(test.cavity_record);
        }
        let y = self.count;
        self.count += 1;
        self.queue.push(Test { after: y, cavity_entry: y, cavity_record: test.record, record: record.n[1], ..test });
        self.queue.push(Test { entry: y, cavity_entry: y, cavity_record: test.record, record: record.n[2], ..test });
        true
    }

    fn passes_last_edge(&mut self, cavity_entry: u8) -> bool {
        let bit = 1 << cavity_entry;
        if self.half_open & bit == 0 {
            self.half_open |= bit;
            return false;
        }
        if cavity_entry == 0 && self.half_open & 2 == 0 {
            self.half_open |= 2;
            return false;
        }
        true
    }
}
