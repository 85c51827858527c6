//! Runs on a mesh that stands, clock by clock: the words of a run, the queues of its items, the walks of questions, and
//! the parts of its answer. The insertion engine carries out the items of changes.
//!
//! Hardware twin: the block `Questions`. During a run of questions no insertion is at work, so all visits in the
//! pipeline are those of questions, and no record changes.

mod changes;
mod item_queues;
mod latencies;
mod near;
mod part_queue;
mod run_port;
mod signals;
mod step;
mod visits;

use super::beat::Beat;
use super::memory::Memory;
use changes::{Around, Changes};
use incircle_protocol::{Config, RunKind};
use item_queues::ItemQueues;
use latencies::Latencies;
use near::Search;
use part_queue::{Part, PartQueue};
use run_port::RunPort;
use signals::Item;
pub(super) use signals::{Events, ItemEnd, Launch, Signals};
use std::collections::VecDeque;
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
    /// The record at which the last walk of each context has ended, or the root of its last change.
    hints: Vec<u32>,
    changes: Changes,
    /// The contexts whose vertices are out of the mesh and go back into it.
    returns: VecDeque<usize>,
    /// The item that begins next.
    upcoming: Option<Upcoming>,
    /// Whether the item that begins next was chosen in the clock before: it leaves the line in this one.
    leaves: bool,
    /// The events of the clock before that end items, and the context whose question has ended then.
    late: Events,
    ended: Option<usize>,
    /// How long the items of the last run took, which only those who watch the model ask for.
    latencies: Latencies,
}

/// The item that begins next, with the record at which its walk begins.
#[derive(Clone, Copy, Debug)]
struct Upcoming {
    context: usize,
    item: Item,
    record: u32,
    /// Whether the vertex of the item goes back into the mesh.
    returns: bool,
}

impl Questions {
    pub(super) fn new(config: Config) -> Self {
        let contexts = config.contexts as usize;
        Self {
            port: RunPort::new(),
            queues: ItemQueues::new(contexts),
            parts: PartQueue::default(),
            visits: Visits::new(),
            items: vec![Item::default(); contexts],
            searches: vec![Search::default(); contexts],
            hints: vec![0; contexts],
            changes: Changes::new(contexts, config.points),
            returns: VecDeque::new(),
            upcoming: None,
            leaves: false,
            late: Events::default(),
            ended: None,
            latencies: Latencies::default(),
        }
    }

