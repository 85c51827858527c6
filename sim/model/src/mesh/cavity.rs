//! The cavity of an insertion and its replacement (Bowyer 1981, Watson 1981).
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
//! Tests are carried out in the order in which they arose, as the core's token queue does.

use super::{Mesh, Record};
use crate::predicate::Point;

/// A final edge of the boundary: from `a` to the next entry's `a`, with `p` on its left.
#[derive(Clone, Copy, Debug, Default)]
struct Entry {
    a: u32,
    /// The triangle outside, which stays, and the slot of its link to `f`.
    u: u32,
    slot: u8,
    /// The cavity triangle behind the edge.
    f: u32,
    next: u8,
}

/// A test to be made: is `u`, before the edge of entry `x`, in conflict?
#[derive(Clone, Copy, Debug)]
struct Test {
    x: u8,
    next: u8,
    /// The entry that was allocated when `f` joined the cavity, 0 for the root: names `f` in `half_open`.
    f_entry: u8,
    f: u32,
    u: u32,
}

/// Scratch memory of an insertion.
#[derive(Clone, Debug)]
pub(super) struct Cavity {
    capacity: u8,
    entries: Vec<Entry>,
    count: u8,
    queue: Vec<Test>,
    /// Bit `y`: one of the two edges that entry `y`'s cavity triangle brought has been passed. The root brought three
    /// edges and uses bits 0 and 1.
    half_open: u64,
    /// Cavity triangles without a boundary edge.
    inner: Vec<u32>,
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

    fn start(&mut self, root: u32, n: [u32; 3]) {
        self.queue.clear();
        self.inner.clear();
        self.half_open = 0;
        self.count = 3;
        for x in 0..3u8 {
            self.queue.push(Test { x, next: (x + 1) % 3, f_entry: 0, f: root, u: n[usize::from(x)] });
        }
    }

    /// Passes through the edge of `test`: the ring grows by one entry. False if it has no room.
    fn split(&mut self, test: Test, u: &Record) -> bool {
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

impl Mesh {
    /// Finds the cavity of `p`, located in `root`. False if its boundary has more entries than the list.
    pub(super) fn grow(&mut self, root: u32, p: Point) -> bool {
        let mut cavity = std::mem::replace(&mut self.cavity, Cavity::new(0));
        cavity.start(root, self.records[root as usize].n);
        let mut done = 0;
        let mut fits = true;
        while fits && done < cavity.queue.len() {
            let test = cavity.queue[done];
            done += 1;
            let record = &self.records[test.u as usize];
            let slot = record.slot_of(test.f);
            let u = record.rotated(slot);
            if self.in_conflict(&u, p) {
                fits = cavity.split(test, &u);
            } else {
                cavity.entries[usize::from(test.x)] =
                    Entry { a: u.v[2], u: test.u, slot: slot as u8, f: test.f, next: test.next };
            }
        }
        // Tests already under way when the list overflows run out, and are counted.
        self.counts.tests += cavity.queue.len() as u32;
        self.cavity = cavity;
        fits
    }

    /// Replaces the cavity by the star of `p`: one record per boundary entry.
    ///
    /// An entry's record takes the id of the cavity triangle behind it, unless the entry before or the first one did;
    /// then it takes an inner triangle's id, and the last two take new ones.
    pub(super) fn commit(&mut self, p: u32) {
        let cavity = std::mem::replace(&mut self.cavity, Cavity::new(0));
        self.counts.cavity_triangles += u32::from(cavity.count) - 2;
        let mut inner = cavity.inner.iter();
        let mut fresh = |records: &mut Vec<Record>| {
            inner.next().copied().unwrap_or_else(|| {
                records.push(Record::default());
                records.len() as u32 - 1
            })
        };
        let first = cavity.entries[0];
        let first_id = first.f;
        let (mut entry, mut id) = (cavity.entries[usize::from(first.next)], 0);
        let second_a = entry.a;
        let mut second_id = 0;
        let (mut before_f, mut before_id) = (first.f, first_id);
        let mut at_second = true;
        // `entry` runs from the second to the last; its record needs the id of the one after it.
        let mut is_last = first.next == 0;
        let mut pending = None::<(Entry, u32, u32)>;
        while !is_last {
            id = if entry.f == before_f || entry.f == first.f { fresh(&mut self.records) } else { entry.f };
            if at_second {
                second_id = id;
                at_second = false;
            }
            if let Some((ahead, ahead_id, back)) = pending {
                self.write_star(p, ahead, ahead_id, entry.a, id, back);
            }
            pending = Some((entry, id, before_id));
            (before_f, before_id) = (entry.f, id);
            is_last = entry.next == 0;
            entry = cavity.entries[usize::from(entry.next)];
        }
        if let Some((last, last_id, back)) = pending {
            self.write_star(p, last, last_id, first.a, first_id, back);
        }
        self.write_star(p, first, first_id, second_a, second_id, id);
        self.cavity = cavity;
    }

    /// Writes the record of one entry, and the link of the triangle outside unless it is right already.
    fn write_star(&mut self, p: u32, entry: Entry, id: u32, b: u32, after: u32, before: u32) {
        self.records[id as usize] = Record { v: [p, entry.a, b], n: [entry.u, after, before] };
        if id != entry.f {
            self.records[entry.u as usize].n[usize::from(entry.slot)] = id;
        }
    }
}
