//! The cavity of an insertion (Bowyer 1981, Watson 1981).
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
//! Tests are carried out in the order in which they arose, as the core's queue of visits does.

use super::record::Record;

/// A final edge of the boundary: from `first_vertex` to that of the next entry, with the point on its left.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Entry {
    pub(super) first_vertex: u32,
    /// The triangle outside, which stays, and the slot of its link to `cavity_record`.
    pub(super) outside_record: u32,
    pub(super) slot: u8,
    /// The cavity triangle behind the edge.
    pub(super) cavity_record: u32,
    pub(super) after: u8,
}

/// A test to be made: is `record`, before the edge of `entry`, in conflict?
#[derive(Clone, Copy, Debug)]
pub(super) struct Test {
    pub(super) entry: u8,
    pub(super) after: u8,
    /// The entry that was allocated when `cavity_record` joined the cavity, 0 for the root: names it in `half_open`.
    pub(super) cavity_entry: u8,
    pub(super) cavity_record: u32,
    pub(super) record: u32,
}

/// Scratch memory of an insertion.
#[derive(Clone, Debug)]
pub(super) struct Cavity {
    capacity: u8,
    pub(super) entries: Vec<Entry>,
    pub(super) count: u8,
    pub(super) queue: Vec<Test>,
    /// Bit `y`: one of the two edges that entry `y`'s cavity triangle brought has been passed. The root brought three
    /// edges and uses bits 0 and 1.
    half_open: u64,
    /// Cavity triangles without a boundary edge.
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

    /// Passes through the edge of `test`: the ring grows by one entry. False if it has no room.
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