    /// For each item that has begun in the last run, in the order in which they ended, the number of clocks from its
    /// start to its end.
    pub(super) fn latencies(&self) -> &[u32] {
        self.latencies.ended()
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

    /// Whether a run of changes is under way.
    pub(super) fn changes_mesh(&self) -> bool {
        self.port.is_active() && self.port.is_change()
    }

    /// Whether a run of deletions is under way.
    pub(super) fn deletes(&self) -> bool {
        self.port.is_active() && self.port.kind() == RunKind::Delete
    }

    /// Whether a run of moves is under way.
    pub(super) fn moves(&self) -> bool {
        self.port.is_active() && self.port.kind() == RunKind::Move
    }

    /// Whether an item of a change has begun since the last clear, so that contexts take no points by themselves.
    pub(super) fn has_changed(&self) -> bool {
        self.changes.has_changed
    }

    /// Whether some point of an `Insert` is not finished, and whether the last one waits for its context.
    pub(super) fn is_pending(&self, came: bool) -> bool {
        !self.port.is_active() && (came || self.point_waits() || !self.queues.rests())
    }

    pub(super) fn point_waits(&self) -> bool {
        self.changes.point_waits()
    }

    /// The item of a change that begins at this edge if the insertion engine lets it.
    pub(super) fn launch(&self) -> Option<Launch> {
        if self.asks() || Changes::unmarked(&self.late, self.moves()).is_some() {
            return None;
        }
        let Upcoming { context, item, record, returns } = self.upcoming?;
        let stores = returns || self.changes_mesh() && !self.deletes() && !self.moves();
        Some(Launch { context, item, record, stores, returns })
    }

    /// Chooses the item that begins next, where there is room for one: the first item in the line, which comes only if
    /// no vertex waits to go back into the mesh, or else such a vertex.
    fn choose(&mut self, first: Option<(usize, Item)>) {
        if let Some((context, item)) = first {
            self.items[context] = item;
            self.upcoming = Some(Upcoming { context, item, record: self.hints[context], returns: false });
        } else {
            self.upcoming = self.returns.pop_front().map(|context| {
                let item = Item { place: self.items[context].target, ..self.items[context] };
                Upcoming { context, item, record: self.hints[context], returns: true }
            });
        }
    }

    /// Whether a run of questions is under way.
    fn asks(&self) -> bool {
        self.port.is_active() && !self.port.is_change()
    }

    /// The item that is offered to the queues.
    fn offer(&self) -> Option<(usize, Item)> {
        let run = self.port.is_active().then(|| self.port.dealt());
        self.changes.offered(run, self.port.is_change())
    }

    /// Simulates one edge. Returns the vertex that has come into the mesh with an item of a change.
    pub(super) fn clock(&mut self, signals: &Signals, events: &Events, memory: &Memory) -> Option<u32> {
        let asks = self.asks();
        let visit = self.visits.completion();
        let context = visit.map_or(0, |visit| visit.context);
        let followed = visit.map(|visit| {
            let (place, search) = (self.items[context].place, &mut self.searches[context]);
            step::follow(self.port.kind(), &visit, memory.record(visit.record), place, search, memory)
        });
        let asked = followed.map_or(Bundle::default(), |followed| followed.visits);
        let found = followed.and_then(|followed| followed.end);
        let came = found.map(|(outcome, located)| Part { number: self.items[context].number, outcome, located });
        if let Some(visit) = visit.filter(|_| followed.is_some_and(|followed| followed.arrives)) {
            self.hints[context] = visit.record;
        }
        let late = std::mem::replace(&mut self.late, *events);
        let begun = match asks {
            true => self.upcoming.filter(|_| asked.is_empty()),
            false => self.upcoming.filter(|_| events.launch.is_some()),
        };
        let ends = match asks {
            true => self.ended,
            false => {
                let end = late.ends.or(late.fill_ends).or(late.solo_ends).filter(|_| self.changes.has_changed);
                end.map(|end| end.context)
            }
        };
        let offer = self.offer();
        self.ended = found.filter(|_| asks).map(|_| context);
        let was_left = self.leaves;
        let is_open = self.upcoming.is_none();
        let may_choose = is_open && self.returns.is_empty() && self.parts.has_room();
        let chosen = self.queues.first().filter(|_| may_choose);
        self.leaves = chosen.is_some();
        let accepted = self.queues.clock(offer, ends, was_left);
        let around = Around {
            is_active: self.port.is_active(),
            is_change: self.port.is_change(),
            deletes: self.deletes(),
            moves: self.moves(),
            dealt: self.port.dealt(),
            vertex: self.port.vertex(),
            accepted,
            has_room: self.parts.has_two_places() && !was_left,
            contexts: signals.contexts,
            clears: signals.clears,
        };
        if let Some((context, record)) = events.root.filter(|_| self.changes.has_changed) {
            self.hints[context] = record;
        }
        let change = self.changes.clock(&around, &events.with_ends_of(&late), &self.items, memory);
        if begun.is_some() {
            self.upcoming = None;
        }
        if is_open {
            self.choose(chosen);
        }
        self.returns.extend(late.put_out);
        let walk = begun.filter(|_| asks).map(|it| Bundle::one(Visit::walk(it.context, it.record)));
        self.visits.clock(walk.unwrap_or(asked));
        let is_over = self.parts.is_over() && (asks || events.all_rest);
        let head = self.port.head(signals.signature);
        let begins = was_left && self.port.is_active() || change.is_noted;
        let part = came.or(change.came);
        self.latencies.clock(
            head.is_some(),
            begun.filter(|it| !it.returns && self.port.is_active()).map(|it| it.item.number),
            part.filter(|_| !change.is_noted).map(|part| part.number),
        );
        self.port.clock(signals, change.taken, is_over);
        self.parts.clock(head, begins, part, signals.is_taken);
        if signals.clears {
            self.hints.fill(0);
        }
        change.raised
    }
}
