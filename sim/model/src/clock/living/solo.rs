//! The solo insertion of a point whose boundary is longer than the list: by flips, while no other context works.
//!
//! The block of the core makes three visits for each flip, one after another. Here all steps are found in one clock,
//! and their visits and writes then take the clocks that they would.

use super::judge::{judge, Verdict};
use super::sight::Sight;
use super::visit::{Ask, Visit};
use crate::clock::memory::{Memory, Write};
use crate::mesh::Record;
use incircle_protocol::patience;
use std::collections::BTreeMap;

/// Number of clocks of a visit, from its request to the next.
const VISIT: u64 = 18;

/// The steps of a solo insertion.
pub(super) struct Solo<'m> {
    memory: &'m Memory,
    sight: Sight,
    /// Records as the writes so far leave them.
    changed: BTreeMap<u32, Record>,
    pub writes: Vec<Write>,
    visits: u64,
}

/// The current triangle of the star: its record is `(p, a, b)` with the neighbours `(outer, after, before)`.
struct Corner {
    id: u32,
    record: Record,
    /// The record that `outer` names across this edge.
    back: u32,
}

impl<'m> Solo<'m> {
    pub(super) fn new(memory: &'m Memory, sight: Sight) -> Self {
        Self { memory, sight, changed: BTreeMap::new(), writes: Vec::new(), visits: 0 }
    }

    /// Number of clocks of all visits.
    pub(super) fn clocks(&self) -> u64 {
        VISIT * self.visits
    }

    fn visit(&mut self, id: u32) -> (Record, Verdict) {
        self.visits += 1;
        // A mesh that a defect has spoilt may send the walk in circles.
        assert!(self.visits <= u64::from(patience(self.memory.capacity())), "a solo insertion does not end");
        let record = self.changed.get(&id).copied().unwrap_or_else(|| self.memory.record(id));
        (record, judge(&Visit::new(0, Ask::Walk, id), &record, &self.sight, self.memory))
    }

    fn write(&mut self, write: Write) {
        let (id, links) = (write.id, write.links);
        let old = self.changed.get(&id).copied().unwrap_or_else(|| self.memory.record(id));
        let v = if write.vertices { write.record.v } else { old.v };
        let n = std::array::from_fn(|slot| if links[slot] { write.record.n[slot] } else { old.n[slot] });
        self.changed.insert(id, Record { v, n });
        self.writes.push(write);
    }

    /// Walks to the record that holds the point. Returns the vertex that has the point, if one does.
    pub(super) fn find(&mut self, start: u32) -> Result<u32, u32> {
        let mut id = start;
        loop {
            let (record, verdict) = self.visit(id);
            match verdict.corner {
                Some(corner) if !verdict.is_free => return Err(record.v[corner]),
                _ if verdict.holds => return Ok(id),
                _ => id = verdict.next,
            }
        }
    }

    /// Splits the record that holds the point, with two more ids, and flips once round the star.
    pub(super) fn insert(&mut self, root: u32, [second, third]: [u32; 2]) {
        let (old, p) = (self.visit(root).0, self.sight.vertex);
        let [v0, v1, v2] = old.v;
        self.write(Write::record(second, [p, v2, v0], [old.n[1], third, root]));
        self.write(Write::record(third, [p, v0, v1], [old.n[2], root, second]));
        self.write(Write::record(root, [p, v1, v2], [old.n[0], second, third]));
        for (outer, id) in [(old.n[1], second), (old.n[2], third)] {
            let slot = self.visit(outer).0.slot_of(root);
            self.write(Write::link(outer, slot, id));
        }
        let mut star = Corner { id: root, record: self.visit(root).0, back: root };
        loop {
            let outer = star.record.n[0];
            let (record, verdict) = self.visit(outer);
            let slot = record.slot_of(star.back);
            if verdict.conflict {
                self.flip(&mut star, &record.rotated(slot));
                continue;
            }
            if star.back != star.id {
                self.write(Write::link(outer, slot, star.id));
            }
            if star.record.v[2] == v1 {
                return;
            }
            let next = star.record.n[1];
            star = Corner { id: next, record: self.visit(next).0, back: next };
        }
    }

    /// Flips the edge between the current triangle and `u`, which is turned so that its apex comes first. The id of `u`
    /// becomes the next triangle of the star.
    fn flip(&mut self, star: &mut Corner, u: &Record) {
        let ([p, a, b], [flipped, after, before]) = (star.record.v, star.record.n);
        let apex = u.v[0];
        self.write(Write::record(star.id, [p, a, apex], [u.n[1], flipped, before]));
        self.write(Write::record(flipped, [p, apex, b], [u.n[2], after, star.id]));
        self.write(Write::link(after, 2, flipped));
        *star = Corner { record: Record { v: [p, a, apex], n: [u.n[1], flipped, before] }, back: flipped, ..*star };
    }
}
