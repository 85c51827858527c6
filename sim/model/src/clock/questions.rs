//! Runs of questions about a mesh that stands, clock by clock: the words of a run, the queues of its items, the walks,
//! and the parts of its answer.
//!
//! Hardware twin: the block `Questions`. During a run no insertion is at work, so all visits in the pipeline are those
//! of questions.

mod item_queues;
mod near;
mod part_queue;
mod run_port;
mod signals;
mod step;
mod visits;

use super::beat::Beat;
use super::memory::Memory;
use incircle_protocol::RunKind;
use item_queues::ItemQueues;
use near::Search;
use part_queue::{Part, PartQueue};
use run_port::RunPort;
use signals::Item;
pub(super) use signals::Signals;
use visits::{Bundle, Visit, Visits};

#[derive(Clone, Debug)]
pub(super) struct Questions {
    port: RunPort,
    queues: ItemQueues,
    parts: PartQueue,
    visits: Visits,
    /// The item of each context, and its search for the nearest vertex.
    items: Vec<Item>,
    searches: Vec<Search>,
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
            visits: Visits::new(),
            items: vec![Item::default(); contexts],
            searches: vec![Search::default(); contexts],
            hints: vec![0; contexts],
        }
    }

    /// Whether the core answers runs of this kind.
    pub(super) fn answers(kind: RunKind) -> bool {
        matches!(kind, RunKind::Locate | RunKind::Interpolate | RunKind::Nearest)
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
        let visit = self.visits.completion();
        let context = visit.map_or(0, |visit| visit.context);
        let followed = visit.map(|visit| {
            let (place, search) = (self.items[context].place, &mut self.searches[context]);
            step::follow(self.port.kind(), &visit, memory.record(visit.record), place, search, memory)
        });
        let asked = followed.map_or(Bundle::default(), |followed| followed.visits);
        let end = followed.and_then(|followed| followed.end);
        let came = end.map(|(outcome, located)| Part { number: self.items[context].number, outcome, located });
        if let Some(visit) = visit.filter(|_| followed.is_some_and(|followed| followed.arrives)) {
            self.hints[context] = visit.record;
        }
        let may_launch = self.parts.has_room() && asked.is_empty();
        let offer = self.port.dealt();
        let done = self.queues.clock(offer, end.map(|_| context), may_launch);
        let launched = done.launched.map(|(context, item)| {
            self.items[context] = item;
            Bundle::one(Visit::walk(context, self.hints[context]))
        });
        self.visits.clock(launched.unwrap_or(asked));
        let is_over = self.parts.is_over();
        let head = self.port.head(signals.signature);
        self.port.clock(signals, done.taken, is_over);
        self.parts.clock(head, launched.is_some(), came, signals.is_taken);
        if signals.clears {
            self.hints.fill(0);
        }
    }
}
