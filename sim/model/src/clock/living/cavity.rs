//! The cavity of an insertion: its tests, and the writes of its commit.

use super::commit::{Job, Step};
use super::context::Entry;
use super::pipeline::Flight;
use super::visit::Ask;
use super::work::Work;
use crate::clock::memory::Write;

impl Work<'_> {
    /// The root conflicts with the point: its three neighbours are tested.
    pub(super) fn open_cavity(&mut self, root: &Flight) {
        self.cx.cavity.start();
        (self.cx.drains, self.cx.overflows) = (false, false);
        let id = root.visit.record;
        for entry in 0..3u8 {
            let ask = Ask::Test { entry, after: (entry + 1) % 3, cavity_entry: 0 };
            self.ask_across(ask, root.record.n[usize::from(entry)], id);
        }
    }

    /// A test has completed.
    pub(super) fn tested(&mut self, flight: &Flight, entry: u8, after: u8, cavity_entry: u8) {
        if self.counts(flight) {
            let slot = flight.record.slot_of(flight.visit.from);
            let record = flight.record.rotated(slot);
            let (id, cavity_record) = (flight.visit.record, flight.visit.from);
            if !flight.verdict.conflict {
                self.cx.cavity.entries[usize::from(entry)] =
                    Entry { first_vertex: record.v[2], outside: id, slot, cavity_record, after };
            } else if self.cx.cavity.entries.len() == self.sh.config.ring as usize {
                (self.cx.drains, self.cx.overflows) = (true, true);
            } else {
                let y = self.cx.cavity.split(cavity_entry, cavity_record);
                self.ask_across(Ask::Test { entry, after: y, cavity_entry: y }, record.n[1], id);
                self.ask_across(Ask::Test { entry: y, after, cavity_entry: y }, record.n[2], id);
            }
        }
        match (self.cx.in_flight, self.cx.drains) {
            (0, true) => self.end_drained(),
            (0, false) => self.close_cavity(),
            _ => {}
        }
    }

    /// The ring is complete: the star of the point is written in place of the cavity.
    ///
    /// The record of an entry takes the id of the cavity record behind it, unless the entry before or the first entry
    /// took that id. Then it takes the id of an inner record, and the last two take ids that are free. The first record
    /// is written last, because it needs the id of the last.
    fn close_cavity(&mut self) {
        let entries = self.ring_of_cavity();
        let inner = std::mem::take(&mut self.cx.cavity.inner);
        let mut inner = inner.into_iter();
        let mut ids: Vec<u32> = Vec::with_capacity(entries.len());
        let mut before = None;
        for entry in &entries {
            let is_taken = before == Some(entry.cavity_record)
                || !ids.is_empty() && entry.cavity_record == entries[0].cavity_record;
            ids.push(match is_taken {
                true => inner.next().unwrap_or_else(|| self.sh.new_record()),
                false => entry.cavity_record,
            });
            before = Some(entry.cavity_record);
        }
        let mut job = Job::new(self.x, self.cx.since);
        let count = entries.len();
        for place in (1..count).chain([0]) {
            let (entry, after) = (&entries[place], (place + 1) % count);
            let v = [self.cx.sight.vertex, entry.first_vertex, entries[after].first_vertex];
            let n = [entry.outside, ids[after], ids[(place + count - 1) % count]];
            job.steps.push_back(Step::Write(Write::record(ids[place], v, n)));
            if ids[place] != entry.cavity_record {
                job.steps.push_back(Step::Write(Write::link(entry.outside, entry.slot, ids[place])));
            }
        }
        job.point = Some((self.cx.sight.vertex, self.cx.sight.to));
        self.note_vertex();
        self.hand_over(job);
    }

    /// Counts the vertex that is inserted.
    pub(super) fn note_vertex(&mut self) {
        self.sh.vertices += 1;
        self.sh.arrived = self.sh.arrived.max(self.cx.sight.vertex + 1);
    }

    /// The entries of the ring, in its order.
    fn ring_of_cavity(&self) -> Vec<Entry> {
        let entries = &self.cx.cavity.entries;
        let mut ring = vec![entries[0]];
        let mut place = entries[0].after;
        while place != 0 && ring.len() <= entries.len() {
            ring.push(entries[usize::from(place)]);
            place = entries[usize::from(place)].after;
        }
        ring
    }
}
