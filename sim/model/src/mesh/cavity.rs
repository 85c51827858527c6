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

/// A final edge of the boundary: from `a` to the next entry's `a`, with `p` on its left.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Entry {
    pub(super) a: u32,
    /// The triangle outside, which stays, and the slot of its link to `f`.
    pub(super) u: u32,
    pub(super) slot: u8,
    /// The cavity triangle behind the edge.
    pub(super) f: u32,
    pub(super) next: u8,
}

/// A test to be made: is `u`, before the edge of entry `x`, in conflict?
#[derive(Clone, Copy, Debug)]
pub(super) struct Test {
    pub(super) x: u8,
    pub(super) next: u8,
    /// The entry that was allocated when `f` joined the cavity, 0 for the root: names `f` in `half_open`.
    pub(super) f_entry: u8,
    pub(super) f: u32,
    pub(super) u: u32,
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
        for x in 0..3u8 {
            self.queue.push(Test { x, next: (x + 1) % 3, f_entry: 0, f: root, u: n[usize::from(x)] });
        }
    }

    /// Passes through the edge of `test`: the ring grows by one entry. False if it has no room.
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
