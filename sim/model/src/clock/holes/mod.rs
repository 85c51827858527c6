//! Deletions, clock by clock: the star of a vertex is locked and its ring collected, the hole is filled by gift
//! wrapping, and the records that fill it are written.
//!
//! A free record has the infinite vertex three times. So its corners are one point, and it conflicts with no point: a
//! walk that comes to it goes on by its link.
//!
//! Hardware twin: the blocks of `hdl/src/engine/holes/`. In a run of `Delete` every visit is one of a deletion.
//!
//! ```text
//! completed visits -> star: chains, records outside -> ring -+
//!          ^                                                 v
//!          +---- tests of four vertices ---- Fill <- hole without tests left
//!                                             |
//!                                             +-> Writer -> records, links, marks of free records
//! ```

mod fill;
mod hole;
mod star;
mod star_step;
mod writer;

use super::commit_job::CommitJob;
use super::memory::{Memory, Write};
use super::outcome::Outcome;
use super::visit::Bundle;
use fill::Fill;
pub(super) use fill::FillEnd;
pub(super) use hole::{keeps_edges, replaces, Hole};
pub(super) use star::Star;
use writer::Writer;

#[derive(Clone, Debug)]
pub(super) struct Holes {
    /// The star and the hole of each context.
    pub stars: Vec<Star>,
    pub holes: Vec<Hole>,
    fill: Fill,
    writer: Writer,
}

impl Holes {
    pub(super) fn new(contexts: usize) -> Self {
        Self {
            stars: vec![Star::default(); contexts],
            holes: vec![Hole::default(); contexts],
            fill: Fill::new(contexts),
            writer: Writer::default(),
        }
    }

    /// The test that is asked for at this edge if the queue of visits is free.
    pub(super) fn push_request(&self) -> Option<Bundle> {
        self.fill.push_request()
    }

    /// The item that ends at this edge if no other one does.
    pub(super) fn end_request(&self) -> Option<FillEnd> {
        // Its last job must find room.
        self.fill.end_request().filter(|_| !self.writer.is_full())
    }

    /// The deletion whose last record is written at this edge.
    pub(super) fn erased(&self) -> Option<CommitJob> {
        self.writer.ends()
    }

    /// The vertex of that deletion, and the ids that it keeps.
    pub(super) fn kept(&self, memory: &Memory) -> Option<(u32, [u32; 2])> {
        self.writer.kept(memory)
    }

    /// Whether a write will be requested in the next clock, so that a commit requests none.
    pub(super) fn writes_next(&self) -> bool {
        self.writer.writes_next()
    }

    /// The write that is requested in this clock.
    pub(super) fn write(&self) -> Write {
        self.writer.write
    }

    /// Simulates one edge. `pushes` and `ends` say whether the requests are granted.
    pub(super) fn clock(&mut self, outcome: Option<&Outcome>, pushes: bool, ends: bool, memory: &mut Memory) {
        self.fill.clock(pushes, ends, &mut self.holes, &mut self.writer, memory);
        self.writer.clock(memory);
        let Some(outcome) = outcome else {
            return;
        };
        if let Some(star) = outcome.star {
            self.stars[outcome.context] = star;
        }
        if let Some(hole) = outcome.tests_on {
            self.holes[outcome.context] = hole;
        }
        if let Some(hole) = outcome.opens_hole {
            self.fill.arrives(outcome.context, hole);
        }
    }
}
