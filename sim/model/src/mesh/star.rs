//! The growth of a cavity, and its replacement by the star of the new vertex (Bowyer 1981, Watson 1981). In hardware,
//! `hdl/src/engine/commit/` writes the star.

use super::cavity::{Cavity, Entry};
use super::record::Record;
use super::Mesh;
use crate::predicate::Point;

impl Mesh {
    /// Finds the cavity of `p`, whose root is `root`. Returns false if the boundary has more entries than the list.
    pub(super) fn grow(&mut self, root: u32, p: Point) -> bool {
        let mut cavity = std::mem::replace(&mut self.cavity, Cavity::new(0));
        cavity.start(root, self.records[root as usize].n);
        let mut done = 0;
        let mut fits = true;
        while fits && done < cavity.queue.len() {
            let test = cavity.queue[done];
            done += 1;
            let record = &self.records[test.record as usize];
            let slot = record.slot_of(test.cavity_record);
            let turned = record.rotated(slot);
            if self.in_conflict(&turned, p) {
                fits = cavity.split(test, &turned);
            } else {
                cavity.entries[usize::from(test.entry)] = Entry {
                    first_vertex: turned.v[2],
                    outside_record: test.record,
                    slot: slot as u8,
                    cavity_record: test.cavity_record,
                    after: test.after,
                };
            }
        }
        // In the core, the visits in flight complete when the list overflows, and are counted.
        self.counts.tests += cavity.queue.len() as u32;
        self.cavity = cavity;
        fits
    }

    /// Replaces the cavity by the star of `p`, with one record for each entry of the boundary.
    ///
    /// The record of an entry takes the id of the cavity record behind it, unless the entry before or the first entry
    /// took that id. Then it takes the id of an inner record, and the last two take new ids.
    pub(super) fn commit(&mut self, p: u32) {
        let cavity = std::mem::replace(&mut self.cavity, Cavity::new(0));
        self.counts.cavity_triangles += u32::from(cavity.count) - 2;
        let mut inner = cavity.inner.iter().copied();
        let first = cavity.entries[0];
        let first_id = first.cavity_record;
        let (mut entry, mut id) = (cavity.entries[usize::from(first.after)], 0);
        let second_vertex = entry.first_vertex;
        let mut second_id = 0;
        let (mut before_record, mut before_id) = (first.cavity_record, first_id);
        let mut at_second = true;
        // `entry` runs from the second entry to the last. Writing a record needs the id of the record after it.
        let mut is_last = first.after == 0;
        let mut pending = None::<(Entry, u32, u32)>;
        while !is_last {
            id = if entry.cavity_record == before_record || entry.cavity_record == first.cavity_record {
                inner.next().unwrap_or_else(|| self.new_record())
            } else {
                entry.cavity_record
            };
            if at_second {
                second_id = id;
                at_second = false;
            }
            if let Some((ahead, ahead_id, back)) = pending {
                self.write_star(p, ahead, ahead_id, entry.first_vertex, id, back);
            }
            pending = Some((entry, id, before_id));
            (before_record, before_id) = (entry.cavity_record, id);
            is_last = entry.after == 0;
            entry = cavity.entries[usize::from(entry.after)];
        }
        if let Some((last, last_id, back)) = pending {
            self.write_star(p, last, last_id, first.first_vertex, first_id, back);
        }
        self.write_star(p, first, first_id, second_vertex, second_id, id);
        self.cavity = cavity;
    }

    /// Writes the record of one entry, and the neighbour in the record outside unless it is right already.
    fn write_star(&mut self, p: u32, entry: Entry, id: u32, b: u32, after: u32, before: u32) {
        self.records[id as usize] = Record { v: [p, entry.first_vertex, b], n: [entry.outside_record, after, before] };
        if id != entry.cavity_record {
            self.records[entry.outside_record as usize].n[usize::from(entry.slot)] = id;
        }
    }
}
