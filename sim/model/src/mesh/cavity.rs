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
    pub(super) a: u32,
    /// The record outside, which stays, and the slot in which it names `cavity_record` as its neighbour.
    pub(super) u: u32,
    pub(super) slot: u8,
    /// The cavity record behind the edge.
    pub(super) f: u32,
    pub(super) next: u8,
}

/// A test to be made: does `record`, in front of the edge of `entry`, conflict with the point?
#[derive(Clone, Copy, Debug)]
pub(super) struct Test {
    pub(super) x: u8,
    pub(super) next: u8,
    /// The entry that was allocated when `cavity_record` joined the cavity, or 0 for the root. The number stands for
    /// that record in `half_open`.
    pub(super) f_entry: u8,
    pub(super) f: u32,
    pub(super) u: u32,
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

    pub(super) fn start(&mut self, root: u32, n: [u32; 3]) {
        self.queue.clear();
        self.inner.clear();
        self.half_open = 0;
        self.count = 3;
        for x in 0..3u8 {
            self.queue.push(Test { x, next: (x + 1) % 3, f_entry: 0, f: root, u: n[usize::from(x)] });
        }
    }

    /// Moves the boundary across the edge of `test`, so that the ring grows by one entry. Returns false if
    /// the list is full.
    pub(super) fn split(&mut self, test: Test, u: &Record) -> bool {
        if self.count == self.capacity {
            return false;
        }
        if self.passes_last_edge(test.f_entry) {
            self.inner.push(test.f);
        }
        let y = self.count;
        self.count += 1;
        self.queue.push(Test { x: test.x, next: y, f_entry: y, f: test.u, u: u.n[1] });
        self.queue.push(Test { x: y, next: test.next, f_entry: y, f: test.u, u: u.n[2] });
        true
    }

    fn passes_last_edge(&mut self, f_entry: u8) -> bool {
        let bit = 1 << f_entry;
        if self.half_open & bit == 0 {
            self.half_open |= bit;
            return false;
        }
        if f_entry == 0 && self.half_open & 2 == 0 {
            self.half_open |= 2;
            return false;
        }
        true
    }
}
