//! Runs of questions about a mesh that stands, clock by clock: the words of a run, the queues of its items, the walks,
//! and the parts of its answer.
//!
//! Hardware twin: the block `Questions`. During a run no insertion is at work, so all visits in the pipeline are those
//! of questions, and no record changes. In this model a visit is therefore an entry of a delay line, and its record is
//! read when the visit completes.

mod item_queues;
mod part_queue;
mod run_port;
mod signals;
mod step;

use super::beat::Beat;
use super::memory::Memory;
use incircle_protocol::RunKind;
use item_queues::ItemQueues;
use part_queue::{Part, PartQueue};
use run_port::RunPort;
use signals::Item;
pub(super) use signals::Signals;
use std::collections::VecDeque;
use step::{Followed, Visit};

/// Number of clocks from the request of a visit to the requests that follow it.
const LOOP: usize = 18;

#[derive(Clone, Debug)]
pub(super) struct Questions {
    port: RunPort,
    queues: ItemQueues,
    parts: PartQueue,
    /// The visits in the pipeline, the oldest first, with `None` for clocks without a visit.
    visits: VecDeque<Option<Visit>>,
    /// The item of each context.
    items: Vec<Item>,
    /// The record at which the last walk of each context has ended.
    hints: Vec<u32>,
}

impl Questions {
    pub(super) fn new(contexts: u32) -> Self {
        let contexts = contexts as usize;
        Self {
            port: RunPort::new(),
            queues: ItemQueues::new(contexts),
            parts: PartQueue::default(),
            visits: VecDeque::from(vec![None; LOOP]),
            items: vec![Item::default(); contexts],
            hints: vec![0; contexts],
        }
    }

    /// Whether the core answers runs of this kind.
    pub(super) fn answers(kind: RunKind) -> bool {
        matches!(kind, RunKind::Locate | RunKind::Interpolate)
    }

    /// Whether a run is under way.
    pub(super) fn is_active(&self) -> bool {
        self.port.is_active()
    }

    /// Whether a word of the run is taken.
    pub(super) fn is_ready(&self) -> bool {
        self.port.is_ready()
    }

    /// The beat on offer.
    pub(super) fn offered(&self) -> Option<Beat> {
        self.parts.offered()
    }

    /// Simulates one edge.
    pub(super) fn clock(&mut self, signals: &Signals, memory: &Memory) {
        let visit = self.visits.pop_front().flatten();
        let followed = visit.map(|visit| {
            let place = self.items[visit.context].place;
            step::follow(&visit, memory.record(visit.record), place, memory)
        });
        let next = followed.and_then(|followed| followed.next());
        let context = visit.map_or(0, |visit| visit.context);
        let ends = followed.is_some_and(|followed| matches!(followed, Followed::End(..)));
        let came = match followed {
            Some(Followed::End(outcome, located)) => {
                Some(Part { number: self.items[context].number, outcome, located })
            }
            _ => None,
        };
        if let Some(visit) = visit.filter(|_| followed.is_some_and(|followed| followed.arrives())) {
            self.hints[context] = visit.record;
        }
        let may_launch = self.parts.has_room() && next.is_none();
        let offer = self.port.dealt();
        let done = self.queues.clock(offer, ends.then_some(context), may_launch);
        let launched = done.launched.map(|(context, item)| {
            self.items[context] = item;
            Visit::walk(context, self.hints[context])
        });
        self.visits.push_back(next.or(launched));
        let is_over = self.parts.is_over();
        let head = self.port.head(signals.signature);
        self.port.clock(signals, done.taken, is_over);
        self.parts.clock(head, launched.is_some(), came, signals.is_taken);
        if signals.clears {
            self.hints.fill(0);
        }
    }
}
