//! The hole of a deleted vertex: it is filled by gift wrapping, with one visit for each test, and then written.

use super::commit::{Job, Step};
use super::context::Next;
use super::pipeline::Flight;
use super::visit::Ask;
use super::work::Work;
use crate::clock::memory::Write;
use crate::mesh::hole::{Across, RingEdge};
use incircle_protocol::{Outcome, RunKind};

impl Work<'_> {
    /// Begins to fill the hole inside this ring.
    pub(super) fn open_hole(&mut self, ring: Vec<RingEdge>) {
        self.cx.filler.hole.ring = ring;
        self.cx.filler.hole.open();
        self.fill_next_part();
    }

    /// Fills parts until one needs a test, or the hole is full.
    fn fill_next_part(&mut self) {
        let filler = &mut self.cx.filler;
        while let Some(part) = filler.hole.next_part(self.memory.infinite) {
            if part.len() == 3 {
                filler.hole.put(&part, 2);
                continue;
            }
            (filler.part, filler.best, filler.tested) = (part, 2, 3);
            return self.ask_corners();
        }
        self.close_hole();
    }

    /// Asks whether the next vertex of the part replaces the best apex.
    fn ask_corners(&mut self) {
        let filler = &self.cx.filler;
        let at = |place: usize| filler.hole.vertex(&filler.part[place]);
        let ask = Ask::Corners { corners: [at(0), at(1), at(filler.best)], other: at(filler.tested) };
        let root = self.cx.root;
        self.ask_across(ask, root, root);
    }

    /// A test of corners has completed.
    pub(super) fn corners_tested(&mut self, flight: &Flight) {
        self.cx.in_flight -= 1;
        let filler = &mut self.cx.filler;
        if flight.verdict.conflict {
            filler.best = filler.tested;
        }
        filler.tested += 1;
        if filler.tested < filler.part.len() {
            return self.ask_corners();
        }
        let part = std::mem::take(&mut filler.part);
        filler.hole.put(&part, filler.best);
        self.fill_next_part();
    }

    /// The hole is full: the triangles are written in place of the star, unless all other points lie on one line.
    fn close_hole(&mut self) {
        if self.cx.filler.hole.is_flat(self.memory.infinite) {
            self.release();
            let vertex = self.cx.sight.vertex;
            return self.end(Outcome::Flat, vertex);
        }
        let (job, keep) = self.job_of_hole();
        self.cx.hint = keep;
        // A record that names the next vertex may be among those outside, or is written now.
        let next = self.cx.items.front().map(|item| item.vertex);
        let names_next = |step: &Step| match step {
            Step::Write(write) if write.vertices => next.filter(|next| write.record.v.contains(next)).map(|_| write.id),
            _ => None,
        };
        self.cx.near[1] = job.steps.iter().find_map(names_next);
        self.sh.vertices -= 1;
        if self.sh.kind == RunKind::Move {
            // The second half of the move inserts the vertex at its new place.
            self.cx.near = [None; 2];
            self.cx.inserts = true;
            self.cx.sight.place = self.cx.sight.to;
            self.commit(job, 0);
            self.cx.next = Next::Walk(keep);
            return self.sh.wake(self.x);
        }
        let vertex = self.cx.sight.vertex as usize;
        self.sh.is_vertex[vertex] = false;
        self.hand_over(job);
    }

    /// The writes of a hole that is full, and a record that stays.
    fn job_of_hole(&self) -> (Job, u32) {
        let hole = &self.cx.filler.hole;
        let (ids, free) = hole.ids();
        let mut job = Job::new(self.x, self.cx.since);
        let mut links = Vec::new();
        let mut keep = ids[0];
        for (filling, &id) in hole.fillings.iter().zip(&ids) {
            let link = |across: Across| match across {
                Across::Ring(edge) => hole.ring[usize::from(edge)].outside,
                Across::Filling(other, _) => ids[usize::from(other)],
            };
            let v = filling.corners.map(|corner| hole.ring[usize::from(corner)].from);
            job.steps.push_back(Step::Write(Write::record(id, v, filling.across.map(link))));
            if !v.contains(&self.memory.infinite) {
                keep = id;
            }
            for across in filling.across {
                if let Across::Ring(edge) = across {
                    let RingEdge { outside, slot, record, .. } = hole.ring[usize::from(edge)];
                    if record != id {
                        links.push(Step::Write(Write::link(outside, slot.into(), id)));
                    }
                }
            }
        }
        job.steps.extend(links);
        for id in free {
            job.steps.push_back(Step::Free(Write::record(id, [self.memory.infinite; 3], [keep; 3])));
        }
        (job, keep)
    }
}
